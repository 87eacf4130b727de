//! Commands to the engine, its settings, its status and its errors.

use crate::scene::SceneFile;
use crate::transport::Component;
use std::sync::Arc;
use thiserror::Error;

/// Settings of an engine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EngineSettings {
    /// Number of threads that render; `None` for one per processor.
    pub threads: Option<usize>,
    /// Seed of all random numbers.
    pub seed: u64,
}

/// When rendering rests, apart from the error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Rendering time of the picture, seconds; `None` for no limit.
    pub seconds: Option<f64>,
    /// Iterations of the picture; `None` for no limit.
    pub iterations: Option<u64>,
}

/// Commands to the engine.
#[derive(Clone, Debug)]
pub enum Command {
    /// Renders this scene from now on.
    Show(Arc<SceneFile>),
    /// Pauses after the present iteration.
    Pause,
    /// Continues after a pause.
    Resume,
    /// Restarts the present scene.
    Restart,
    /// Rests once the estimated error (RMSE over the mean) is at most this; `None` renders without end.
    Target(Option<f64>),
    /// Rests once the picture has this time or these iterations.
    Limits(Limits),
    /// Whether [`Frame::preview`](super::Frame::preview) has less noise in its interreflection than the picture.
    Smooth(bool),
    /// Renders this component of the light alone, or all; begins the present scene anew.
    Only(Option<Component>),
    /// Whether frames have [`Frame::noise`](super::Frame::noise).
    Noise(bool),
}

/// The state of the engine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// Waiting for a scene.
    Idle,
    /// Building trees, reading textures, planning.
    Preparing,
    /// Rendering iterations.
    Rendering,
    /// Paused.
    Paused,
    /// Resting: the estimated error reached the target.
    Converged,
    /// Resting: the time or the iterations that the picture may have are spent.
    LimitReached,
    /// The scene cannot be rendered, for this reason; another scene may be.
    Failed(String),
}

/// Why an engine could not start.
#[derive(Debug, Error)]
pub enum EngineError {
    /// The operating system denied the threads of the pool.
    #[error("the system gave no threads to render with: {0}")]
    Pool(#[from] rayon::ThreadPoolBuildError),
    /// The operating system denied the engine's thread.
    #[error("the system gave no thread to render on: {0}")]
    Thread(#[from] std::io::Error),
}
