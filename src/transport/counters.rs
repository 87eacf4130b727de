//! Work counters.

use serde::{Deserialize, Serialize};
use std::iter::Sum;
use std::ops::AddAssign;

/// Numbers of rays, photons and other work of the passes. Tests read them to prove that needless work is skipped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counters {
    /// Rays traced to the nearest surface.
    pub rays: u64,
    /// Shadow rays: rays that only test whether a segment is free.
    pub shadow_rays: u64,
    /// Photon paths emitted for caustics.
    pub caustic_paths: u64,
    /// Photon paths emitted for interreflection.
    pub global_paths: u64,
    /// Photons stored in a map.
    pub photons_stored: u64,
    /// Photons splatted to the film without a map.
    pub splats: u64,
    /// Cells of light sheets.
    pub sheet_cells: u64,
    /// Density estimates in the caustic map.
    pub caustic_gathers: u64,
    /// Density estimates in the maps of interreflection.
    pub global_gathers: u64,
    /// Photon maps built.
    pub map_builds: u64,
    /// Texture lookups.
    pub texture_lookups: u64,
    /// Contributions left out of the film because they were not finite.
    pub dropped_samples: u64,
}

/// The result of a pass, which tells the work that the pass took.
pub trait Counted {
    /// The work that the result took.
    fn counters(&self) -> Counters;
}

/// The result of a pass that may be cancelled: no work when cancelled.
impl<T: Counted> Counted for Option<T> {
    fn counters(&self) -> Counters {
        self.as_ref().map_or_else(Counters::default, T::counters)
    }
}

/// The results of two passes.
impl<A: Counted, B: Counted> Counted for (A, B) {
    fn counters(&self) -> Counters {
        [self.0.counters(), self.1.counters()].into_iter().sum()
    }
}

impl Sum for Counters {
    fn sum<I: Iterator<Item = Self>>(counters: I) -> Self {
        counters.fold(Self::default(), |mut sum, counters| {
            sum += counters;
            sum
        })
    }
}

impl AddAssign for Counters {
    fn add_assign(&mut self, other: Self) {
        self.rays += other.rays;
        self.shadow_rays += other.shadow_rays;
        self.caustic_paths += other.caustic_paths;
        self.global_paths += other.global_paths;
        self.photons_stored += other.photons_stored;
        self.splats += other.splats;
        self.sheet_cells += other.sheet_cells;
        self.caustic_gathers += other.caustic_gathers;
        self.global_gathers += other.global_gathers;
        self.map_builds += other.map_builds;
        self.texture_lookups += other.texture_lookups;
        self.dropped_samples += other.dropped_samples;
    }
}
