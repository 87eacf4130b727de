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
    /// Over all iterations, times their weights, in double precision: single stalls after some ten million additions.
    all: Vec<DVec3>,
    /// Over the even ones: two independent halves tell the error of their mean.
    even: Vec<DVec3>,
    even_weight: f64,
}

impl FilmSums {
    /// Nothing yet.
    pub fn new(width: u32, height: u32) -> Self {
        let zero = vec![DVec3::ZERO; width as usize * height as usize];
        Self { width, height, iterations: 0, weight: 0.0, all: zero.clone(), even: zero, even_weight: 0.0 }
    }

    /// Adds iteration number `iteration`, a radiance for each pixel, to the mean with this weight.
    pub fn commit(&mut self, iteration: u64, weight: f64, radiance: &[Rgb]) {
        debug_assert_eq!(radiance.len(), self.all.len(), "an iteration covers the film");
        let add = |sums: &mut [DVec3]| sums.iter_mut().zip(radiance).for_each(|(sum, r)| *sum += weight * r.as_dvec3());
        add(&mut self.all);
        self.iterations += 1;
        self.weight += weight;
        if iteration.is_multiple_of(2) {
            add(&mut self.even);
            self.even_weight += weight;
        }
    }

    /// Adds the iterations of another film of the same size.
    pub fn merge(&mut self, other: &Self) {
        debug_assert_eq!(other.all.len(), self.all.len(), "films of one size");
        self.all.iter_mut().zip(&other.all).for_each(|(sum, x)| *sum += x);
        self.even.iter_mut().zip(&other.even).for_each(|(sum, x)| *sum += x);
        self.iterations += other.iterations;
        self.weight += other.weight;
        self.even_weight += other.even_weight;
    }

    /// How many iterations were added.
    pub fn iterations(&self) -> u64 {
        self.iterations
    }

    /// The mean of the iterations; black before the first.
    pub fn image(&self) -> LinearImage {
        let scale = if self.weight > 0.0 { 1.0 / self.weight } else { 0.0 };
        let pixels = self.all.iter().map(|sum| (*sum * scale).as_vec3()).collect();
        LinearImage { width: self.width, height: self.height, pixels }
    }

    /// Estimate of the RMSE of the image over its mean, from the difference of the means of the even and the odd
    /// iterations; it does not see bias. `None` before the second iteration and for a black picture.
    pub fn error_estimate(&self) -> Option<f64> {
        let odd_weight = self.weight - self.even_weight;
        if !(odd_weight > 0.0 && self.even_weight > 0.0) {
            return None;
        }
        let (even_scale, odd_scale) = (1.0 / self.even_weight, 1.0 / odd_weight);
        let (mut squares, mut total) = (0.0, 0.0);
        for (all, even) in self.all.iter().zip(&self.even) {
            squares += (*even * even_scale - (*all - *even) * odd_scale).length_squared();
            total += all.element_sum();
        }
        // The difference of two independent halves has the variance V / w0 + V / w1, their mean V / (w0 + w1).
        let part = (self.even_weight * odd_weight).sqrt() / self.weight;
        let values = 3.0 * self.all.len() as f64;
        let mean = total / values / self.weight;
        (mean > 0.0).then(|| part * (squares / values).sqrt() / mean)
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
            whole.commit(i, 0.5 + i as f64, &noise(i));
            parts[usize::from(i > 4)].commit(i, 0.5 + i as f64, &noise(i));
        }
        let [mut first, second] = parts;
        first.merge(&second);
        assert_eq!(first.iterations(), 9);
        for (a, b) in first.image().pixels.iter().zip(&whole.image().pixels) {
            assert!((*a - *b).abs().max_element() <= 1e-6, "{a} against {b}");
        }
    }

    #[test]
    fn halves_estimate_the_error() {
        let mut film = FilmSums::new(20, 20);
        assert_eq!(film.error_estimate(), None);
        for i in 1..=64 {
            film.commit(i, 1.0, &noise(i));
        }
        // Uniform numbers have the standard deviation 0.2887 and the mean 0.5: 0.577 / 8; 400 pixels know it to 4 %.
        let estimate = film.error_estimate().expect("two halves");
        assert!((estimate - 0.0722).abs() < 0.012, "{estimate}");
    }

    #[test]
    fn a_billion_equal_iterations_keep_counting() {
        let mut film = FilmSums::new(1, 1);
        film.all[0] = DVec3::splat(1e9);
        film.iterations = 1_000_000_000;
        film.commit(1_000_000_001, 1.0, &[Rgb::splat(2.0)]);
        assert_eq!(film.all[0].x, 1e9 + 2.0);
    }
}
