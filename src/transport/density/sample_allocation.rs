//! Allocation of camera samples: each pixel gets samples in proportion to their standard deviation, which makes the error of the
//! picture least for a total number of samples (Neyman allocation, \[Neyman34\]).
//!
//! The weight of an iteration in the mean of a pixel follows the number of samples, too: the few samples of the first iterations count
//! less than the many samples of later iterations. But it is the number that the neighbouring pixels ask for: weights by a pixel's own
//! samples would bias the mean, because a pixel whose samples happen to agree gets few further samples. A small bias remains,
//! because neighbours see the same edges: lamps of a fifth of a pixel at pixels' corners are 4 % too dark after 16 iterations, 0.5 %
//! after 64, a small fraction of their noise. Weights from samples that are taken in any case do no better: lamps at random positions
//! are 1.7 % too bright then, because the samples of one sequence are not independent.

use crate::math::Rgb;
use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Most samples of a pixel in an iteration; a power of two. With more, a few noisy pixels take most of the samples of the film and the time
/// of their band; with fewer, small lamps and their reflections stay noisy when the rest of the film is smooth.
pub(in crate::transport) const MOST_SAMPLES: usize = 64;
/// Least samples of a pixel in an iteration where it shows different surfaces or a texture: density estimates need them, too.
const SAMPLES_OF_HETEROGENEOUS: usize = 4;
/// Number of samples of a pixel over the relative standard deviation of one sample: 1 sample where it is below 6 %. Equal in all
/// scenes, because the noise of photons is.
const SAMPLES_PER_DEVIATION: f64 = 24.0;
/// Most samples beyond the least number, in the mean over the film: a pixel then has four samples on average, as before
/// the first refinement, and iterations do not become slower.
const MOST_EXTRA_SAMPLES: f64 = 3.0;
/// Step by which samples per deviation are lowered to keep to [`MOST_EXTRA_SAMPLES`], in halvings: a step takes some 8 % off the sum of
/// the counts.
const STEP: f64 = 0.125;
/// Most steps; then every pixel gets the least number.
const MOST_STEPS: usize = 100;
/// The standard deviation is taken over a square of this many pixels to each side: an edge between two pixels may run through either
/// of them, where few samples miss it.
const NEIGHBOUR_PIXELS: usize = 1;

/// Sums over the camera samples of a pixel.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct PixelSamples {
    /// Number of samples.
    pub count: u32,
    /// Weight of the samples' mean in the weighted mean over iterations.
    pub weight: f32,
    /// Sum of the radiance of the samples.
    pub sum: Rgb,
    /// Sum of the squared channels of the samples.
    pub squares: f32,
    /// The primitive that the first sample met, plus 1; 0 for none.
    pub surface: u32,
    /// Whether the samples met different surfaces, or a texture.
    pub is_heterogeneous: bool,
}

impl PixelSamples {
    /// Adds one sample.
    #[inline]
    pub(in crate::transport) fn include(&mut self, radiance: Rgb) {
        self.count += 1;
        self.sum += radiance;
        self.squares += radiance.length_squared();
    }

    /// Adds the samples of another iteration.
    fn add(&mut self, other: &Self) {
        self.is_heterogeneous |=
            other.is_heterogeneous || (self.count > 0 && other.count > 0 && self.surface != other.surface);
        self.count += other.count;
        self.sum += other.sum;
        self.squares += other.squares;
        self.surface = if other.count > 0 { other.surface } else { self.surface };
    }

    /// The mean radiance of the samples; black without samples.
    pub fn mean(&self) -> Rgb {
        self.sum / self.count.max(1) as f32
    }

    /// Whether all samples were finite.
    pub(in crate::transport) fn is_finite(&self) -> bool {
        self.sum.is_finite()
    }

    /// Variance of a single sample, summed over channels; 0 with less than two samples.
    fn variance(&self) -> f32 {
        let squares = (self.squares - self.mean().dot(self.sum)).max(0.0);
        squares / self.count.saturating_sub(1).max(1) as f32
    }
}

/// Sums over the samples of all iterations, for each pixel.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::transport) struct FilmSamples {
    width: usize,
    pixels: Vec<PixelSamples>,
}

impl FilmSamples {
    /// No samples yet.
    pub(in crate::transport) fn new(width: u32, height: u32) -> Self {
        let pixels = width as usize * height as usize;
        Self { width: width as usize, pixels: vec![PixelSamples::default(); pixels] }
    }

    /// Whether the samples are those of a film of this size.
    pub(in crate::transport) fn fits(&self, width: u32, height: u32) -> bool {
        self.width == width as usize && self.pixels.len() == self.width * height as usize
    }

    /// Indices of the pixels in the square around a pixel, itself included, clipped to the film.
    fn around(&self, index: usize) -> impl Iterator<Item = usize> {
        let (width, height) = (self.width, self.pixels.len() / self.width);
        let (x, y) = (index % width, index / width);
        let columns = x.saturating_sub(NEIGHBOUR_PIXELS)..(x + NEIGHBOUR_PIXELS + 1).min(width);
        let rows = y.saturating_sub(NEIGHBOUR_PIXELS)..(y + NEIGHBOUR_PIXELS + 1).min(height);
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }

    /// Adds the samples of an iteration.
    pub(in crate::transport) fn add(&mut self, samples: &[PixelSamples]) {
        self.pixels.iter_mut().zip(samples).for_each(|(sum, samples)| sum.add(samples));
    }
}

/// The samples of each pixel in the iterations from a refinement on.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(in crate::transport) struct SampleAllocation {
    first_iteration: u64,
    pixels: Vec<PixelAllocation>,
}

/// The samples of one pixel in the iterations from a refinement on.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct PixelAllocation {
    /// Index of the first sample in the pixel's sequence.
    first: u64,
    /// Samples of an iteration.
    count: u8,
    /// Samples of an iteration that the neighbouring pixels ask for.
    weight: u8,
}

impl SampleAllocation {
    /// The best allocation after iteration `i`; `next(pixel)` is the index of the first unused sample of a pixel's sequence.
    pub(in crate::transport) fn best(i: u64, samples: &FilmSamples, next: impl Fn(u32) -> u64 + Sync) -> Self {
        let deviations = deviations(samples, true);
        let counts = |scale: f64| {
            samples
                .pixels
                .par_iter()
                .zip(&deviations)
                .map(move |(pixel, deviation)| least_count(pixel).max(nearest_power(scale * deviation)))
        };
        let least: usize = samples.pixels.iter().map(least_count).sum();
        let most = least + (MOST_EXTRA_SAMPLES * samples.pixels.len() as f64) as usize;
        let too_many = |scale: f64| counts(scale).sum::<usize>() > most;
        let scales = (0..).map(|step| SAMPLES_PER_DEVIATION * (-STEP * f64::from(step)).exp2());
        let scale = scales.take(MOST_STEPS).find(|&scale| !too_many(scale)).unwrap_or(0.0);
        let deviations_around = self::deviations(samples, false);
        let pixel = |((pixel, count), deviation): ((usize, usize), &f64)| {
            let around = samples.around(pixel).filter(|&other| other != pixel);
            // The only pixel of a film has no neighbours: all its iterations weigh the same.
            let least =
                around.map(|other| least_count(&samples.pixels[other])).min().unwrap_or(SAMPLES_OF_HETEROGENEOUS);
            PixelAllocation {
                first: next(pixel as u32).next_multiple_of(count as u64),
                count: count as u8,
                weight: least.max(nearest_power(scale * deviation)) as u8,
            }
        };
        Self { first_iteration: i + 1, pixels: counts(scale).enumerate().zip(&deviations_around).map(pixel).collect() }
    }

    /// Whether this allocation is for a film of `pixels` pixels and for the iteration `next` and later ones.
    pub(in crate::transport) fn fits(&self, pixels: usize, next: u64) -> bool {
        let is_count = |count: u8| count.is_power_of_two() && usize::from(count) <= MOST_SAMPLES;
        self.pixels.len() == pixels
            && self.first_iteration <= next
            && self.pixels.iter().all(|pixel| is_count(pixel.count) && is_count(pixel.weight))
    }

    /// Weight of the mean of a pixel's samples of an iteration, in samples of the first iterations.
    #[inline]
    pub(in crate::transport) fn weight(&self, pixel: u32) -> f32 {
        f32::from(self.pixels[pixel as usize].weight)
    }

    /// Indices of a pixel's samples in an iteration, in the pixel's sequence.
    #[inline]
    pub(in crate::transport) fn at(&self, pixel: u32, iteration: u64) -> Range<u64> {
        let PixelAllocation { first, count, .. } = self.pixels[pixel as usize];
        let start = first + (iteration - self.first_iteration) * u64::from(count);
        start..start + u64::from(count)
    }
}

fn least_count(pixel: &PixelSamples) -> usize {
    if pixel.is_heterogeneous { SAMPLES_OF_HETEROGENEOUS } else { 1 }
}

/// The power of two nearest to a number of samples, at most [`MOST_SAMPLES`].
fn nearest_power(wanted: f64) -> usize {
    1 << wanted.clamp(1.0, MOST_SAMPLES as f64).log2().round() as u32
}

/// Relative standard deviation of the samples around each pixel: over the pixel's radiance where it is bright, over the mean of the
/// picture where it is dark: viewers judge noise by contrast. With or without the pixel's own samples.
fn deviations(samples: &FilmSamples, with_own: bool) -> Vec<f64> {
    let pixels = &samples.pixels;
    let mean = pixels.iter().map(|p| f64::from(p.mean().element_sum())).sum::<f64>() / pixels.len() as f64;
    let deviation = |index: usize| {
        let near = samples.around(index).filter(|&other| with_own || other != index);
        let (mut count, mut sum, mut squares) = (0.0, DVec3::ZERO, 0.0);
        for pixel in near.map(|index| &pixels[index]) {
            let mean = pixel.mean().as_dvec3();
            count += 1.0;
            sum += mean;
            squares += f64::from(pixel.variance()) + mean.length_squared();
        }
        let count = f64::max(count, 1.0);
        let variance = (squares - sum.length_squared() / count) / count;
        let brightness =
            if with_own { f64::from(pixels[index].mean().element_sum()) } else { sum.element_sum() / count };
        (variance.max(0.0) / (brightness.powi(2) + mean * mean).max(f64::MIN_POSITIVE)).sqrt()
    };
    (0..pixels.len()).into_par_iter().map(deviation).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: u32 = 16;
    const PIXELS: u32 = SIZE * SIZE;

    /// Eight samples a pixel: one with the first radiance, seven with the second.
    fn film(radiances: impl Fn(u32) -> [f32; 2], is_on_an_edge: impl Fn(u32) -> bool) -> FilmSamples {
        let mut film = FilmSamples::new(SIZE, SIZE);
        let pixel = |pixel| {
            let [first, second] = radiances(pixel).map(Rgb::splat);
            let mut samples =
                PixelSamples { surface: 1, is_heterogeneous: is_on_an_edge(pixel), ..PixelSamples::default() };
            samples.include(first);
            (0..7).for_each(|_| samples.include(second));
            samples
        };
        film.add(&(0..PIXELS).map(pixel).collect::<Vec<_>>());
        film
    }

    fn counts(film: &FilmSamples) -> Vec<usize> {
        let best = SampleAllocation::best(4, film, |_| 8);
        (0..PIXELS).map(|pixel| best.at(pixel, 5).count()).collect()
    }

    #[test]
    fn samples_that_agree_are_few() {
        assert_eq!(counts(&film(|_| [0.7; 2], |_| false)), vec![1; PIXELS as usize]);
        assert_eq!(counts(&film(|_| [0.0; 2], |_| false)), vec![1; PIXELS as usize], "a black picture");
        let heterogeneous = counts(&film(|_| [0.7; 2], |pixel| pixel == 3));
        assert_eq!((heterogeneous[3], heterogeneous[4]), (SAMPLES_OF_HETEROGENEOUS, 1));
    }

    #[test]
    fn samples_that_differ_are_many_also_beside_their_pixel() {
        let at = 5 * SIZE + 5;
        let counts = self::counts(&film(|pixel| [if pixel == at { 40.0 } else { 0.5 }, 0.5], |_| false));
        assert!(counts[at as usize] >= 8, "{counts:?}");
        assert_eq!(counts[(at + SIZE + 1) as usize], MOST_SAMPLES, "dark, so that it matters more");
        assert_eq!(counts[(at + 2) as usize], 1);
        // An edge between two pixels may run through either of them.
        let between = self::counts(&film(|pixel| [if pixel % SIZE < 8 { 0.2 } else { 0.6 }; 2], |_| false));
        assert!(between[7] >= 4 && between[8] >= 4 && between[6] == 1 && between[9] == 1, "{between:?}");
    }

    /// A weight by a pixel's own samples would be high where few of them meet a lamp, and the mean of the pixel too dark.
    #[test]
    fn weights_do_not_depend_on_the_pixels_own_samples() {
        let at = 5 * SIZE + 5;
        let weights = |radiance: f32| {
            let film =
                film(|pixel| if pixel == at { [radiance, 0.5] } else { [0.5 + (pixel % 3) as f32, 0.5] }, |_| false);
            let best = SampleAllocation::best(4, &film, |_| 8);
            (best.weight(at), best.weight(at + 1))
        };
        let (dark, bright) = (weights(0.0), weights(12.0));
        assert_eq!(dark.0, bright.0);
        assert!(dark.0 > 1.0 && bright.1 > dark.1, "{dark:?} {bright:?}");
    }

    #[test]
    fn samples_weigh_more_where_all_neighbours_get_more() {
        let best = SampleAllocation::best(4, &film(|_| [0.7; 2], |pixel| pixel % SIZE < 8), |_| 8);
        let row = 5 * SIZE;
        assert_eq!([6, 7, 8, 9].map(|x| best.weight(row + x)), [SAMPLES_OF_HETEROGENEOUS as f32, 1.0, 1.0, 1.0]);
    }

    #[test]
    fn alone_on_its_film_a_pixel_weighs_alike_in_all_full_iterations() {
        let mut film = FilmSamples::new(1, 1);
        film.add(&[PixelSamples { count: 8, sum: Rgb::ONE, squares: 3.0, surface: 1, ..PixelSamples::default() }]);
        let best = SampleAllocation::best(4, &film, |_| 8);
        assert_eq!((best.at(0, 5).count(), best.weight(0)), (4, 4.0));
    }

    #[test]
    fn twice_the_deviation_asks_for_twice_the_samples_but_not_without_end() {
        let noisy = |amplitude: f32| counts(&film(|_| [1.0 + amplitude, 1.0], |_| false))[0];
        assert_eq!([0.3, 0.6, 1.2].map(noisy), [1, 2, 4]);
        assert!(counts(&film(|_| [30.0, 0.0], |_| false)).iter().sum::<usize>() <= 4 * PIXELS as usize);
    }

    #[test]
    fn each_sample_of_a_sequence_belongs_to_one_iteration() {
        let noisy = film(|pixel| [0.5 + (pixel % SIZE) as f32, 0.5], |_| false);
        let first = SampleAllocation::best(4, &noisy, |_| 8);
        let next = SampleAllocation::best(8, &noisy, |pixel| first.at(pixel, 8).end);
        for pixel in 0..PIXELS {
            let mut end = 8;
            for range in (5..=8).map(|i| first.at(pixel, i)).chain((9..20).map(|i| next.at(pixel, i))) {
                let count = range.end - range.start;
                assert!(range.start >= end && range.start % count == 0 && count.is_power_of_two(), "{range:?} {end}");
                end = range.end;
            }
        }
    }

    #[test]
    fn a_pixel_that_shows_another_surface_later_is_heterogeneous() {
        let one = |surface| {
            let mut samples = PixelSamples { surface, ..PixelSamples::default() };
            samples.include(Rgb::ONE);
            samples
        };
        let mut film = FilmSamples::new(1, 1);
        film.add(&[one(1)]);
        film.add(&[one(1)]);
        assert_eq!(counts_of_one(&film), 1);
        film.add(&[one(2)]);
        assert_eq!(counts_of_one(&film), SAMPLES_OF_HETEROGENEOUS);
    }

    fn counts_of_one(film: &FilmSamples) -> usize {
        SampleAllocation::best(4, film, |_| 8).at(0, 5).count()
    }
}
