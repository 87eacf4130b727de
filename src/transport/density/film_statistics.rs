//! Measurements of iterations, for the plan's refinement and the error estimate.

use super::bandwidth::{BandwidthDifference, BandwidthDifferences};
use super::sample_allocation::{FilmSamples, PixelSamples};
use super::schedule;

/// Measurements of the iterations so far.
#[derive(Clone, Debug)]
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
#[derive(Clone, Copy, Debug, Default)]
struct Bias {
    weighted: f64,
    weight: f64,
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

    /// Adds the measurements of iteration `iteration` (from 1): both slices hold one value for each pixel of the film.
    pub fn add(&mut self, iteration: u64, differences: &[BandwidthDifference], samples: &[PixelSamples]) {
        self.differences.add(iteration, differences);
        self.samples.add(samples);
        if schedule::measures(iteration) {
            self.bias.weight += schedule::size(iteration);
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
        self.bias_before.weight += self.bias.weight;
        self.bias_before.weighted += self.bias.weighted;
        self.bias = Bias::default();
    }
}
