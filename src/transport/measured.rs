//! What iterations measure about the film, for the plan to refine itself by.

use super::bandwidth::{Contrast, Contrasts};
use super::pixel_samples::{FilmSamples, PixelSamples};
use super::schedule;

/// What iterations measured so far.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Of the iterations since radii were chosen.
    pub(super) contrasts: Contrasts,
    /// Of all iterations.
    pub(super) samples: FilmSamples,
    /// Of the iterations since radii were chosen.
    biased: Bias,
    /// Of the others.
    biased_before: Bias,
    size: [u32; 2],
}

/// The root mean square of the bias over the film, times the weight of iterations with the same radii; or a sum of such.
#[derive(Clone, Copy, Debug, Default)]
struct Bias {
    weighted: f64,
    weight: f64,
}

impl Measured {
    /// Nothing yet, for a film of this size.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            contrasts: Contrasts::new(width, height),
            samples: FilmSamples::new(width, height),
            biased: Bias::default(),
            biased_before: Bias::default(),
            size: [width, height],
        }
    }

    /// Adds what an iteration measured, for each pixel of the film.
    pub fn add(&mut self, iteration: u64, contrasts: &[Contrast], samples: &[PixelSamples]) {
        self.contrasts.add(iteration, contrasts);
        self.samples.add(samples);
        if schedule::measures(iteration) {
            self.biased.weight += schedule::size(iteration);
            self.biased.weighted = self.biased.weight * self.contrasts.squared_bias().sqrt();
        }
    }

    /// Estimate of the mean square, over pixels and channels, of the picture's bias by density estimates; noisy while iterations
    /// are few, never negative. Bias is much the same in all iterations, but for how large it is.
    pub fn squared_bias(&self) -> f64 {
        let weight = self.biased.weight + self.biased_before.weight;
        if weight > 0.0 { ((self.biased.weighted + self.biased_before.weighted) / weight).powi(2) } else { 0.0 }
    }

    /// Begins to measure other radii.
    pub fn forget_radii(&mut self) {
        let [width, height] = self.size;
        self.contrasts = Contrasts::new(width, height);
        self.biased_before.weight += self.biased.weight;
        self.biased_before.weighted += self.biased.weighted;
        self.biased = Bias::default();
    }
}
