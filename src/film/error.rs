use std::{io, path::PathBuf};

/// Why an image cannot be read, written or compared.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The path of the file.
        file: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The content of the file is not a valid image.
    #[error("{}: {message}", file.display())]
    Content {
        /// The path of the file.
        file: PathBuf,
        /// The error.
        message: String,
    },
    /// The file cannot be written. The previous file is unchanged.
    #[error("{}: cannot be written: {source}", file.display())]
    Write {
        /// The path of the file.
        file: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The images of a comparison differ in size.
    #[error("the {what} has {} x {} pixels, the picture {} x {}", found.0, found.1, expected.0, expected.1)]
    Size {
        /// "reference", "second reference" or "mask".
        what: &'static str,
        /// Its width and height.
        found: (u32, u32),
        /// Width and height of the image.
        expected: (u32, u32),
    },
}
