use super::Problem;
use std::{fmt, io, path::PathBuf};

/// Why a scene could not be opened or saved.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The scene file.
        file: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file was read and is no valid scene; everything that was found, in the order of the text.
    #[error("{}", lines(file, problems))]
    Invalid {
        /// The scene file, or the example's name.
        file: String,
        /// Never empty.
        problems: Vec<LocatedProblem>,
    },
    /// The file holds control points, which are a part of a scene only.
    #[error("{}: holds control points, not a scene; an object of type \"bezier\" takes them with `file = ...`", file.display())]
    ControlPoints {
        /// The `.bpt` file.
        file: PathBuf,
    },
    /// No built-in scene has this name, and no file.
    #[error("{name}: there is no such scene file, and built in are {known}{suggestion}")]
    NoSuchExample {
        /// What was asked for.
        name: String,
        /// The names that there are.
        known: String,
        /// Empty, or the nearest name.
        suggestion: String,
    },
    /// The scene or a file that it needs cannot be written; nothing was changed at that path.
    #[error("{}: cannot be written: {source}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// A problem and where it stands in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LocatedProblem {
    /// From 1.
    pub line: usize,
    /// In characters, from 1.
    pub column: usize,
    /// What is wrong.
    pub problem: Problem,
}

impl LocatedProblem {
    /// The problem at a byte offset of the text.
    pub(super) fn at(text: &str, offset: usize, problem: Problem) -> Self {
        let before = text.get(..offset).unwrap_or(text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Self { line: 1 + before.matches('\n').count(), column: 1 + before[line_start..].chars().count(), problem }
    }
}

/// Problems that a message lists; more are only counted.
const MOST_SHOWN: usize = 20;

/// One line a problem, in the form that editors and terminals make a link of.
fn lines(file: &str, problems: &[LocatedProblem]) -> String {
    struct Line<'a>(&'a str, &'a LocatedProblem);
    impl fmt::Display for Line<'_> {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "{}:{}:{}: {}", self.0, self.1.line, self.1.column, self.1.problem)
        }
    }
    let mut lines: Vec<_> = problems.iter().take(MOST_SHOWN).map(|p| Line(file, p).to_string()).collect();
    if problems.len() > MOST_SHOWN {
        lines.push(format!("{file}: and {} more", problems.len() - MOST_SHOWN));
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let text = "a = 1\nnäme = 2\n";
        let problem = Problem { path: String::new(), message: String::new() };
        let located = LocatedProblem::at(text, text.find('2').unwrap(), problem);
        assert_eq!((located.line, located.column), (2, 8));
    }
}
