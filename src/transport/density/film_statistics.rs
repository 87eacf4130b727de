//! Measurements of iterations, for the plan's refinement and the error estimate.

use super::bandwidth::{BandwidthDifference, BandwidthDifferences};
use super::sample_allocation::{FilmSamples, PixelSamples};
use super::schedule;
use serde::{Deserialize, Serialize};
use std::ops::AddAssign;

/// Measurements of the iterations so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FilmStatistics {
    /// Bandwidth differences of the iterations since the last refinement.
    pub(in crate::transport) differences: BandwidthDifferences,
    /// Camera samples of all iterations.
    pub(in crate::transport) samples: FilmSamples,
    /// Bias of the iterations since the last refinement.
    bias: Bias,
    /// Bias of the iterations before the last refinement.
    bias_before: Bias,
    size: [u32; 2],
}

/// The root mean square of the bias over the film, times the weight of the iterations that have it.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Bias {
    weighted: f64,
    weight: f64,
}

impl AddAssign for Bias {
    fn add_assign(&mut self, other: Self) {
        self.weighted += other.weighted;
        self.weight += other.weight;
    }
}

impl FilmStatistics {
    /// No measurement yet, for a film of this size.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            differences: BandwidthDifferences::new(width, height),
            samples: FilmSamples::new(width, height),
            bias: Bias::default(),
            bias_before: Bias::default(),
            size: [width, height],
        }
    }

    /// Adds the measurements of iteration `iteration` (from 1): both slices hold one value for each pixel of the film. The picture has the
    /// bias of the iteration only where the film has the iteration, too.
    pub fn add(
        &mut self,
        iteration: u64,
        is_in_film: bool,
        differences: &[BandwidthDifference],
        samples: &[PixelSamples],
    ) {
        self.differences.add(iteration, differences);
        self.samples.add(samples);
        if schedule::measures(iteration) {
            self.bias.weight += if is_in_film { schedule::size(iteration) } else { 0.0 };
            self.bias.weighted = self.bias.weight * self.differences.squared_bias().sqrt();
        }
    }

    /// Estimate of the mean squared bias of the picture's density estimates over pixels and channels, squared radiance; noisy after few
    /// iterations, never negative, 0 before it was measured. The bias of iterations adds up, because it keeps its sign.
    pub fn squared_bias(&self) -> f64 {
        let weight = self.bias.weight + self.bias_before.weight;
        if weight > 0.0 { ((self.bias.weighted + self.bias_before.weighted) / weight).powi(2) } else { 0.0 }
    }

    /// Begins to measure the radii of a refined plan.
    pub fn begin_refined(&mut self) {
        let [width, height] = self.size;
        self.differences = BandwidthDifferences::new(width, height);
        self.bias_before += std::mem::take(&mut self.bias);
    }

    /// The measurements `next` of the iterations that follow, with the bias of all iterations.
    pub fn followed_by(&self, mut next: Self) -> Self {
        // A single iteration does not tell its bias: it has the mean bias of the others.
        if !next.differences.tell_bias() {
            next.bias = Bias::default();
        }
        next.bias_before += self.bias_before;
        if self.differences.tell_bias() {
            next.bias_before += self.bias;
        }
        next
    }

    /// Whether the measurements are those of a film of this size.
    pub fn fits(&self, width: u32, height: u32) -> bool {
        self.size == [width, height] && self.differences.fits(width, height) && self.samples.fits(width, height)
    }
}
