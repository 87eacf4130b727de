use super::Problem;
use std::{fmt, io, path::PathBuf};

/// Why a scene cannot be opened or saved.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The path of the scene file.
        file: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The file is not a valid scene. Holds all problems, in the order of the text.
    #[error("{}", lines(file, problems))]
    Invalid {
        /// The path of the scene file, or the name of the built-in scene.
        file: String,
        /// The problems; never empty.
        problems: Vec<LocatedProblem>,
    },
    /// The file is a `.bpt` file of control points, not a scene.
    #[error("{}: is a file of control points, not a scene; use it in an object of type \"bezier\" as `file = ...`", file.display())]
    ControlPoints {
        /// The path of the `.bpt` file.
        file: PathBuf,
    },
    /// There is no scene file and no built-in scene of this name.
    #[error("{name}: no such scene file or built-in scene; the built-in scenes are {known}{suggestion}")]
    NoSuchExample {
        /// The name.
        name: String,
        /// The names of the built-in scenes.
        known: String,
        /// A suggestion of the nearest name, or empty.
        suggestion: String,
    },
    /// The scene file, or a file that the scene names, cannot be written. The previous file is unchanged.
    #[error("{}: cannot be written: {source}", file.display())]
    Write {
        /// The path of the file.
        file: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
}

/// A problem with its position in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LocatedProblem {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// The problem.
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

/// The number of problems that a message lists; it counts the rest.
const MAX_LISTED: usize = 20;

/// One line per problem, in the form `file:line:column` that editors and terminals turn into links.
fn lines(file: &str, problems: &[LocatedProblem]) -> String {
    struct Line<'a>(&'a str, &'a LocatedProblem);
    impl fmt::Display for Line<'_> {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "{}:{}:{}: {}", self.0, self.1.line, self.1.column, self.1.problem)
        }
    }
    let mut lines: Vec<_> = problems.iter().take(MAX_LISTED).map(|p| Line(file, p).to_string()).collect();
    if problems.len() > MAX_LISTED {
        lines.push(format!("{file}: and {} more problems", problems.len() - MAX_LISTED));
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
