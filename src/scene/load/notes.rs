use crate::scene::{LocatedProblem, Problem};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::{Bound, Range};

/// The positions of values in the text, and the problems with them.
#[derive(Default)]
pub(super) struct Notes {
    spans: BTreeMap<String, Range<usize>>,
    problems: Vec<Problem>,
    /// The paths of the problems.
    paths: BTreeSet<String>,
}

impl Notes {
    /// Records the position of the value at `path`.
    pub(super) fn mark(&mut self, path: &str, span: Range<usize>) {
        self.spans.insert(path.to_owned(), span);
    }

    /// Reports a problem with the value at `path`.
    pub(super) fn add(&mut self, path: &str, message: String) {
        self.paths.insert(path.to_owned());
        self.problems.push(Problem { path: path.to_owned(), message });
    }

    /// Whether there is a problem with this value.
    pub(super) fn has_problem_at(&self, path: &str) -> bool {
        self.paths.contains(path)
    }

    /// Whether there is a problem with this value, a value inside it, or a value around it.
    pub(super) fn has_problem_near(&self, path: &str) -> bool {
        let inside = [".", "["].map(|separator| format!("{path}{separator}"));
        let has_inside = inside.iter().any(|start| {
            let next = self.paths.range::<str, _>((Bound::Included(start.as_str()), Bound::Unbounded)).next();
            next.is_some_and(|next| next.starts_with(start))
        });
        has_inside || around(path).any(|around| self.has_problem_at(around))
    }

    /// `Ok` without problems; else all problems in the order of the text.
    pub(super) fn finish(self, text: &str) -> Result<(), Vec<LocatedProblem>> {
        if self.problems.is_empty() {
            return Ok(());
        }
        let spans = self.spans;
        let at = |problem: Problem| (offset_of(&spans, &problem.path), problem);
        let located = LocatedProblem::all(text, self.problems.into_iter().map(at).collect());
        Err(located)
    }
}

/// The position of the value at `path`, or of the innermost table or list around it that has a position.
fn offset_of(spans: &BTreeMap<String, Range<usize>>, path: &str) -> usize {
    around(path).find_map(|path| spans.get(path)).map_or(0, |span| span.start)
}

/// The path itself, the paths of the values around it from the inside out, and the path of the whole scene.
fn around(path: &str) -> impl Iterator<Item = &str> {
    std::iter::successors(Some(path), |path| match path.rfind(['.', '[']) {
        Some(end) => Some(&path[..end]),
        None => (!path.is_empty()).then_some(""),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn problems_are_near_values_inside_and_around_them() {
        let mut notes = Notes::default();
        notes.add("object[2]", String::new());
        notes.add("light[1].radius", String::new());
        for near in ["object[2].radius", "object[2]", "object[2].patches[3][1]", "light[1]", "light"] {
            assert!(notes.has_problem_near(near), "{near}");
        }
        for far in ["object[21]", "object[1]", "light[1].center", "light[1].radius_v", "lights"] {
            assert!(!notes.has_problem_near(far), "{far}");
        }
        notes.add("", String::new());
        assert!(notes.has_problem_near("anything"), "the whole scene");
    }
}
