//! What iterations measure about the film, for the plan to refine itself by.

use super::bandwidth::Contrasts;
use super::maps::PerMap;
use super::pixel_samples::{FilmSamples, PixelSamples};

/// What iterations measured so far.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Of the iterations since radii were chosen.
    pub(super) contrasts: Contrasts,
    /// Of all iterations.
    all_contrasts: Contrasts,
    /// Of all iterations.
    pub(super) samples: FilmSamples,
    size: [u32; 2],
}

impl Measured {
    /// Nothing yet, for a film of this size.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            contrasts: Contrasts::new(width, height),
            all_contrasts: Contrasts::new(width, height),
            samples: FilmSamples::new(width, height),
            size: [width, height],
        }
    }

    /// Adds what an iteration measured, for each pixel of the film.
    pub fn add(&mut self, iteration: u64, contrasts: &[PerMap<f32>], samples: &[PixelSamples]) {
        self.contrasts.add(iteration, contrasts);
        self.all_contrasts.add(iteration, contrasts);
        self.samples.add(samples);
    }

    /// Estimate of the mean square, over pixels and channels, of the picture's bias by density estimates; noisy while iterations
    /// are few, never negative.
    pub fn squared_bias(&self) -> f64 {
        self.all_contrasts.squared_bias()
    }

    /// Forgets what belongs to the radii so far.
    pub fn forget_radii(&mut self) {
        let [width, height] = self.size;
        self.contrasts = Contrasts::new(width, height);
    }
}
