use crate::{engine::SessionError, film::ImageError, scene::SceneError};
use std::io;

/// Why a command did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// The command line is wrong.
    #[error("{0}")]
    Usage(String),
    /// The scene is wrong, or cannot be written.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A picture is wrong, or cannot be written.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The scene cannot be rendered.
    #[error(transparent)]
    Session(#[from] SessionError),
    /// It failed while running.
    #[error("{0}")]
    Failed(String),
    /// Standard output or standard error takes nothing.
    #[error("the output cannot be written: {0}")]
    Output(#[from] io::Error),
}

impl CliError {
    /// Whether all that happened is that the reader of the output went away, as `head` does.
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }

    /// 1: it failed while running; 2: the command line, the scene or a picture given to it is wrong.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Scene(SceneError::Write { .. }) | Self::Image(ImageError::Write { .. }) => 1,
            Self::Usage(_) | Self::Scene(_) | Self::Image(_) | Self::Session(SessionError::Prepare(_)) => 2,
            Self::Session(SessionError::Threads(_) | SessionError::Memory { .. })
            | Self::Failed(_)
            | Self::Output(_) => 1,
        }
    }
}
