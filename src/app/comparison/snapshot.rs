//! A picture with its scene, error and time.

use crate::app::panels::duration;
use crate::engine::Frame;
use crate::film::{LinearImage, Provenance};
use crate::scene::{Location, SceneFile};
use std::sync::Arc;

/// The name of the field that holds a snapshot's name in its file.
const NAME: &str = "Name";
/// The name of the field that holds the rendering time, seconds.
const SECONDS: &str = "Seconds";

/// A picture that the user keeps, or a reference.
#[derive(Clone, Debug)]
pub(crate) struct Snapshot {
    pub(crate) name: String,
    pub(crate) image: Arc<LinearImage>,
    /// The scene that the picture shows; `None` for a reference of another program.
    pub(crate) file: Option<Arc<SceneFile>>,
    pub(crate) iterations: u64,
    /// Rendering time, seconds; `None` where it is not known.
    pub(crate) seconds: Option<f64>,
    /// Estimated RMSE over the mean radiance; `None` where it is not known.
    pub(crate) error: Option<f64>,
}

impl Snapshot {
    /// The picture of a frame, which shows this scene.
    pub(crate) fn of_frame(name: String, frame: &Frame, file: &Arc<SceneFile>) -> Self {
        Self {
            name,
            image: Arc::clone(&frame.image),
            file: Some(Arc::clone(file)),
            iterations: frame.iteration,
            seconds: Some(frame.stats.seconds),
            error: frame.stats.error_estimate,
        }
    }

    /// A picture of a file; `location` is where the scene that the file may hold finds its textures.
    pub(crate) fn of_file(stem: &str, image: LinearImage, provenance: &Provenance, location: &Location) -> Self {
        let setting = |name: &str| provenance.settings.iter().find(|(own, _)| own == name).map(|(_, value)| value);
        let scene = provenance.scene.as_ref().and_then(|text| SceneFile::restore(text, location.clone()).ok());
        Self {
            name: setting(NAME).cloned().unwrap_or_else(|| stem.to_owned()),
            image: Arc::new(image),
            file: scene.map(Arc::new),
            iterations: provenance.iterations,
            seconds: setting(SECONDS).and_then(|text| text.parse().ok()),
            error: provenance.error,
        }
    }

    /// What a file of the picture tells.
    pub(crate) fn provenance(&self) -> Provenance {
        let seconds = self.seconds.map(|seconds| (SECONDS.to_owned(), format!("{seconds:.3}")));
        Provenance {
            scene: self.file.as_ref().map(|file| file.snapshot()),
            settings: [(NAME.to_owned(), self.name.clone())].into_iter().chain(seconds).collect(),
            iterations: self.iterations,
            error: self.error,
            camera: self.file.as_ref().map(|file| file.scene.camera),
        }
    }

    /// Error and time, for its caption; the size of a reference.
    pub(crate) fn caption(&self) -> String {
        let error = self.error.map(|error| format!("{:.2} %", 100.0 * error));
        let parts: Vec<String> = error.into_iter().chain(self.seconds.map(duration)).collect();
        if parts.is_empty() {
            return format!("{} × {}", self.image.width, self.image.height);
        }
        parts.join(", ")
    }
}
