use crate::scene::{LocatedProblem, Problem};
use std::{collections::BTreeMap, ops::Range};

/// Where the values stand in the text, and what is wrong with them.
#[derive(Default)]
pub(super) struct Notes {
    spans: BTreeMap<String, Range<usize>>,
    problems: Vec<Problem>,
}

impl Notes {
    /// Remembers where the value at `path` stands.
    pub(super) fn mark(&mut self, path: &str, span: Range<usize>) {
        self.spans.insert(path.to_owned(), span);
    }

    /// Reports a problem with the value at `path`.
    pub(super) fn add(&mut self, path: &str, message: String) {
        self.problems.push(Problem { path: path.to_owned(), message });
    }

    pub(super) fn has_problem_at(&self, path: &str) -> bool {
        self.problem_paths().any(|p| p == path)
    }

    pub(super) fn problem_paths(&self) -> impl Iterator<Item = &str> {
        self.problems.iter().map(|p| p.path.as_str())
    }

    /// All problems in the order of the text; `Ok` when there is none.
    pub(super) fn finish(self, text: &str) -> Result<(), Vec<LocatedProblem>> {
        if self.problems.is_empty() {
            return Ok(());
        }
        let spans = self.spans;
        let mut located: Vec<_> =
            self.problems.into_iter().map(|p| LocatedProblem::at(text, offset_of(&spans, &p.path), p)).collect();
        located.sort_by_key(|p| (p.line, p.column));
        Err(located)
    }
}

/// Where the value at `path` stands, or else the innermost thing around it that stands somewhere.
fn offset_of(spans: &BTreeMap<String, Range<usize>>, path: &str) -> usize {
    let mut path = path;
    loop {
        if let Some(span) = spans.get(path) {
            return span.start;
        }
        match path.rfind(['.', '[']) {
            Some(end) => path = &path[..end],
            None => return 0,
        }
    }
}
