//! What a scene needs, decided before rendering, and why the rest is skipped.

mod caustics;
mod draft;
mod interreflection;
mod notes;
mod paths;
mod radii;
mod surfaces;

pub use caustics::CausticPlan;
pub use notes::PlanNote;
pub(super) use radii::MAX_PART_OF_SPHERE;

use super::Rows;
use super::bandwidth::{Bandwidth, Contrasts};
use super::light_choice::LightChoice;
use super::lobe_light::LobeLight;
use super::measured::Measured;
use super::pixel_samples::SampleCounts;
use super::schedule;
use super::sharing::Lattice;
use crate::math::Stream;
use crate::world::{Camera, World};
use caustics::SEEN_INDIRECTLY;
use notes::Notes;
use radii::{CAUSTIC_RADIUS, GLOSSY_RADIUS, LOBE_REACH, are_large};
use std::ops::Range;
use std::sync::Arc;

/// Samples of a pixel in a full iteration as long as nothing was measured. Photons are gathered for one of them, which is most
/// of the work; the others find direct light, whose edges need them.
const CAMERA_SAMPLES: f64 = 4.0;

/// What every iteration does for a scene.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The eye and the film's grid, which is coarser for a draft.
    pub camera: Camera,
    /// Whether paths from the camera look for emission and direct light.
    pub finds_direct_light: bool,
    /// Caustics, where light can meet mirrors or glass.
    pub caustics: Option<CausticPlan>,
    /// Which lights points ask for direct light.
    pub light_choice: Arc<LightChoice>,
    /// Which light in Phong lobes paths from the camera find, and which photons bring.
    pub lobe_light: LobeLight,
    /// Paths that look for interreflection in a full iteration, by light; empty where there is none.
    pub global_paths: Vec<u64>,
    /// Whether neighbours share what they find in Phong lobes.
    pub shares_lobes: bool,
    /// How far from each other they are at most after one full iteration, pixels' footprints.
    pub lobe_reach: f64,
    /// Radius of the density estimate of caustics after one full iteration, where nothing is near, pixels' footprints.
    pub caustic_radius: f64,
    /// The same where another object is at hand: it may cast sharp shadows in the caustic.
    pub least_caustic_radius: f64,
    /// The same for interreflection, where nothing is near.
    pub global_radius: f64,
    /// The same where another object is at hand.
    pub least_global_radius: f64,
    /// The same where it stands on the surface: its foot casts sharp shadows even of indirect light.
    pub least_standing_radius: f64,
    /// The same for interreflection that mirrors or glass focused.
    pub focused_radius: f64,
    /// The same for interreflection in Phong lobes.
    pub glossy_radius: f64,
    /// The largest radius, parts of the world's radius.
    pub largest_radius: f64,
    /// Every decision.
    pub notes: Vec<PlanNote>,
    is_draft: bool,
    /// By what radii have shrunk, once it was measured.
    bandwidth: Option<Arc<Bandwidth>>,
    /// Samples of each pixel, once it was measured how they differ.
    samples: Option<Arc<SampleCounts>>,
}

impl Plan {
    /// The plan for a world.
    pub fn new(world: &World) -> Self {
        let mut notes = Notes::default();
        let lit = notes.lights(world);
        let caustics = if lit { caustics::plan(world, &mut notes) } else { None };
        if lit && caustics.is_none() {
            notes.skip(SEEN_INDIRECTLY, "there are no caustics to be seen");
        }
        let global_paths = if lit { interreflection::plan(world, &mut notes) } else { Vec::new() };
        let glossy_paths = interreflection::plan_gloss(world, &global_paths, &mut notes);
        notes.textures(world);
        notes.background(world);
        Self {
            camera: world.camera,
            finds_direct_light: true,
            caustics,
            light_choice: Arc::new(LightChoice::new(world)),
            lobe_light: LobeLight::new(world.camera, glossy_paths, GLOSSY_RADIUS),
            shares_lobes: surfaces::shows(world, World::may_share_lobes),
            lobe_reach: LOBE_REACH,
            global_paths,
            caustic_radius: if are_large(world) { 4.0 } else { CAUSTIC_RADIUS },
            least_caustic_radius: CAUSTIC_RADIUS,
            global_radius: 24.0,
            least_global_radius: 10.0,
            least_standing_radius: 5.0,
            focused_radius: 6.0,
            glossy_radius: GLOSSY_RADIUS,
            largest_radius: 0.15,
            notes: notes.0,
            is_draft: false,
            bandwidth: None,
            samples: None,
        }
    }

    /// The film in bands of rows, whose paths from the camera and density estimates need nothing of each other.
    pub fn bands(&self, iteration: u64) -> Vec<Rows> {
        self.lattice(iteration).bands(self.camera.height)
    }

    /// Which pixels gather interreflection for others.
    pub(super) fn lattice(&self, iteration: u64) -> Lattice {
        let width = self.camera.width;
        if self.is_draft { Lattice::draft(width) } else { Lattice::new(width, iteration) }
    }

    /// The weight of an iteration in the mean of what photons bring: its part of the paths of a full one.
    pub fn weight(&self, iteration: u64) -> f64 {
        if self.is_draft { 1.0 } else { schedule::size(iteration) }
    }

    /// Which samples of a pixel's sequence belong to an iteration; at least one.
    pub(super) fn camera_samples(&self, pixel: u32, iteration: u64) -> Range<u64> {
        if self.is_draft {
            return 0..1;
        }
        if let Some(samples) = &self.samples {
            return samples.at(pixel, iteration);
        }
        let before = |i| (CAMERA_SAMPLES * schedule::size_before(i)).ceil() as u64;
        before(iteration)..before(iteration + 1)
    }

    /// How much the mean of a pixel's samples of an iteration weighs beside those of other iterations.
    pub(super) fn samples_weight(&self, pixel: u32, iteration: u64) -> f32 {
        match &self.samples {
            Some(samples) => samples.weight(pixel),
            None => self.camera_samples(pixel, iteration).count() as f32,
        }
    }

    /// Whether light in a pixel is also gathered in wider discs in this iteration.
    pub(super) fn compares_discs(&self, pixel: u32, iteration: u64) -> bool {
        !self.is_draft && Contrasts::includes([self.camera.width, self.camera.height], pixel, iteration)
    }

    /// The plan for what follows iteration `i`, with the samples and radii that what was measured asks for; `None` where it
    /// stays as it is.
    pub fn refined(&self, i: u64, measured: &Measured) -> Option<Self> {
        if !schedule::refines_after(i) {
            return None;
        }
        let next = |pixel| self.camera_samples(pixel, i).end;
        let samples = || self.finds_direct_light.then(|| Arc::new(SampleCounts::best(i, &measured.samples, next)));
        let bandwidth = || {
            let total = schedule::size_before(2 * i + 1);
            Arc::new(match &self.bandwidth {
                None => Bandwidth::first(&measured.contrasts, total, self.shrink(i)),
                Some(bandwidth) => bandwidth.next(&measured.contrasts, total),
            })
        };
        let (samples, bandwidth) = rayon::join(samples, || self.gathers().then(bandwidth));
        Some(Self { bandwidth, samples, ..self.clone() })
    }

    /// Which paths of a light's sequence belong to an iteration, where a full one has `count`.
    pub(super) fn paths(&self, count: u64, iteration: u64) -> Range<u64> {
        let start = (count as f64 * schedule::size_before(iteration)) as u64;
        start..start + (count as f64 * self.weight(iteration)) as u64
    }

    /// Whether it is for a quick first picture.
    pub(super) fn is_draft(&self) -> bool {
        self.is_draft
    }

    /// Whether anything is gathered at visible points.
    pub(super) fn gathers(&self) -> bool {
        self.caustics.is_some() || !self.global_paths.is_empty()
    }

    /// Drafts draw their own numbers.
    pub(super) fn stream(&self, stream: Stream) -> Stream {
        if self.is_draft { Stream::Draft(stream.number()) } else { stream }
    }
}
