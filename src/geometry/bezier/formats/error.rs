//! Why a file holds no patches that can be read.

use thiserror::Error;

/// Why a text holds no patches, with the line of the error.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("line {line}: {problem}")]
pub struct FormatError {
    /// Line number, from 1; for a text that ends too soon, its last line.
    pub line: usize,
    /// The error.
    pub problem: FormatProblem,
}

/// An error in a file of patches.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FormatProblem {
    /// The text ends too early. Holds the missing item.
    #[error("the file ends where {0} was expected")]
    Short(String),
    /// Another word than expected, or a number that is not finite.
    #[error("expected {expected}, found `{found}`")]
    Unexpected {
        /// The expected item.
        expected: String,
        /// The word found instead.
        found: String,
    },
    /// Degrees other than 3 3.
    #[error("patch {patch} has degrees {u} {v}; only bicubic patches (3 3) can be read")]
    Degree {
        /// Number of the patch, from 1.
        patch: usize,
        /// Degree in u.
        u: usize,
        /// Degree in v.
        v: usize,
    },
    /// Text after the last patch. Holds the first word of it.
    #[error("found `{0}` after the last patch; is the number of patches in the first line right?")]
    Surplus(String),
    /// A point that the file does not hold.
    #[error("there is no point {index}; the file has {count} points up to here")]
    NoPoint {
        /// The number by which the file names the point.
        index: i64,
        /// The number of points.
        count: usize,
    },
    /// A valid part of the format that cannot be read. Says which, and what to do.
    #[error("{0}")]
    Unsupported(String),
}

impl FormatError {
    /// A part of the format, in this line, that cannot be read.
    pub(super) fn unsupported(line: usize, problem: impl Into<String>) -> Self {
        Self { line, problem: FormatProblem::Unsupported(problem.into()) }
    }
}
