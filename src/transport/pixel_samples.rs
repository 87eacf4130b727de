//! How many samples of direct light each pixel gets: many where they differ, one where they agree. For so many samples in
//! all, the error of the picture is least where a pixel's samples go with their standard deviation \[Neyman34\].
//!
//! In its pixel's mean an iteration weighs by the number of samples too, so that the few of the first ones do not count as much
//! as the many of later ones. But by the number that the pixels around ask for: if it went by a pixel's own samples, the mean
//! would be biased, because few hits make for few samples, and so for much weight of the samples so far. Some of that is left,
//! because those around have more samples where its own differ: lamps of a fifth of a pixel at pixels' corners are 4 % too dark
//! after 16 iterations, 0.5 % after 64, a small part of their noise. Weights that are told by samples taken in any case do no
//! better: such lamps at random places are 1.7 % too bright then, because samples of a sequence are not independent.

use crate::math::Rgb;
use glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;

/// Samples that a pixel gets in an iteration at most; a power of two.
pub(super) const MOST_SAMPLES: usize = 64;
/// And at least, where different surfaces or a texture are seen in it: what is gathered there needs them too.
const SAMPLES_OF_VARIED: usize = 4;
/// Samples of a pixel over the relative deviation of one of them: 1 where it is below 6 %. The same in all scenes, because the
/// noise of photons is.
const SAMPLES_PER_DEVIATION: f64 = 24.0;
/// Samples beyond the least of each pixel at most, in the mean over the film.
const MOST_EXTRA_SAMPLES: f64 = 3.0;
/// Attempts to keep to that.
const MOST_STEPS: usize = 100;
/// The deviation is that of all samples in a square of this many pixels to each side: an edge that shows between pixels may
/// run through either of them, where few samples miss it.
const REACH: usize = 1;

/// Sums over samples of a pixel, by which it is told how much they differ.
#[derive(Clone, Copy, Debug, Default)]
pub struct PixelSamples {
    /// How many there were.
    pub count: u32,
    /// How much their mean weighs in the pixel's, beside those of other iterations.
    pub weight: f32,
    /// Their sum.
    pub sum: Rgb,
    /// The sum of the squares of their channels.
    pub squares: f32,
    /// The surface that they met first, by a number that is 0 for none.
    pub surface: u32,
    /// Whether they met several, or a texture.
    pub is_varied: bool,
}

impl PixelSamples {
    /// Adds one sample.
    pub(super) fn include(&mut self, radiance: Rgb) {
        self.count += 1;
        self.sum += radiance;
        self.squares += radiance.length_squared();
    }

    /// With others of the same pixel.
    fn add(&mut self, other: &Self) {
        self.is_varied |= other.is_varied || (self.count > 0 && other.count > 0 && self.surface != other.surface);
        self.count += other.count;
        self.sum += other.sum;
        self.squares += other.squares;
        self.surface = if other.count > 0 { other.surface } else { self.surface };
    }

    /// The mean of the samples; black where there are none.
    pub fn mean(&self) -> Rgb {
        self.sum / self.count.max(1) as f32
    }

    /// Whether no sample was infinite or not a number.
    pub(super) fn is_finite(&self) -> bool {
        self.sum.is_finite()
    }

    /// Of a single sample, summed over channels; 0 where there are less than two.
    fn variance(&self) -> f32 {
        let squares = (self.squares - self.mean().dot(self.sum)).max(0.0);
        squares / self.count.saturating_sub(1).max(1) as f32
    }
}

/// All samples of all pixels so far.
#[derive(Clone, Debug)]
pub(super) struct FilmSamples {
    width: usize,
    pixels: Vec<PixelSamples>,
}

impl FilmSamples {
    /// None yet.
    pub(super) fn new(width: u32, height: u32) -> Self {
        let pixels = width as usize * height as usize;
        Self { width: width as usize, pixels: vec![PixelSamples::default(); pixels] }
    }

    /// The places of the pixels of the square around a pixel, itself included, as far as it lies on the film.
    fn around(&self, index: usize) -> impl Iterator<Item = usize> {
        let (width, height) = (self.width, self.pixels.len() / self.width);
        let (x, y) = (index % width, index / width);
        let columns = x.saturating_sub(REACH)..(x + REACH + 1).min(width);
        let rows = y.saturating_sub(REACH)..(y + REACH + 1).min(height);
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }

    /// Adds those of an iteration.
    pub(super) fn add(&mut self, samples: &[PixelSamples]) {
        self.pixels.iter_mut().zip(samples).for_each(|(sum, samples)| sum.add(samples));
    }
}

/// Which samples of each pixel's sequence belong to the iterations from some on.
#[derive(Clone, Debug)]
pub(super) struct SampleCounts {
    first_iteration: u64,
    pixels: Vec<PixelCount>,
}

/// Which samples of a pixel's sequence belong to the iterations from some on.
#[derive(Clone, Copy, Debug)]
struct PixelCount {
    first: u64,
    /// In each iteration.
    count: u8,
    /// As many as the pixels around it ask for.
    weight: u8,
}

impl SampleCounts {
    /// The best ones after iteration `i`, until which pixels took the samples before `next` of their sequence.
    pub(super) fn best(i: u64, samples: &FilmSamples, next: impl Fn(u32) -> u64 + Sync) -> Self {
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
        // Each step is an eighth of a doubling.
        let scales = (0..).map(|step| SAMPLES_PER_DEVIATION * (-0.125 * f64::from(step)).exp2());
        let scale = scales.take(MOST_STEPS).find(|&scale| !too_many(scale)).unwrap_or(0.0);
        let deviations_around = self::deviations(samples, false);
        let pixel = |((pixel, count), deviation): ((usize, usize), &f64)| {
            let around = samples.around(pixel).filter(|&other| other != pixel);
            // Alone on its film, all its iterations weigh alike.
            let least = around.map(|other| least_count(&samples.pixels[other])).min().unwrap_or(SAMPLES_OF_VARIED);
            PixelCount {
                first: next(pixel as u32).next_multiple_of(count as u64),
                count: count as u8,
                weight: least.max(nearest_power(scale * deviation)) as u8,
            }
        };
        Self { first_iteration: i + 1, pixels: counts(scale).enumerate().zip(&deviations_around).map(pixel).collect() }
    }

    /// How much the mean of a pixel's samples of an iteration weighs: the same as so many samples of the first iterations.
    pub(super) fn weight(&self, pixel: u32) -> f32 {
        f32::from(self.pixels[pixel as usize].weight)
    }

    /// The samples of a pixel in an iteration.
    pub(super) fn at(&self, pixel: u32, iteration: u64) -> Range<u64> {
        let PixelCount { first, count, .. } = self.pixels[pixel as usize];
        let start = first + (iteration - self.first_iteration) * u64::from(count);
        start..start + u64::from(count)
    }
}

fn least_count(pixel: &PixelSamples) -> usize {
    if pixel.is_varied { SAMPLES_OF_VARIED } else { 1 }
}

/// The power of two nearest to what is wanted, as far as a pixel may have so many samples.
fn nearest_power(wanted: f64) -> usize {
    1 << wanted.clamp(1.0, MOST_SAMPLES as f64).log2().round() as u32
}

/// By how much samples differ in each pixel, over its radiance where it is bright and over the picture's where it is dark:
/// what matters in a picture that is looked at. With or without the pixel's own samples.
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

    /// Eight samples a pixel: one with the first radiance, the others with the second.
    fn film(radiances: impl Fn(u32) -> [f32; 2], is_on_an_edge: impl Fn(u32) -> bool) -> FilmSamples {
        let mut film = FilmSamples::new(SIZE, SIZE);
        let pixel = |pixel| {
            let [first, others] = radiances(pixel).map(Rgb::splat);
            let mut samples = PixelSamples { surface: 1, is_varied: is_on_an_edge(pixel), ..PixelSamples::default() };
            samples.include(first);
            (0..7).for_each(|_| samples.include(others));
            samples
        };
        film.add(&(0..PIXELS).map(pixel).collect::<Vec<_>>());
        film
    }

    fn counts(film: &FilmSamples) -> Vec<usize> {
        let best = SampleCounts::best(4, film, |_| 8);
        (0..PIXELS).map(|pixel| best.at(pixel, 5).count()).collect()
    }

    #[test]
    fn samples_that_agree_are_few() {
        assert_eq!(counts(&film(|_| [0.7; 2], |_| false)), vec![1; PIXELS as usize]);
        assert_eq!(counts(&film(|_| [0.0; 2], |_| false)), vec![1; PIXELS as usize], "a black picture");
        let varied = counts(&film(|_| [0.7; 2], |pixel| pixel == 3));
        assert_eq!((varied[3], varied[4]), (SAMPLES_OF_VARIED, 1));
    }

    #[test]
    fn where_they_differ_they_are_many_and_beside_it_too() {
        let at = 5 * SIZE + 5;
        let counts = self::counts(&film(|pixel| [if pixel == at { 40.0 } else { 0.5 }, 0.5], |_| false));
        assert!(counts[at as usize] >= 8, "{counts:?}");
        assert_eq!(counts[(at + SIZE + 1) as usize], MOST_SAMPLES, "dark, so that it matters more");
        assert_eq!(counts[(at + 2) as usize], 1);
        // An edge between two pixels may run through either of them.
        let between = self::counts(&film(|pixel| [if pixel % SIZE < 8 { 0.2 } else { 0.6 }; 2], |_| false));
        assert!(between[7] >= 4 && between[8] >= 4 && between[6] == 1 && between[9] == 1, "{between:?}");
    }

    /// Else few hits would make for much weight, and a pixel's mean would be too dark.
    #[test]
    fn weights_do_not_depend_on_the_pixels_own_samples() {
        let at = 5 * SIZE + 5;
        let weights = |radiance: f32| {
            let film =
                film(|pixel| if pixel == at { [radiance, 0.5] } else { [0.5 + (pixel % 3) as f32, 0.5] }, |_| false);
            let best = SampleCounts::best(4, &film, |_| 8);
            (best.weight(at), best.weight(at + 1))
        };
        let (dark, bright) = (weights(0.0), weights(12.0));
        assert_eq!(dark.0, bright.0);
        assert!(dark.0 > 1.0 && bright.1 > dark.1, "{dark:?} {bright:?}");
    }

    #[test]
    fn where_all_pixels_around_get_more_samples_they_weigh_more() {
        let best = SampleCounts::best(4, &film(|_| [0.7; 2], |pixel| pixel % SIZE < 8), |_| 8);
        let row = 5 * SIZE;
        assert_eq!([6, 7, 8, 9].map(|x| best.weight(row + x)), [SAMPLES_OF_VARIED as f32, 1.0, 1.0, 1.0]);
    }

    #[test]
    fn alone_on_its_film_a_pixel_weighs_alike_in_all_full_iterations() {
        let mut film = FilmSamples::new(1, 1);
        film.add(&[PixelSamples { count: 8, sum: Rgb::ONE, squares: 3.0, surface: 1, ..PixelSamples::default() }]);
        let best = SampleCounts::best(4, &film, |_| 8);
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
        let first = SampleCounts::best(4, &noisy, |_| 8);
        let next = SampleCounts::best(8, &noisy, |pixel| first.at(pixel, 8).end);
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
    fn a_pixel_that_shows_another_surface_later_is_varied() {
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
        assert_eq!(counts_of_one(&film), SAMPLES_OF_VARIED);
    }

    fn counts_of_one(film: &FilmSamples) -> usize {
        SampleCounts::best(4, film, |_| 8).at(0, 5).count()
    }
}
