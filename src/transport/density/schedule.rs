//! The schedule of iterations: the first ones are small, so that a picture appears soon, and radii shrink.

/// Size of the first iteration; each has twice the paths of the iteration before, up to a full one.
const FIRST_SIZE: f64 = 1.0 / SMALLEST as f64;
/// The number of paths of a full iteration is a multiple of this.
pub(in crate::transport) const SMALLEST: u64 = 1 << GROWING_ITERATIONS;
/// Iterations smaller than a full one: the first one has an eighth of a full one's paths, so a whole picture appears soon.
const GROWING_ITERATIONS: u32 = 3;

/// How fast radii shrink: `r ~ n^(-(1 - alpha) / 2)`. 2/3 balances bias and variance of a mean over independent
/// iterations \[KZ11\].
const ALPHA: f64 = 2.0 / 3.0;

/// Size of iteration `i` (from 1): its number of paths over that of a full iteration, and its weight in the mean of photons.
pub(in crate::transport) fn size(i: u64) -> f64 {
    FIRST_SIZE * (1u64 << i.saturating_sub(1).min(u64::from(GROWING_ITERATIONS))) as f64
}

/// Sum of the sizes of all iterations before `i`.
pub(in crate::transport) fn size_before(i: u64) -> f64 {
    let before = i.saturating_sub(1);
    let growing = before.min(u64::from(GROWING_ITERATIONS));
    FIRST_SIZE * ((1u64 << growing) - 1) as f64 + (before - growing) as f64
}

/// Radius in iteration `i` over the radius after one full iteration: the schedule of \[KZ11\] by the number of photon paths of iterations
/// 1 to `i`, in the power form, which needs no recursion.
pub(in crate::transport) fn shrink(i: u64) -> f64 {
    size_before(i.max(1) + 1).powf(-0.5 * (1.0 - ALPHA))
}

/// The plan is refined after this iteration, a power of two, and after the following powers of two: a variance takes two
/// measurements, and each later refinement rests on as many new iterations as there were before.
const FIRST_REFINEMENT: u64 = 4;

/// Whether the plan is refined after iteration `i`.
pub(in crate::transport) fn refines_after(i: u64) -> bool {
    i >= FIRST_REFINEMENT && i.is_power_of_two()
}

/// Number of refinements before iteration `i`, where the end of the unmeasured first iterations counts as one.
pub(in crate::transport) fn refinements_before(i: u64) -> u32 {
    (i.saturating_sub(1).max(FIRST_REFINEMENT / 2) / (FIRST_REFINEMENT / 2)).ilog2()
}

/// Whether the bias of iterations 1 to `i` is known. It is not before the first refinement: the wide discs of the first iterations
/// blur sharp caustics more than the difference to wider discs tells.
pub(in crate::transport) fn knows_bias(i: u64) -> bool {
    i > FIRST_REFINEMENT
}

/// Whether iteration `i` measures bandwidth differences: the first iterations, whose radii differ much, do not.
pub(in crate::transport) fn measures(i: u64) -> bool {
    i > FIRST_REFINEMENT / 2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_add_up() {
        let mut sum = 0.0;
        for i in 1..100 {
            assert_eq!(size_before(i), sum, "before iteration {i}");
            sum += size(i);
        }
        assert_eq!((size(1), size(4), size(99)), (0.125, 1.0, 1.0));
    }

    #[test]
    fn refinements_are_counted() {
        let mut count = 0;
        for i in 1..200 {
            assert_eq!(refinements_before(i), count, "before iteration {i}");
            count += u32::from(refines_after(i));
        }
    }

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
        assert!(shrink(u64::MAX - 1) > 0.0 && shrink(1_000_000_000) < shrink(1_000_000));
    }
}
