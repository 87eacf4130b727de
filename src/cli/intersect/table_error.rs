use crate::file::shortened;

/// An error in a file of patches or rays, with the line, from 1.
#[derive(Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {}", shortened(problem))]
pub(super) struct TableError {
    pub(super) line: usize,
    pub(super) problem: String,
}
