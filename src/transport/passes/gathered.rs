//! The result of the gather pass.

use crate::math::Rgb;
use crate::transport::counters::{Counted, Counters};
use crate::transport::density::BandwidthDifference;

/// Light that photons bring to a visible point.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gathered {
    /// Radiance that the point adds to its pixel.
    pub radiance: Rgb,
    /// The part of this radiance that is interreflection.
    pub interreflection: Rgb,
    /// The bandwidth difference of this radiance; 0 where it is not measured.
    pub difference: BandwidthDifference,
}

/// The result of the gather pass for a [`CameraBatch`](super::CameraBatch).
#[derive(Clone, Debug, Default)]
pub struct GatheredBatch {
    /// The light at each visible point, in the order of the points.
    pub points: Vec<Gathered>,
    /// Work done.
    pub counters: Counters,
}

impl Counted for GatheredBatch {
    fn counters(&self) -> Counters {
        self.counters
    }
}
