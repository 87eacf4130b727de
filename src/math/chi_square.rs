//! Pearson's chi-square test of samplers against their densities, for tests alone.

use super::{Sampler, Stream};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Probability with which the test rejects a correct sampler. About twenty samplers are tested with fixed seeds.
const SIGNIFICANCE: f64 = 1e-4;
/// Bins along a side of the unit square.
const SIDE: usize = 16;
/// Points along a side of a bin at which the density is evaluated.
const POINTS: usize = 48;
/// Samples of a test.
const DRAWS: u64 = 100_000;
/// Bins with a smaller expected count are pooled, because their counts are not normally distributed.
const LEAST_EXPECTED: f64 = 5.0;

/// Asserts that the draws of a sampler have this density (per area) over the unit square. `None` counts as a draw
/// outside the square; its expected frequency is 1 minus the integral of the density. Every draw gets an independent
/// random sequence.
pub(crate) fn assert_has_density(
    name: &str,
    sample: impl FnMut(&mut Sampler) -> Option<DVec2>,
    density: impl Fn(DVec2) -> f64,
) {
    let p_value = p_value_of_sampler(sample, density);
    assert!(p_value >= SIGNIFICANCE, "{name}: the samples do not have the density, p = {p_value:e}");
}

/// Asserts that counts of independent draws agree with the expected counts.
pub(crate) fn assert_has_frequencies(name: &str, counts: &[u64], expected: &[f64]) {
    let p_value = p_value(counts, expected);
    assert!(p_value >= SIGNIFICANCE, "{name}: {counts:?} instead of {expected:?}, p = {p_value:e}");
}

fn p_value_of_sampler(mut sample: impl FnMut(&mut Sampler) -> Option<DVec2>, density: impl Fn(DVec2) -> f64) -> f64 {
    let bins = SIDE * SIDE;
    let mut counts = vec![0; bins + 1];
    for draw in 0..DRAWS {
        let bin = sample(&mut Sampler::new(11, Stream::Camera, draw, 0)).map_or(bins, |p| {
            let index = |x: f64| ((x * SIDE as f64) as usize).min(SIDE - 1);
            index(p.y) * SIDE + index(p.x)
        });
        counts[bin] += 1;
    }
    let in_bin = |bin: usize| {
        let corner = DVec2::new((bin % SIDE) as f64, (bin / SIDE) as f64);
        let at = |k: usize| {
            let within = DVec2::new((k % POINTS) as f64 + 0.5, (k / POINTS) as f64 + 0.5) / POINTS as f64;
            density((corner + within) / SIDE as f64)
        };
        let mean = (0..POINTS * POINTS).map(at).sum::<f64>() / (POINTS * POINTS) as f64;
        DRAWS as f64 * mean / bins as f64
    };
    let mut expected: Vec<f64> = (0..bins).map(in_bin).collect();
    expected.push((DRAWS as f64 - expected.iter().sum::<f64>()).max(0.0));
    p_value(&counts, &expected)
}

/// The p-value: the probability that the counts of a correct sampler differ from the expected counts by at least as
/// much.
fn p_value(counts: &[u64], expected: &[f64]) -> f64 {
    let term = |count: u64, expected: f64| (count as f64 - expected).powi(2) / expected;
    let (mut statistic, mut bins) = (0.0, 0);
    let mut pool = (0, 0.0);
    for (&count, &expected) in counts.iter().zip(expected) {
        if expected >= LEAST_EXPECTED {
            statistic += term(count, expected);
            bins += 1;
        } else {
            pool = (pool.0 + count, pool.1 + expected);
        }
    }
    // The midpoint rule puts about 1e-5 of the draws into bins that no draw can reach.
    if pool.0 > 0 || pool.1 > 1.0 {
        statistic += term(pool.0, pool.1.max(1.0));
        bins += 1;
    }
    upper_tail(statistic, bins - 1)
}

/// The probability that a chi-square variable with this number of degrees of freedom exceeds `x`: for an even number
/// the sum `exp(-x/2) sum of (x/2)^k / k!` over k below half of the degrees. An odd number is rounded up, which never
/// makes the probability smaller.
fn upper_tail(x: f64, degrees: usize) -> f64 {
    let half = 0.5 * x;
    let next = |term: &mut f64, k: usize| {
        *term *= if k == 0 { 1.0 } else { half / k as f64 };
        Some(*term)
    };
    (0..degrees.div_ceil(2)).scan((-half).exp(), next).sum()
}

/// Coordinates in the unit square of a unit direction whose z is at least `least_z`: equal areas are equal solid angles. `None` for
/// directions outside this cap.
pub(crate) fn cap_square(direction: DVec3, least_z: f64) -> Option<DVec2> {
    let turn = direction.y.atan2(direction.x) / TAU;
    let square = DVec2::new(turn - turn.floor(), (1.0 - direction.z) / (1.0 - least_z));
    (square.y <= 1.0 + 1e-9).then_some(square)
}

/// The direction at a point of [`cap_square`].
pub(crate) fn cap_direction(square: DVec2, least_z: f64) -> DVec3 {
    let z = 1.0 - square.y * (1.0 - least_z);
    ((1.0 - z * z).max(0.0).sqrt() * DVec2::from_angle(TAU * square.x)).extend(z)
}

/// The solid angle that [`cap_square`] covers, steradians.
pub(crate) fn cap_solid_angle(least_z: f64) -> f64 {
    TAU * (1.0 - least_z)
}

#[test]
fn tails_match_published_tables() {
    for (degrees, x, p) in [(2, 5.991, 0.05), (10, 18.307, 0.05), (20, 45.315, 0.001), (100, 149.449, 0.001)] {
        assert!((upper_tail(x, degrees) / p - 1.0).abs() < 1e-3, "{degrees} degrees of freedom");
    }
    assert!(upper_tail(18.307, 9) >= upper_tail(18.307, 8), "odd numbers are rounded up");
}

#[test]
fn a_wrong_density_is_rejected() {
    let uniform = |sampler: &mut Sampler| Some(sampler.next_2d());
    assert!(p_value_of_sampler(uniform, |_| 1.0) > SIGNIFICANCE);
    // The density rises by a fifth from left to right; the statistic exceeds its critical value by six standard deviations.
    assert!(p_value_of_sampler(uniform, |p| 0.9 + 0.2 * p.x) < SIGNIFICANCE);
    let halved = |sampler: &mut Sampler| Some(sampler.next_2d()).filter(|p| p.x < 0.52);
    let left = |p: DVec2| if p.x < 0.5 { 1.0 } else { 0.0 };
    assert!(p_value_of_sampler(halved, left) < SIGNIFICANCE, "2 % land outside the support");
}
