use std::{io, path::PathBuf};

/// Why a picture could not be read, written or compared.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The picture's file.
        file: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file's content is not what it should be.
    #[error("{}: {message}", file.display())]
    Content {
        /// The picture's file.
        file: PathBuf,
        /// What was found.
        message: String,
    },
    /// The file cannot be written; what was there before is still there.
    #[error("{}: cannot be written: {source}", file.display())]
    Write {
        /// The picture's file.
        file: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Pictures that should be compared differ in size.
    #[error("the {what} has {} x {} pixels, the image {} x {}", found.0, found.1, expected.0, expected.1)]
    Size {
        /// Reference or mask.
        what: &'static str,
        /// Its width and height.
        found: (u32, u32),
        /// Those of the image.
        expected: (u32, u32),
    },
}
