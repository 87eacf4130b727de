//! Sums over iterations, and the estimate of their error.

use super::convergence_rates::ConvergenceRates;
use crate::film::LinearImage;
use crate::math::Rgb;
use crate::transport::PixelSamples;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::ops::{AddAssign, Sub};

/// The film: sums over consecutive iterations of a run. The sums of iterations 1 to n equal the merged sums of consecutive ranges of
/// iterations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilmSums {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Number of iterations of the run before the first one of the film.
    pub(super) before: u64,
    pub(super) iterations: u64,
    /// Sum of the weights of the iterations in the mean of photons.
    pub(super) weight: f64,
    /// Sums over all iterations. Empty before the first iteration: a scene that is edited again at once needs no film.
    pub(super) all: Vec<PixelSums>,
    /// Sums over the first iterations, up to the last power of two before the present iteration of the run. Their difference to the later iterations
    /// tells the error. Every second iteration would not do: neighbours in a low-discrepancy sequence complement each other, and differ
    /// more than their mean errs.
    pub(super) first: Vec<PixelSums>,
    pub(super) first_weight: f64,
    /// Sums up to the power of two before that, in a film that begins later than the run: films before it may have to be compared with
    /// them. Otherwise empty.
    pub(super) earlier: Vec<PixelSums>,
    pub(super) earlier_weight: f64,
    /// The differences between the halves of the first iterations.
    pub(super) halves: Option<Differences>,
}

/// Most iterations of a run: the indices of its samples and paths stay below 2^64.
pub const MOST_ITERATIONS: u64 = 1 << 40;

/// Weight of the later iterations over the weight of the first iterations: from the first value on, the difference between the two sets
/// begins to tell the noise, from the second on, it alone tells the noise. Fewer iterations are not representative.
const TELLING_WEIGHTS: [f64; 2] = [0.25, 0.75];

/// Standard deviations above the estimate up to which the noise is bounded. With two, one of ten pictures of sharp caustics had 1.3 times the
/// error asked for. A greater value would ask for more iterations.
const BOUND: f64 = 3.0;

/// The differences between the first and the later iterations of a film.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Differences {
    /// Mean squared noise of the mean over all iterations, over pixels and channels.
    pub(super) squared_noise: f64,
    /// Relative standard deviation of `squared_noise`: high where a few pixels hold most of it.
    pub(super) deviation: f64,
    /// The noise of camera samples by convergence rate.
    pub(super) rates: ConvergenceRates,
}

impl Differences {
    /// The squared noise, this number of standard deviations above its estimate.
    fn noise_above(&self, deviations: f64) -> f64 {
        self.squared_noise * (1.0 + deviations * self.deviation)
    }
}

/// Sums for a pixel, in double precision: single precision stalls after some ten million additions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct PixelSums {
    /// Weighted sum of the radiance from photons.
    pub(super) photons: DVec3,
    /// Weighted sum of the means of camera samples.
    pub(super) samples: DVec3,
    /// Sum of the weights of camera samples.
    pub(super) samples_weight: f64,
}

impl PixelSums {
    /// Weighted mean of the camera samples; black without samples.
    fn mean_sample(&self) -> DVec3 {
        if self.samples_weight > 0.0 { self.samples / self.samples_weight } else { DVec3::ZERO }
    }

    /// Mean radiance over iterations with this sum of weights.
    fn radiance(&self, weight: f64) -> DVec3 {
        self.photons / weight + self.mean_sample()
    }
}

impl AddAssign for PixelSums {
    fn add_assign(&mut self, other: Self) {
        self.photons += other.photons;
        self.samples += other.samples;
        self.samples_weight += other.samples_weight;
    }
}

impl Sub for PixelSums {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            photons: self.photons - other.photons,
            samples: self.samples - other.samples,
            samples_weight: self.samples_weight - other.samples_weight,
        }
    }
}

impl FilmSums {
    /// The first iteration after which the error is estimated: two do not tell how fast the noise falls.
    pub const ESTIMATED_FROM: u64 = 3;

    /// A film of this many columns and rows of pixels, without iterations.
    pub fn new(width: u32, height: u32) -> Self {
        Self::after(width, height, 0)
    }

    /// A film of this many columns and rows of pixels for the iterations of a run after the first `before` ones.
    pub fn after(width: u32, height: u32, before: u64) -> Self {
        Self {
            width,
            height,
            before,
            iterations: 0,
            weight: 0.0,
            all: Vec::new(),
            first: Vec::new(),
            first_weight: 0.0,
            earlier: Vec::new(),
            earlier_weight: 0.0,
            halves: None,
        }
    }

    /// The number of pixels.
    pub(super) fn pixel_count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Adds the next iteration: the radiance from photons, with this weight, and the camera samples, with their own weights. Both slices
    /// hold one value for each pixel of the film.
    pub fn commit(&mut self, weight: f64, photons: &[Rgb], samples: &[PixelSamples]) {
        debug_assert_eq!([photons.len(), samples.len()], [self.pixel_count(); 2], "an iteration covers the film");
        self.all.resize(self.pixel_count(), PixelSums::default());
        if self.last().is_power_of_two() {
            self.end_first();
        }
        for ((sums, photons), samples) in self.all.iter_mut().zip(photons).zip(samples) {
            let samples_weight = f64::from(samples.weight);
            *sums += PixelSums {
                photons: weight * photons.as_dvec3(),
                samples: samples_weight * samples.mean().as_dvec3(),
                samples_weight,
            };
        }
        self.iterations += 1;
        self.weight += weight;
    }

    /// Ends the first iterations: the following ones are compared with them.
    pub(super) fn end_first(&mut self) {
        self.halves = self.differences();
        if self.before > 0 {
            std::mem::swap(&mut self.earlier, &mut self.first);
            self.earlier_weight = self.first_weight;
        }
        self.first.clone_from(&self.all);
        self.first_weight = self.weight;
    }

    /// Number of iterations in the film.
    pub fn iterations(&self) -> u64 {
        self.iterations
    }

    /// The number, in the run, of the first iteration of the film.
    pub fn first(&self) -> u64 {
        self.before + 1
    }

    /// The number, in the run, of the last iteration of the film.
    pub fn last(&self) -> u64 {
        self.before + self.iterations
    }

    /// Whether the film has this size, and one sum for each pixel.
    pub(super) fn fits(&self, width: u32, height: u32) -> bool {
        let sums = if self.iterations == 0 { 0 } else { self.pixel_count() };
        (self.width, self.height) == (width, height)
            && self.all.len() == sums
            && [(&self.first, self.first_weight), (&self.earlier, self.earlier_weight)]
                .into_iter()
                .all(|(part, weight)| part.len() == sums || part.is_empty() && weight == 0.0)
            && self.before.checked_add(self.iterations).is_some_and(|last| last <= MOST_ITERATIONS)
    }

    /// The positive part of the weighted mean over the iterations; black before the first.
    pub fn image(&self) -> LinearImage {
        if self.all.is_empty() {
            return LinearImage::black(self.width, self.height);
        }
        let pixels = self.all.iter().map(|sums| sums.radiance(self.weight).as_vec3());
        LinearImage::positive_part(self.width, self.height, pixels)
    }

    /// Sum of the weights of the iterations: their total size, full iterations.
    pub fn weight(&self) -> f64 {
        self.weight
    }

    /// Mean radiance over pixels and channels, of the sums, which may be negative in some pixels; 0 before the first iteration.
    pub fn mean(&self) -> f64 {
        let total: f64 = self.all.iter().map(|all| all.radiance(self.weight).element_sum()).sum();
        total / (3.0 * self.all.len().max(1) as f64)
    }

    /// Whether no iteration brought any light. The sums of a nearly black picture may cancel, too.
    pub fn is_black(&self) -> bool {
        self.all.iter().all(|sums| sums.photons == DVec3::ZERO && sums.samples == DVec3::ZERO)
    }

    /// Estimated RMSE of the image over its mean: from its noise, which the difference between the first and the later iterations tells,
    /// and a mean square over pixels and channels of the errors that noise does not show: bias, and light that is still unseen. `None`
    /// before [`Self::ESTIMATED_FROM`] iterations and for a black picture. The noise is that of the sums; the error of the picture, their
    /// positive part, is at most the same.
    pub fn error_estimate(&self, squared_hidden: f64) -> Option<f64> {
        self.error(squared_hidden, 0.0)
    }

    /// [`Self::error_estimate`] with a noise that is a little higher than estimated, so that the error is seldom more: where a few pixels hold
    /// most of the noise, as at a sharp caustic, the estimate varies by tens of percent.
    pub fn error_bound(&self, squared_hidden: f64) -> Option<f64> {
        self.error(squared_hidden, BOUND)
    }

    /// The error for a squared noise this number of standard deviations above the estimate.
    fn error(&self, squared_hidden: f64, deviations: f64) -> Option<f64> {
        let halves = self.halves.as_ref()?;
        let [least, most] = TELLING_WEIGHTS;
        let other_weight = (self.weight - self.first_weight) / self.first_weight;
        let trust = ((other_weight - least) / (most - least)).clamp(0.0, 1.0);
        let before = halves.noise_above(deviations) * self.first_weight / self.weight;
        let now = if trust > 0.0 { self.differences()?.noise_above(deviations) } else { 0.0 };
        let squared_noise = (1.0 - trust) * before + trust * now;
        let mean = self.mean();
        (mean > 0.0).then(|| (squared_noise + squared_hidden).sqrt() / mean)
    }

    /// The standard deviation of the noise of each pixel, radiance, by one difference between the first and the later iterations: a rough
    /// number at a single pixel. `None` before there are later ones.
    pub fn pixel_noise(&self) -> Option<Vec<f32>> {
        let other_weight = self.weight - self.first_weight;
        let pixel = |(all, first): (&PixelSums, &PixelSums)| {
            let other = *all - *first;
            let part = |first: f64, other: f64| (first * other).sqrt() / (first + other);
            let photons = first.photons / self.first_weight - other.photons / other_weight;
            let samples = first.mean_sample() - other.mean_sample();
            let samples_part = match first.samples_weight.min(other.samples_weight) > 0.0 {
                true => part(first.samples_weight, other.samples_weight),
                false => 0.0,
            };
            let noise = part(self.first_weight, other_weight) * photons + samples_part * samples;
            (noise.length_squared() / 3.0).sqrt() as f32
        };
        (other_weight > 0.0 && self.first_weight > 0.0).then(|| self.all.iter().zip(&self.first).map(pixel).collect())
    }

    /// The differences between the first and the later iterations; `None` where one of the two sets is empty.
    fn differences(&self) -> Option<Differences> {
        let other_weight = self.weight - self.first_weight;
        if !(other_weight > 0.0 && self.first_weight > 0.0) {
            return None;
        }
        let (mut photons, mut sum, mut sum_of_squares) = (0.0, 0.0, 0.0);
        let mut rates = ConvergenceRates::default();
        for (all, first) in self.all.iter().zip(&self.first) {
            let other = *all - *first;
            let photon = (first.photons / self.first_weight - other.photons / other_weight).length_squared();
            let samples = (first.mean_sample() - other.mean_sample()).length_squared();
            photons += photon;
            sum += photon + samples;
            sum_of_squares += (photon + samples).powi(2);
            rates.include(samples, first.samples_weight, other.samples_weight);
        }
        let channels = 3.0 * self.all.len() as f64;
        // The variance of the mean of all for independent photons.
        let photons = photons * (self.first_weight * other_weight) / self.weight.powi(2);
        let samples = rates.squared_noise(self.halves.as_ref().map(|halves| &halves.rates));
        // Of a normal distribution the fourth moment is three times the squared variance, and the variance of the square twice.
        let deviation = if sum > 0.0 { (2.0 / 3.0 * sum_of_squares).sqrt() / sum } else { 0.0 };
        Some(Differences { squared_noise: (photons + samples) / channels, deviation, rates })
    }
}

/// The greatest power of two below a number; 0 for 0 and 1.
pub(super) fn greatest_power_below(x: u64) -> u64 {
    if x < 2 { 0 } else { 1 << (x - 1).ilog2() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, Stream};

    const SIDE: u32 = 40;
    const PIXELS: u64 = (SIDE * SIDE) as u64;

    fn value(iteration: u64, pixel: u64) -> Rgb {
        Rgb::splat(Sampler::new(1, Stream::Camera, iteration, pixel).next_1d() as f32)
    }

    fn noise(iteration: u64) -> Vec<Rgb> {
        (0..PIXELS).map(|pixel| value(iteration, pixel)).collect()
    }

    fn nothing() -> Vec<PixelSamples> {
        vec![PixelSamples::default(); PIXELS as usize]
    }

    /// The camera samples of a pixel with this number of samples, sum of their radiance, and weight.
    fn pixel(count: u32, sum: Rgb, weight: f32) -> PixelSamples {
        PixelSamples { count, sum, weight, ..PixelSamples::default() }
    }

    /// One sample for each pixel, of this weight.
    fn samples(iteration: u64, weight: f32) -> Vec<PixelSamples> {
        (0..PIXELS).map(|index| pixel(1, value(iteration, index), weight)).collect()
    }

    #[test]
    fn two_sets_estimate_the_error() {
        let mut film = FilmSums::new(SIDE, SIDE);
        assert_eq!(film.error_estimate(0.0), None);
        for i in 1..=64 {
            film.commit(1.0, &noise(i), &nothing());
            // Uniform numbers have the standard deviation 0.2887 and the mean 0.5; the pixels know it to 2 %.
            let expected = 0.577 / (i as f64).sqrt();
            let off = |estimate: f64| (estimate / expected - 1.0).abs();
            assert!(film.error_estimate(0.0).map_or(i <= 2, |estimate| off(estimate) < 0.08), "iteration {i}");
        }
    }

    /// Ten of the pixels hold all noise, so that their number of degrees of freedom rules how well it is known; the mean is one.
    #[test]
    fn the_bound_is_seldom_below_the_error_where_few_pixels_hold_the_noise() {
        let mut bounded = [0; 2];
        for run in 0..200 {
            let mut film = FilmSums::new(SIDE, SIDE);
            let radiance = |iteration, pixel| {
                let u = Sampler::new(run, Stream::Camera, iteration, pixel).next_1d();
                Rgb::splat(if pixel < 10 { (2.0 * u) as f32 } else { 1.0 })
            };
            (1..=16)
                .for_each(|i| film.commit(1.0, &(0..PIXELS).map(|k| radiance(i, k)).collect::<Vec<_>>(), &nothing()));
            let squares = film.image().pixels.iter().map(|p| (f64::from(p.x) - 1.0).powi(2)).sum::<f64>();
            let error = (squares / PIXELS as f64).sqrt();
            let (estimate, bound) = (film.error_estimate(0.0).unwrap(), film.error_bound(0.0).unwrap());
            [estimate, bound].iter().zip(&mut bounded).for_each(|(x, count)| *count += i32::from(1.3 * x > error));
        }
        assert!(bounded[0] < 175 && bounded[1] > 185, "{bounded:?} of 200");
    }

    /// An edge through each pixel, at another position.
    #[test]
    fn stratified_samples_of_edges_estimate_their_error() {
        let mut film = FilmSums::new(SIDE, SIDE);
        let edge = |pixel| Sampler::new(1, Stream::Probe, 0, pixel).next_1d();
        let lit = |pixel, index| {
            let position = Sampler::new(1, Stream::Camera, pixel, index).next_2d();
            Rgb::splat(if 0.8 * position.x + 0.2 * position.y < edge(pixel) { 1.0 } else { 0.0 })
        };
        for i in 0..33 {
            let samples = (0..PIXELS).map(|k| pixel(4, (4 * i..4 * i + 4).map(|index| lit(k, index)).sum(), 4.0));
            film.commit(1.0, &vec![Rgb::ZERO; PIXELS as usize], &samples.collect::<Vec<_>>());
            let truth = |pixel| (0..1024).map(|index| f64::from(lit(pixel, index).x)).sum::<f64>() / 1024.0;
            if [15, 16, 23, 31, 32].contains(&i) {
                let image = film.image();
                let squares = (0..PIXELS).zip(&image.pixels).map(|(k, p)| (f64::from(p.x) - truth(k)).powi(2));
                let error = (squares.sum::<f64>() / PIXELS as f64).sqrt()
                    / (image.pixels.iter().map(|p| f64::from(p.x)).sum::<f64>() / PIXELS as f64);
                let ratio = film.error_estimate(0.0).unwrap() / error;
                assert!((0.8..1.3).contains(&ratio), "{i}: {ratio}");
            }
        }
    }

    /// As in glossy reflections, also where but one iteration followed a power of two.
    #[test]
    fn samples_without_strata_estimate_their_error() {
        let mut film = FilmSums::new(SIDE, SIDE);
        for i in 1..=65 {
            film.commit(1.0, &vec![Rgb::ZERO; PIXELS as usize], &samples(i, 1.0));
            let error = 0.577 / (i as f64).sqrt();
            let off = film.error_estimate(0.0).map(|estimate| estimate / error);
            assert!(i < 8 || off.is_some_and(|ratio| (0.8..1.15).contains(&ratio)), "{i}: {off:?}");
        }
    }

    #[test]
    fn sums_that_cancel_are_not_black() {
        let mut film = FilmSums::new(1, 1);
        film.commit(1.0, &[Rgb::ZERO], &[PixelSamples::default()]);
        assert!(film.is_black());
        for photons in [1.0, -1.0, -1.0] {
            film.commit(1.0, &[Rgb::splat(photons)], &[PixelSamples::default()]);
        }
        assert!(!film.is_black() && film.mean() < 0.0 && film.error_estimate(0.0).is_none());
    }

    #[test]
    fn photons_have_the_weight_of_their_iteration_and_samples_their_own() {
        let mut film = FilmSums::new(1, 1);
        let samples = |weight: f32, radiance: f32| pixel(2, Rgb::splat(2.0 * radiance), weight);
        film.commit(0.5, &[Rgb::splat(10.0)], &[samples(4.0, 1.0)]);
        film.commit(1.0, &[Rgb::splat(40.0)], &[samples(1.0, 6.0)]);
        assert_eq!(film.image().pixels[0], Rgb::splat(30.0 + 2.0));
    }

    #[test]
    fn a_billion_equal_iterations_keep_counting() {
        let mut film = FilmSums::new(1, 1);
        film.all = vec![PixelSums { photons: DVec3::splat(1e9), samples: DVec3::splat(1e10), samples_weight: 1e10 }];
        film.iterations = 1_000_000_000;
        film.commit(1.0, &[Rgb::splat(2.0)], &[pixel(1, Rgb::splat(3.0), 1.0)]);
        assert_eq!((film.all[0].photons.x, film.all[0].samples.x), (1e9 + 2.0, 1e10 + 3.0));
    }
}
