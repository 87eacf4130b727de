//! The run that a part belongs to.

use super::frame::Stats;
use crate::film::Provenance;
use crate::scene::{Location, SceneFile, ToneCurve};
use crate::transport::Component;
use serde::{Deserialize, Serialize};

/// What determines every iteration of a run, and how its picture is shown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    program: String,
    scene: String,
    fingerprint: u64,
    width: u32,
    height: u32,
    seed: u64,
    only: Option<Component>,
    exposure: f64,
    tone_curve: ToneCurve,
    /// The text of the scene, for the files of pictures, if it is short enough for them. In a checkpoint it comes after the head.
    #[serde(skip)]
    pub(super) text: Option<String>,
}

/// Most bytes of a scene's text in the file of a picture or of a film.
pub(super) const MOST_TEXT: usize = 1 << 20;

/// What the file of a picture tells of a rendering of this scene with this seed, of one component of the light or of all, which has these
/// statistics. A scene of more than a megabyte is left out.
pub fn provenance(file: &SceneFile, seed: u64, only: Option<Component>, stats: &Stats) -> Provenance {
    let camera = Some(file.scene.camera);
    Provenance { scene: text_of(file), camera, ..provenance_without_scene(seed, only, stats) }
}

fn provenance_without_scene(seed: u64, only: Option<Component>, stats: &Stats) -> Provenance {
    let setting = |name: &str, value: String| (name.to_owned(), value);
    let only = only.map(|only| setting("Only", format!("{only:?}").to_lowercase()));
    Provenance {
        settings: [setting("Seed", seed.to_string())].into_iter().chain(only).collect(),
        iterations: stats.iterations,
        error: stats.error_estimate,
        ..Provenance::default()
    }
}

fn text_of(file: &SceneFile) -> Option<String> {
    Some(file.snapshot()).filter(|text| text.len() <= MOST_TEXT)
}

impl Run {
    /// The run of a scene with this seed, for one component of the light or for all.
    ///
    /// # Errors
    ///
    /// A message, if a file of the scene cannot be read.
    pub fn new(file: &SceneFile, seed: u64, only: Option<Component>) -> Result<Self, String> {
        let film = file.scene.film;
        Ok(Self {
            program: env!("CARGO_PKG_VERSION").to_owned(),
            scene: file.location.label(),
            fingerprint: file.fingerprint()?,
            width: film.width,
            height: film.height,
            seed,
            only,
            exposure: film.exposure,
            tone_curve: film.tone_curve,
            text: text_of(file),
        })
    }

    /// Width and height of the film, pixels.
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// Exposure in stops and tone curve of the picture.
    pub fn display(&self) -> (f64, ToneCurve) {
        (self.exposure, self.tone_curve)
    }

    /// The run with the text of its scene, which is not in the head of a checkpoint.
    pub(super) fn with_text(self, text: Option<String>) -> Self {
        Self { text, ..self }
    }

    /// What the file of a picture of the run tells, which has these statistics.
    pub fn provenance(&self, stats: &Stats) -> Provenance {
        let rest = provenance_without_scene(self.seed, self.only, stats);
        let text = self.text.as_ref();
        let file = text.and_then(|text| SceneFile::restore(text, Location::Unsaved).ok());
        Provenance { scene: text.cloned(), camera: file.map(|file| file.scene.camera), ..rest }
    }

    /// What keeps iterations of this run from being iterations of `other`; `None` if nothing does. Exposure and tone curve may differ.
    pub fn difference(&self, other: &Self) -> Option<String> {
        let size = |run: &Self| format!("{} x {} pixels", run.width, run.height);
        let light =
            |run: &Self| run.only.map_or("all light".to_owned(), |only| format!("only {only:?}").to_lowercase());
        let differ = |what: &str, here: String, there: String| Some(format!("{what}: {here}, not {there}"));
        if self.program != other.program {
            return differ("another version of patchlight", self.program.clone(), other.program.clone());
        }
        if self.fingerprint != other.fingerprint {
            return if self.scene == other.scene {
                Some(format!("another state of the scene: {} or a file that it names has changed", self.scene))
            } else {
                differ("another scene", self.scene.clone(), other.scene.clone())
            };
        }
        if self.size() != other.size() {
            return differ("another size", size(self), size(other));
        }
        if self.seed != other.seed {
            return differ("another seed", self.seed.to_string(), other.seed.to_string());
        }
        (self.only != other.only).then(|| differ("other components of light", light(self), light(other)))?
    }
}
