//! The radius of the density estimate, iteration by iteration \[KZ11\].

/// How fast radii shrink: `r_i = r_1 i^(-(1 - alpha) / 2)`. 2/3 balances bias and noise of a mean over independent
/// iterations \[KZ11\].
const ALPHA: f64 = 2.0 / 3.0;

/// The factor by which the radius of iteration `i` (from 1) is smaller than the first, by the power form that needs
/// no recursion.
pub fn shrink(iteration: u64) -> f64 {
    (iteration.max(1) as f64).powf(-0.5 * (1.0 - ALPHA))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The recursion `r_{i+1}^2 = r_i^2 (i + alpha) / (i + 1)` of the paper approaches the power form times 1.108.
    #[test]
    fn power_form_follows_the_recursion() {
        let mut squared = 1.0;
        for i in 1..100_000u64 {
            squared *= (i as f64 + ALPHA) / (i as f64 + 1.0);
        }
        let ratio = squared / shrink(100_000).powi(2);
        assert!((ratio - 1.108).abs() < 1e-3, "{ratio}");
    }

    #[test]
    fn late_iterations_stay_finite() {
        assert!(shrink(0) == 1.0 && shrink(u64::MAX) > 0.0 && shrink(1_000_000_000) < shrink(1_000_000));
    }
}
