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
    /// The `.bpt` file holds no valid patches.
    #[error("{}: {problem}", file.display())]
    Patches {
        /// The path of the `.bpt` file.
        file: PathBuf,
        /// The error.
        problem: String,
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
        Place::beginning(text).locate(offset, problem)
    }

    /// Problems with their byte offsets in a text, in the order of the text. One pass over the text, however many problems there are.
    pub(super) fn all(text: &str, mut problems: Vec<(usize, Problem)>) -> Vec<Self> {
        problems.sort_by_key(|(offset, _)| *offset);
        let mut place = Place::beginning(text);
        problems.into_iter().map(|(offset, problem)| place.locate(offset, problem)).collect()
    }
}

/// A place in a text, which moves on.
struct Place<'a> {
    /// The text from here on.
    rest: &'a str,
    /// Byte offset in the text.
    offset: usize,
    /// Numbers of the line and of the character in it, from 1.
    line: usize,
    column: usize,
}

impl<'a> Place<'a> {
    fn beginning(text: &'a str) -> Self {
        Self { rest: text, offset: 0, line: 1, column: 1 }
    }

    /// The problem at an offset, which must not lie before that of the previous call.
    fn locate(&mut self, offset: usize, problem: Problem) -> LocatedProblem {
        let (passed, rest) = self.rest.split_at(self.rest.floor_char_boundary(offset.saturating_sub(self.offset)));
        self.column = match passed.rsplit_once('\n') {
            Some((lines, last)) => {
                self.line += 1 + lines.matches('\n').count();
                1 + last.chars().count()
            }
            None => self.column + passed.chars().count(),
        };
        self.offset += passed.len();
        self.rest = rest;
        LocatedProblem { line: self.line, column: self.column, problem }
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
        let problem = || Problem { path: String::new(), message: String::new() };
        let all = LocatedProblem::all(text, [15, 6, 0, 99].map(|offset| (offset, problem())).to_vec());
        let places: Vec<_> = all.iter().map(|located| (located.line, located.column)).collect();
        assert_eq!(places, [(1, 1), (2, 1), (2, 9), (3, 1)], "in the order of the text; beyond it, at its end");
        let all = LocatedProblem::all(text, [8, 9, 12, 12].map(|offset| (offset, problem())).to_vec());
        let places: Vec<_> = all.iter().map(|located| (located.line, located.column)).collect();
        assert_eq!(places, [(2, 2), (2, 3), (2, 6), (2, 6)], "one after the other; in a character, at its beginning");
    }
}
