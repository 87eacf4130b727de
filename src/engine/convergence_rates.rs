//! The convergence rate of stratified samples, fitted to the measured noise.

use serde::{Deserialize, Serialize};

/// Convergence rates: the variance of the mean of `n` samples of a pixel falls like `n` to the negative power of one of these, or one in
/// between: 1 in glossy reflections, 1.5 where an edge runs through the pixel \[Mitchell96\], up to 3 where the light is smooth and
/// `n` a power of two \[Owen97\].
const RATES: [f64; 5] = [1.0, 1.5, 2.0, 2.5, 3.0];
/// Index of the greatest rate for other numbers than powers of two, whose last samples are not balanced by further ones.
const UNBALANCED: usize = 1;

/// Variances for each rate, from the difference between the first and the other samples of each pixel; sums over pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct ConvergenceRates {
    /// Variance of the mean of samples with weight 1.
    of_one: [f64; RATES.len()],
    /// Variance of the mean of all samples.
    of_all: [f64; RATES.len()],
}

impl ConvergenceRates {
    /// Adds a pixel: the squared difference, summed over channels, between the means of its first and its other samples, with the weights
    /// of both.
    pub(super) fn include(&mut self, squared_difference: f64, first: f64, other: f64) {
        if !(first > 0.0 && other > 0.0) {
            return;
        }
        let all = first + other;
        let (of_first, of_other, of_all) = (variances(first), variances(other), variances(all));
        let last = if is_power_of_two(all) { RATES.len() - 1 } else { UNBALANCED };
        for (k, (one_sum, all_sum)) in self.of_one.iter_mut().zip(&mut self.of_all).enumerate() {
            let k = k.min(last);
            // The two sets complement each other, so their errors are correlated. The covariance follows from the rate, which holds for
            // both sets and for all samples, whose mean is the mean of both.
            let squared = |weight: f64, variance: f64| weight * weight * variance;
            let covariances = squared(all, of_all[k]) - squared(first, of_first[k]) - squared(other, of_other[k]);
            let of_difference = of_first[k] + of_other[k] - covariances / (first * other);
            let of_one = squared_difference / of_difference;
            *one_sum += of_one;
            *all_sum += of_one * of_all[k];
        }
    }

    /// The squared noise of the mean of all samples, at the rate by which both sets and the halves of the first set agree on the variance
    /// of one sample. The slowest rate where `halves` is `None`.
    pub(super) fn squared_noise(&self, halves: Option<&Self>) -> f64 {
        let Some(halves) = halves else { return self.of_all[0] };
        // At too slow a rate, the variance of one sample seems to fall with the number of samples.
        let growth = |k: usize| self.of_one[k] / halves.of_one[k];
        let Some(upper) = (0..RATES.len()).find(|&k| !(growth(k) < 1.0)) else {
            return self.of_all[RATES.len() - 1];
        };
        let Some(lower) = upper.checked_sub(1) else { return self.of_all[0] };
        let fraction = growth(lower).ln() / (growth(lower).ln() - growth(upper).ln());
        self.of_all[lower] * (self.of_all[upper] / self.of_all[lower]).powf(fraction)
    }
}

fn is_power_of_two(weight: f64) -> bool {
    weight.fract() == 0.0 && (weight as u64).is_power_of_two()
}

/// The variance of the mean of samples of this weight for each rate, relative to weight 1.
fn variances(weight: f64) -> [f64; RATES.len()] {
    let (x, root) = (weight.recip(), weight.recip().sqrt());
    [x, x * root, x * x, x * x * root, x * x * x]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variances_fall_like_the_powers() {
        for (variance, power) in variances(7.0).into_iter().zip(RATES) {
            assert!((variance / 7f64.powf(-power) - 1.0).abs() < 1e-12, "{power}");
        }
    }

    /// The expected rates of pixels whose variance falls like this power, with this number of first and other samples.
    fn rates(power: f64, first: f64, other: f64) -> ConvergenceRates {
        let all = first + other;
        let squared = |n: f64| n.powf(2.0 - power);
        let covariances = squared(all) - squared(first) - squared(other);
        let expected = first.powf(-power) + other.powf(-power) - covariances / (first * other);
        let mut rates = ConvergenceRates::default();
        rates.include(expected, first, other);
        rates
    }

    #[test]
    fn the_rate_that_fits_is_found() {
        let found = |power: f64, first: f64, other: f64| {
            let noise = rates(power, first, other).squared_noise(Some(&rates(power, 1.0, 1.0)));
            assert!((noise / (first + other).powf(-power) - 1.0).abs() < 0.05, "{power} {first} {other}: {noise}");
        };
        for power in [1.0, 1.2, 1.5, 1.7, 2.0, 2.3, 3.0] {
            [[2.0, 2.0], [2.0, 6.0], [32.0, 32.0]].into_iter().for_each(|[first, other]| found(power, first, other));
        }
        for power in [1.0, 1.2, 1.5] {
            [[8.0, 4.0], [8.0, 64.0], [24.0, 32.0]].into_iter().for_each(|[first, other]| found(power, first, other));
        }
    }

    #[test]
    fn sets_of_unbalanced_sizes_have_the_noise_of_an_edge() {
        let noise = rates(3.0, 8.0, 4.0).squared_noise(Some(&rates(3.0, 4.0, 4.0)));
        assert_eq!(noise, rates(3.0, 8.0, 4.0).of_all[UNBALANCED]);
    }

    #[test]
    fn slower_and_faster_rates_than_listed_count_as_the_last_ones() {
        let slow = rates(1.0, 2.0, 2.0).squared_noise(Some(&rates(3.0, 1.0, 1.0)));
        assert!(slow > 0.0 && slow <= rates(1.0, 2.0, 2.0).of_all[0], "{slow}");
        let mut grown = rates(1.0, 2.0, 2.0);
        grown.include(1e3, 2.0, 2.0);
        assert_eq!(grown.squared_noise(Some(&rates(1.0, 1.0, 1.0))), grown.of_all[0]);
        assert_eq!(grown.squared_noise(None), grown.of_all[0]);
    }

    #[test]
    fn without_samples_or_differences_there_is_no_noise() {
        let mut none = ConvergenceRates::default();
        none.include(1.0, 0.0, 2.0);
        assert_eq!(none, ConvergenceRates::default());
        none.include(0.0, 2.0, 2.0);
        assert_eq!(none.squared_noise(Some(&rates(1.0, 1.0, 1.0))), 0.0);
        assert_eq!(none.squared_noise(Some(&none)), 0.0);
        assert!(rates(1.5, 2.0, 2.0).squared_noise(Some(&none)) > 0.0, "new noise");
    }
}
