//! How iterations differ: the first ones are small, so that there soon is a picture, and radii shrink.

/// The first iteration has this part of the paths of a full one; each has twice the paths of the one before, up to full.
const FIRST_SIZE: f64 = 1.0 / SMALLEST as f64;
/// Paths of a full iteration come in multiples of this.
pub(super) const SMALLEST: u64 = 1 << GROWING_ITERATIONS;
const GROWING_ITERATIONS: u32 = 3;

/// How fast radii shrink: `r ~ n^(-(1 - alpha) / 2)`. 2/3 balances bias and noise of a mean over independent
/// iterations \[KZ11\].
const ALPHA: f64 = 2.0 / 3.0;

/// Paths in iteration `i` (from 1), parts of a full iteration: also its weight in the mean of what photons bring.
pub(super) fn size(i: u64) -> f64 {
    FIRST_SIZE * (1u64 << i.saturating_sub(1).min(u64::from(GROWING_ITERATIONS))) as f64
}

/// Paths in all iterations before `i`, in full iterations.
pub(super) fn size_before(i: u64) -> f64 {
    let before = i.saturating_sub(1);
    let growing = before.min(u64::from(GROWING_ITERATIONS));
    FIRST_SIZE * ((1u64 << growing) - 1) as f64 + (before - growing) as f64
}

/// The factor by which radii shrink from a full first iteration to iteration `i`: the schedule by the number of photons
/// so far \[KZ11\], in the power form, which needs no recursion.
pub(super) fn shrink(i: u64) -> f64 {
    size_before(i.max(1) + 1).powf(-0.5 * (1.0 - ALPHA))
}

/// Samples and radii are chosen anew after this iteration, a power of two, and after the powers that follow.
const FIRST_REFINEMENT: u64 = 4;

/// Whether samples and radii are chosen anew after iteration `i`.
pub(super) fn refines_after(i: u64) -> bool {
    i >= FIRST_REFINEMENT && i.is_power_of_two()
}

/// How often samples and radii were chosen anew before iteration `i`, and once for the first iterations.
pub(super) fn refinements_before(i: u64) -> u32 {
    (i.saturating_sub(1).max(FIRST_REFINEMENT / 2) / (FIRST_REFINEMENT / 2)).ilog2()
}

/// Whether the bias of iterations 1 to `i` is known. Not while all of them are first ones: their wide discs blur sharp caustics
/// more than wider discs tell.
pub(super) fn knows_bias(i: u64) -> bool {
    i > FIRST_REFINEMENT
}

/// Whether iteration `i` measures what the radii are chosen by: the first ones, whose radii differ much, do not.
pub(super) fn measures(i: u64) -> bool {
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
