//! Samplers against their densities, by Pearson's chi-square, whose mean is its number of degrees of freedom; thin cones: S1.

use crate::suite::{Case, Tolerance};
use glam::{DVec2, DVec3};
use patchlight::math::{Sampler, Stream, octahedral, warp};
use std::f64::consts::TAU;

/// Independent draws of one round.
const DRAWS: u64 = 50_000;
/// Bins along the cosine, and around the axis.
const SIDE: usize = 16;

/// A warp from the unit square to directions, and the distribution function of their cosine to the axis.
type Warp = (&'static str, fn(DVec2) -> DVec3, fn(f64) -> f64);

pub(crate) fn cases() -> Vec<Case> {
    let warps: [Warp; 7] = [
        ("cosine hemisphere", warp::cosine_hemisphere, |z| z * z),
        ("sphere", warp::uniform_sphere, |z| 0.5 * (1.0 + z)),
        ("octahedral map", octahedral::direction_from_square, |z| 0.5 * (1.0 + z)),
        ("Phong lobe of exponent 0", |u| warp::cosine_power(u, 0.0), |z| z),
        ("Phong lobe of exponent 300", |u| warp::cosine_power(u, 300.0), |z| z.powi(301)),
        ("cone of 37 degrees", |u| warp::uniform_cone(u, 0.2), |z| (z - 0.8) / 0.2),
        ("cone of 0.5 degrees", |u| warp::uniform_cone(u, 4e-5), |z| (z - (1.0 - 4e-5)) / 4e-5),
    ];
    // The first index of each sequence; from 2^32 on, indices belong to another scrambled sequence.
    let starts = [("", 0), (", indices from 2^32 - 8 on", (1u64 << 32) - 8), (", indices from 2^40 on", 1 << 40)];
    let mut cases = Vec::new();
    for (name, warp, distribution) in warps {
        for (from, start) in &starts[..if name == "sphere" { 3 } else { 1 }] {
            let start = *start;
            let statistic = move |round| chi_square(|sampler| warp(sampler.next_2d()), distribution, start, round);
            let name = format!("chi-square per degree of freedom: {name}{from}");
            cases.push(Case::noisy(name, "S1", 1.0, Tolerance::Absolute(0.0), (DRAWS, "draws"), statistic));
        }
    }
    cases.extend([thin_cones(), unit_interval()]);
    cases
}

/// Pearson's statistic over its degrees of freedom, for bins of equal probability. Its mean is 1 where draws have the distribution.
fn chi_square(draw: impl Fn(&mut Sampler) -> DVec3, distribution: fn(f64) -> f64, start: u64, round: u64) -> f64 {
    let mut counts = [0u32; SIDE * SIDE];
    for k in 0..DRAWS {
        // Every draw from a sequence of its own: draws are independent, unlike the points of one sequence.
        let direction = draw(&mut Sampler::new(7 + round, Stream::Camera, k, start + k % 16));
        let bin = |x: f64| ((x * SIDE as f64) as usize).min(SIDE - 1);
        let turn = direction.y.atan2(direction.x) / TAU;
        counts[bin(distribution(direction.z)) * SIDE + bin(turn - turn.floor())] += 1;
    }
    let expected = DRAWS as f64 / counts.len() as f64;
    let statistic: f64 = counts.iter().map(|&count| (f64::from(count) - expected).powi(2) / expected).sum();
    statistic / (counts.len() - 1) as f64
}

/// Directions of cones so thin that the cosine rounds to 1 stay in the cone, and have its mean angle.
fn thin_cones() -> Case {
    let wrong = |round| {
        let is_wrong = |k: &u64| {
            let half_angle = 10f64.powi(-(*k as i32 % 12));
            let one_minus_cos = 2.0 * (0.5 * half_angle).sin().powi(2);
            let direction = warp::uniform_cone(Sampler::new(9 + round, Stream::Camera, *k, 0).next_2d(), one_minus_cos);
            let angle = direction.x.hypot(direction.y).atan2(direction.z);
            !(angle > 0.0 && angle <= half_angle * (1.0 + 1e-9) && direction.is_normalized())
        };
        (0..DRAWS).filter(is_wrong).count() as u64
    };
    Case::faults("directions outside of thin cones", "S1", (DRAWS, "draws"), wrong)
}

/// Numbers stay above 0 and below 1.
fn unit_interval() -> Case {
    let wrong = |round| {
        let is_wrong = |k: &u64| {
            let mut sampler =
                Sampler::new(round, Stream::GlobalPhoton, *k % 3, (*k).wrapping_mul(0x9e37_79b9_7f4a_7c15));
            (0..16).any(|_| {
                let x = sampler.next_1d();
                !(x > 0.0 && x < 1.0)
            })
        };
        (0..DRAWS).filter(is_wrong).count() as u64
    };
    Case::faults("numbers outside of the open unit interval", "S1", (16 * DRAWS, "numbers"), wrong)
}
