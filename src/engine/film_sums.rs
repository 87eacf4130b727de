use crate::film::LinearImage;
use crate::math::Rgb;
use glam::DVec3;

/// The film: sums over iterations. Sums of iterations 1 to n equal the merged sums of its parts.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmSums {
    width: u32,
    height: u32,
    iterations: u64,
    weight: f64,
    /// Over all iterations, times their weights, in double precision: single stalls after some ten million additions. Empty
    /// before the first: a scene that is edited again at once needs no film.
    all: Vec<DVec3>,
    /// Over the first ones, as many as the greatest power of two that leaves others: how much they differ from these tells
    /// the error. Not over every other one: neighbours in a sequence of low discrepancy complement each other, and
    /// differ more than their mean errs.
    first: Vec<DVec3>,
    first_weight: f64,
}

impl FilmSums {
    /// Nothing yet.
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, iterations: 0, weight: 0.0, all: Vec::new(), first: Vec::new(), first_weight: 0.0 }
    }

    fn pixel_count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Adds the next iteration, a radiance for each pixel, to the mean with this weight.
    pub fn commit(&mut self, weight: f64, radiance: &[Rgb]) {
        debug_assert_eq!(radiance.len(), self.pixel_count(), "an iteration covers the film");
        self.all.resize(self.pixel_count(), DVec3::ZERO);
        if self.iterations.is_power_of_two() {
            self.end_first();
        }
        self.all.iter_mut().zip(radiance).for_each(|(sum, r)| *sum += weight * r.as_dvec3());
        self.iterations += 1;
        self.weight += weight;
    }

    /// Adds the iterations of another film of the same size, which follow these.
    pub fn merge(&mut self, other: &Self) {
        debug_assert_eq!((other.width, other.height), (self.width, self.height), "films of one size");
        self.all.resize(self.pixel_count(), DVec3::ZERO);
        self.end_first();
        self.all.iter_mut().zip(&other.all).for_each(|(sum, x)| *sum += x);
        self.iterations += other.iterations;
        self.weight += other.weight;
    }

    /// What follows is compared with what is there.
    fn end_first(&mut self) {
        self.first.clone_from(&self.all);
        self.first_weight = self.weight;
    }

    /// How many iterations were added.
    pub fn iterations(&self) -> u64 {
        self.iterations
    }

    /// The mean of the iterations; black before the first.
    pub fn image(&self) -> LinearImage {
        if self.all.is_empty() {
            return LinearImage::black(self.width, self.height);
        }
        let scale = 1.0 / self.weight;
        let pixels = self.all.iter().map(|sum| (*sum * scale).as_vec3()).collect();
        LinearImage { width: self.width, height: self.height, pixels }
    }

    /// Estimate of the RMSE of the image over its mean: of its noise, from the difference of the means of the first iterations and
    /// of the others, and of its bias, whose mean square over pixels and channels is given. `None` before the second iteration
    /// and for a black picture.
    pub fn error_estimate(&self, squared_bias: f64) -> Option<f64> {
        let other_weight = self.weight - self.first_weight;
        if !(other_weight > 0.0 && self.first_weight > 0.0) {
            return None;
        }
        let (first_scale, other_scale) = (1.0 / self.first_weight, 1.0 / other_weight);
        let (mut squares, mut total) = (0.0, 0.0);
        for (all, first) in self.all.iter().zip(&self.first) {
            squares += (*first * first_scale - (*all - *first) * other_scale).length_squared();
            total += all.element_sum();
        }
        // The difference of two independent parts has the variance V / w0 + V / w1, their mean V / (w0 + w1).
        let part = (self.first_weight * other_weight).sqrt() / self.weight;
        let values = 3.0 * self.all.len() as f64;
        let mean = total / values / self.weight;
        (mean > 0.0).then(|| (part * part * squares / values + squared_bias).sqrt() / mean)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, Stream};

    fn noise(iteration: u64) -> Vec<Rgb> {
        let value = |pixel| Sampler::new(1, Stream::Test, iteration, pixel).next_1d() as f32;
        (0..400).map(|pixel| Rgb::splat(value(pixel))).collect()
    }

    #[test]
    fn parts_merge_to_the_whole() {
        let mut whole = FilmSums::new(20, 20);
        let mut parts = [whole.clone(), whole.clone()];
        for i in 1..=9 {
            whole.commit(0.5 + i as f64, &noise(i));
            parts[usize::from(i > 4)].commit(0.5 + i as f64, &noise(i));
        }
        let [mut first, second] = parts;
        first.merge(&second);
        assert_eq!(first.iterations(), 9);
        for (a, b) in first.image().pixels.iter().zip(&whole.image().pixels) {
            assert!((*a - *b).abs().max_element() <= 1e-6, "{a} against {b}");
        }
    }

    #[test]
    fn two_parts_estimate_the_error() {
        let mut film = FilmSums::new(20, 20);
        assert_eq!(film.error_estimate(0.0), None);
        for i in 1..=64 {
            film.commit(1.0, &noise(i));
            // Uniform numbers have the standard deviation 0.2887 and the mean 0.5; 400 pixels know it to 4 %.
            let expected = 0.577 / (i as f64).sqrt();
            let off = |estimate: f64| (estimate / expected - 1.0).abs();
            assert!(film.error_estimate(0.0).map_or(i == 1, |estimate| off(estimate) < 0.16), "iteration {i}");
        }
    }

    #[test]
    fn a_billion_equal_iterations_keep_counting() {
        let mut film = FilmSums::new(1, 1);
        film.all = vec![DVec3::splat(1e9)];
        film.iterations = 1_000_000_000;
        film.commit(1.0, &[Rgb::splat(2.0)]);
        assert_eq!(film.all[0].x, 1e9 + 2.0);
    }
}
