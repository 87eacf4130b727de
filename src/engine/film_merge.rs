//! Films of consecutive iterations of a run become one film.

use super::film_sums::{FilmSums, PixelSums, greatest_power_below};

impl FilmSums {
    /// Adds the iterations of another film of the same size, which follow the iterations of this film. The estimate of the error is that of
    /// one run, but for a small part of it where `next` goes past three powers of two.
    pub fn merge(&mut self, next: &Self) {
        debug_assert_eq!((next.width, next.height), (self.width, self.height), "films of one size");
        debug_assert_eq!(next.before, self.last(), "consecutive films");
        if next.iterations == 0 || self.iterations == 0 {
            let before = self.before;
            if self.iterations == 0 {
                self.clone_from(next);
            }
            self.before = before;
            return;
        }
        let (last, split) = (self.last(), greatest_power_below(next.last()));
        if last.is_power_of_two() {
            self.end_first();
        }
        if split > last {
            // As one run, which compares its halves at each power of two.
            if last < split / 2 {
                self.add(next.earlier.iter().copied(), next.earlier_weight);
                self.end_first();
                let between = next.first.iter().zip(&next.earlier).map(|(first, earlier)| *first - *earlier);
                self.add(between, next.first_weight - next.earlier_weight);
            } else {
                self.add(next.first.iter().copied(), next.first_weight);
            }
            self.end_first();
            let rest = next.all.iter().zip(&next.first).map(|(all, first)| *all - *first);
            self.add(rest, next.weight - next.first_weight);
        } else {
            self.add(next.all.iter().copied(), next.weight);
        }
        self.iterations += next.iterations;
    }

    fn add(&mut self, sums: impl Iterator<Item = PixelSums>, weight: f64) {
        self.all.iter_mut().zip(sums).for_each(|(all, sums)| *all += sums);
        self.weight += weight;
    }

    /// The greatest absolute difference between the sums of two films of one size, over the greatest sum.
    pub fn greatest_difference(&self, other: &Self) -> f64 {
        let greatest = |sums: PixelSums| {
            let samples = sums.samples.abs().max_element().max(sums.samples_weight.abs());
            sums.photons.abs().max_element().max(samples)
        };
        let difference = self.all.iter().zip(&other.all).map(|(a, b)| greatest(*a - *b)).fold(0.0, f64::max);
        difference / self.all.iter().copied().map(greatest).fold(f64::MIN_POSITIVE, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Rgb, Sampler, Stream};
    use crate::transport::PixelSamples;

    const SIDE: u32 = 16;
    const PIXELS: u64 = (SIDE * SIDE) as u64;

    /// The film of these iterations, whose photons and samples are noise.
    fn film(iterations: std::ops::RangeInclusive<u64>) -> FilmSums {
        let mut film = FilmSums::after(SIDE, SIDE, iterations.start() - 1);
        for i in iterations {
            let value = |pixel: u64| Rgb::splat(Sampler::new(1, Stream::Camera, i, pixel).next_1d() as f32);
            let photons: Vec<Rgb> = (0..PIXELS).map(value).collect();
            let sample =
                |pixel| PixelSamples { count: 1, sum: value(pixel), weight: (i % 3) as f32, ..PixelSamples::default() };
            film.commit(0.5 + (i % 5) as f64, &photons, &(0..PIXELS).map(sample).collect::<Vec<_>>());
        }
        film
    }

    /// The merged film of ranges of iterations that end with these numbers.
    fn merged(ends: &[u64]) -> FilmSums {
        let mut all = FilmSums::new(SIDE, SIDE);
        for end in ends {
            all.merge(&film(all.last() + 1..=*end));
        }
        all
    }

    #[test]
    fn ranges_merge_to_the_whole() {
        assert_eq!(merged(&[9]), film(1..=9));
        let mut part = film(5..=8);
        part.merge(&FilmSums::after(SIDE, SIDE, 8));
        assert_eq!(part, film(5..=8));
        for ends in [&[4, 9][..], &[5, 6, 9], &[1, 2, 3, 4, 5, 6, 7, 8, 9], &[8, 9], &[3, 9]] {
            let (merged, whole) = (merged(ends), film(1..=9));
            assert_eq!((merged.first(), merged.last(), merged.weight), (1, 9, whole.weight));
            assert!(merged.greatest_difference(&whole) < 1e-14, "{ends:?}");
        }
    }

    #[test]
    fn the_error_of_merged_parts_is_that_of_one_run() {
        let error = |film: &FilmSums| film.error_estimate(0.0).unwrap();
        for (ends, tolerance) in [
            (&[32, 64, 100][..], 1e-9),
            (&[10, 20, 30, 40, 50, 60, 70, 80, 90, 100], 1e-9),
            (&[33, 66, 100], 1e-9),
            (&[64, 65, 100], 1e-9),
            (&[99, 100], 1e-9),
            (&[20, 100], 1e-9),
            (&[16, 90, 100], 1e-9),
            (&[5, 100], 0.02),
        ] {
            let (merged, whole) = (error(&merged(ends)), error(&film(1..=100)));
            assert!((merged / whole - 1.0).abs() < tolerance, "{ends:?}: {merged}, one run {whole}");
        }
    }
}
