use serde::Serialize;
use std::iter::Sum;
use std::ops::AddAssign;

/// What passes did: proof of what was needed and what was skipped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// Rays that looked for the nearest surface.
    pub rays: u64,
    /// Rays that only asked whether something is in between.
    pub shadow_rays: u64,
    /// Paths that left a light to find caustics.
    pub caustic_paths: u64,
    /// Paths that left a light to find interreflection.
    pub global_paths: u64,
    /// Photons that arrived and were kept.
    pub photons_stored: u64,
    /// Photons added to the film without a map.
    pub splats: u64,
    /// Density estimates in the map of caustic photons.
    pub caustic_gathers: u64,
    /// Density estimates in the map of global photons.
    pub global_gathers: u64,
    /// Photon maps built.
    pub map_builds: u64,
    /// Values read from textures.
    pub texture_lookups: u64,
    /// Contributions that were not finite and were left out.
    pub dropped_samples: u64,
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
        self.caustic_gathers += other.caustic_gathers;
        self.global_gathers += other.global_gathers;
        self.map_builds += other.map_builds;
        self.texture_lookups += other.texture_lookups;
        self.dropped_samples += other.dropped_samples;
    }
}
