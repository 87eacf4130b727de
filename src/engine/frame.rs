//! A picture and its statistics.

use super::g_buffer::GBuffer;
use crate::film::LinearImage;
use crate::transport::{Counters, Energy, PathEnergy, PlanItem, PlanNote};
use crate::world::Warning;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::Arc;

/// A picture of a scene at some moment of its rendering.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Generation of the scene, which grows with each edit.
    pub generation: u64,
    /// Whether this is a quick first picture, possibly with fewer pixels than the film.
    pub draft: bool,
    /// Number of iterations in the picture; 0 for a draft.
    pub iteration: u64,
    /// Linear radiance.
    pub image: Arc<LinearImage>,
    /// What a screen may show instead while the picture has few iterations: with less noise, and together with the picture before an edit.
    pub preview: Option<Arc<LinearImage>>,
    /// Whether the preview has less noise in its interreflection than the picture.
    pub smoothed: bool,
    /// What the pixels show; `None` before the first iteration.
    pub g_buffer: Option<Arc<GBuffer>>,
    /// Standard deviation of the noise of each pixel, radiance, by two sets of iterations; `None` before there are two, and unless it was
    /// asked for.
    pub noise: Option<Arc<Vec<f32>>>,
    /// Statistics of the rendering so far.
    pub stats: Stats,
    /// The decisions of the plan.
    pub plan: Arc<PlanSummary>,
}

impl Frame {
    /// The picture for a screen.
    pub fn shown(&self) -> &Arc<LinearImage> {
        self.preview.as_ref().unwrap_or(&self.image)
    }
}

/// The decisions of a plan: which items are rendered, which are skipped, and why; warnings about the scene.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PlanSummary {
    /// Every decision.
    pub notes: Vec<PlanNote>,
    /// Faults of the scene that do not keep it from being rendered.
    pub warnings: Vec<Warning>,
}

/// Statistics of a picture's rendering.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stats {
    /// Number of iterations in the picture.
    pub iterations: u64,
    /// Photon paths emitted.
    pub photons_emitted: u64,
    /// Rays of all kinds, shadow rays included.
    pub rays: u64,
    /// Contributions left out of the film because they were not finite.
    pub dropped_samples: u64,
    /// Rendering time from the first iteration on, without pauses, seconds.
    pub seconds: f64,
    /// Photon paths emitted per second.
    pub photons_per_second: f64,
    /// Mean radius of density estimates at the middle of the scene, scene units.
    pub radius: f64,
    /// Estimated RMSE over the mean of the picture; `None` before there is an estimate.
    pub error_estimate: Option<f64>,
    /// Light of an item that too few photons have sampled, where the error estimate mostly consists of it.
    pub missing_light: Option<MissingLight>,
    /// Wall-clock time of each pass.
    pub passes: PassSeconds,
    /// All work counters.
    pub counters: Counters,
    /// What became of the flux of the photon paths, summed over the iterations.
    pub energy: Energy,
}

impl Stats {
    /// Statistics of this work, without any of a picture.
    pub(super) fn of_work(counters: Counters, passes: PassSeconds, seconds: f64) -> Self {
        let photons_emitted = counters.caustic_paths + counters.global_paths;
        Self {
            photons_emitted,
            rays: counters.rays + counters.shadow_rays,
            dropped_samples: counters.dropped_samples,
            seconds,
            photons_per_second: if seconds > 0.0 { photons_emitted as f64 / seconds } else { 0.0 },
            passes,
            counters,
            ..Self::default()
        }
    }
}

impl Stats {
    /// How the caustics divide between light sheets and photons; `None` without light sheets.
    pub fn light_sheets(&self) -> Option<SheetShare> {
        let PathEnergy { stored, sheets, .. } = self.energy.caustics;
        let cells = self.counters.sheet_cells / self.iterations.max(1);
        (cells > 0)
            .then(|| SheetShare { cells, photons: (1.0 - sheets / stored.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0) })
    }
}

/// How caustics divide between light sheets and photons. `Display` says so in words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetShare {
    /// Cells of light sheets in an iteration.
    pub cells: u64,
    /// Fraction of the flux of caustics that photons bring, 0 to 1.
    pub photons: f64,
}

impl fmt::Display for SheetShare {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { cells, photons } = self;
        write!(
            f,
            "{cells} cells of light sheets an iteration, {:.1} % of the caustics left to photons",
            100.0 * photons
        )
    }
}

/// Light that may be missing, because too few paths have sampled an item. `Display` says so in words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MissingLight {
    /// Direct light of a beam, caustics or interreflection.
    pub item: PlanItem,
    /// The most light that may be missing, over the mean of the picture; `None` while the picture is black.
    pub fraction: Option<f64>,
}

impl fmt::Display for MissingLight {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let paths = if self.item == PlanItem::DirectLight { "camera samples" } else { "photons" };
        write!(f, "too few {paths} for {} so far", self.item)?;
        match self.fraction {
            Some(fraction) if fraction < 1.0 => {
                write!(f, ": up to {:.2} % of the light may be missing", 100.0 * fraction)
            }
            Some(_) => write!(f, ": more light than the picture shows may be missing"),
            None => write!(f, ": the picture is still black"),
        }
    }
}

/// Wall-clock seconds of each pass, over all iterations. The camera and gather passes alternate on each thread; their time is the sum
/// over the threads divided by the number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PassSeconds {
    /// Building trees, reading textures and planning, before the first iteration.
    pub prepare: f64,
    /// Camera pass.
    pub camera: f64,
    /// Photon passes.
    pub photons: f64,
    /// Photon map construction.
    pub map: f64,
    /// Gather pass.
    pub gather: f64,
    /// Commit to the film, and refinement of the plan.
    pub commit: f64,
}

impl std::ops::AddAssign for PassSeconds {
    fn add_assign(&mut self, other: Self) {
        self.prepare += other.prepare;
        self.camera += other.camera;
        self.photons += other.photons;
        self.map += other.map;
        self.gather += other.gather;
        self.commit += other.commit;
    }
}
