use crate::film::LinearImage;
use crate::transport::{Counters, PlanNote};
use std::sync::Arc;

/// A picture at some moment, and how it came about.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Of the scene: grows with each edit.
    pub generation: u64,
    /// A quick first picture, possibly of fewer pixels than the film has.
    pub draft: bool,
    /// Iterations in it; 0 for a draft.
    pub iteration: u64,
    /// Linear radiance.
    pub image: Arc<LinearImage>,
    /// How it came about.
    pub stats: Stats,
    /// What is rendered and what is skipped.
    pub plan: Arc<PlanSummary>,
}

/// What is rendered and what is skipped, and why.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PlanSummary {
    /// Every decision.
    pub notes: Vec<PlanNote>,
}

/// How a picture came about.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stats {
    /// In the picture.
    pub iterations: u64,
    /// Paths that left a light.
    pub photons_emitted: u64,
    /// Rays of all kinds.
    pub rays: u64,
    /// Contributions that were not finite and were left out.
    pub dropped_samples: u64,
    /// Since the first iteration began, pauses left out.
    pub seconds: f64,
    /// Paths that left a light in a second.
    pub photons_per_second: f64,
    /// Of the density estimate at the middle of the scene, scene units.
    pub radius: f64,
    /// Estimated RMSE over the mean; `None` as long as there is no estimate.
    pub error_estimate: Option<f64>,
    /// Wall-clock time by pass.
    pub passes: PassSeconds,
    /// Everything that was counted.
    pub counters: Counters,
}

/// Wall-clock seconds by pass, over all iterations. Camera and gather, which alternate, have each thread's part of the
/// seconds that all threads spent on them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PassSeconds {
    /// Trees, textures and the plan, before the first iteration.
    pub prepare: f64,
    /// Paths from the camera.
    pub camera: f64,
    /// Paths from the lights.
    pub photons: f64,
    /// Building photon maps.
    pub map: f64,
    /// Density estimates.
    pub gather: f64,
    /// Adding to the film.
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
