use crate::scene::{LocatedProblem, Problem};
use std::{collections::BTreeMap, ops::Range};

/// The positions of values in the text, and the problems with them.
#[derive(Default)]
pub(super) struct Notes {
    spans: BTreeMap<String, Range<usize>>,
    problems: Vec<Problem>,
}

impl Notes {
    /// Records the position of the value at `path`.
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

    /// `Ok` without problems; else all problems in the order of the text.
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

/// The position of the value at `path`, or of the innermost table or list around it that has a position.
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
