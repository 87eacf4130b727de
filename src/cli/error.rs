use crate::{
    engine::{CheckpointError, SessionError},
    film::ImageError,
    scene::SceneError,
};
use std::io;

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// An error in the command line or in a file that it names.
    #[error("{0}")]
    Usage(String),
    /// The scene cannot be opened or saved.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An image cannot be read, written or compared.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The scene cannot be rendered.
    #[error(transparent)]
    Session(#[from] SessionError),
    /// A checkpoint cannot be read or written.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// A signal ended the rendering; the picture so far was written.
    #[error("{message}")]
    Interrupted {
        /// How far the rendering came.
        message: String,
        /// The exit code that shells expect after the signal.
        code: u8,
    },
    /// A failure while running.
    #[error("{0}")]
    Failed(String),
    /// Standard output or standard error cannot be written.
    #[error("the output cannot be written: {0}")]
    Output(#[from] io::Error),
}

impl CliError {
    /// Whether the reader of the output closed it, as `head` does: no failure.
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }

    /// The exit code of the program: 1 for a failure while running, 2 for an error in the command line, in the scene or in an
    /// image that it names; after a signal 128 and its number.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Interrupted { code, .. } => *code,
            Self::Scene(SceneError::Write { .. })
            | Self::Image(ImageError::Write { .. })
            | Self::Checkpoint(CheckpointError::Write { .. }) => 1,
            Self::Usage(_)
            | Self::Scene(_)
            | Self::Image(_)
            | Self::Checkpoint(_)
            | Self::Session(SessionError::Prepare(_)) => 2,
            Self::Session(SessionError::Threads(_) | SessionError::Memory { .. })
            | Self::Failed(_)
            | Self::Output(_) => 1,
        }
    }
}
