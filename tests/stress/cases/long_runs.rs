//! Long runs, by jumping to late iterations: A1 to A3.

use crate::suite::{Case, Tolerance, camera, diffuse, glass, point_light, render_limits, session, sphere, world};
use patchlight::engine::{FilmSums, PassMeter, iterate};
use patchlight::math::Rgb;
use patchlight::transport::{PassInput, PixelSamples, Plan};
use std::f64::consts::PI;

pub(crate) fn cases() -> Vec<Case> {
    late_iterations().into_iter().chain([long_sum(), sum_after_a_jump(), merged_parts()]).collect()
}

/// The integrating sphere of C1.
fn integrating_sphere() -> String {
    [
        camera([0.1, 0.0, 0.2], [1.0, 0.3, 0.0], 90.0, 16),
        render_limits(100, 0.0),
        diffuse("wall", 0.5),
        sphere("room", [0.0; 3], 1.0, "wall"),
        point_light([0.5, -0.3, 0.2], 1.0),
    ]
    .concat()
}

/// Consecutive iterations of one round: a single one has few photons in its small discs.
const CONSECUTIVE: u64 = 32;

/// The mean radiance from photons of consecutive iterations.
fn radiance_of(text: &str, first: u64, round: u64) -> f64 {
    let world = world(text);
    let plan = Plan::new(&world);
    let mean = |photons: &[Rgb]| photons.iter().map(|pixel| f64::from(pixel.y)).sum::<f64>() / photons.len() as f64;
    let of = |iteration| {
        let input = PassInput::uncancelled(&world, &plan, 1 + round, iteration);
        iterate(&input, &PassMeter::default(), |contribution| mean(&contribution.photons)).expect("never cancelled")
    };
    (first..first + CONSECUTIVE).map(of).sum::<f64>() / CONSECUTIVE as f64
}

/// A1, A2, S1: one iteration of photons is right at any number, past the indices of 32 and nearly of 64 bits.
fn late_iterations() -> Vec<Case> {
    let numbers = [1u64, 57_000, 262_145, 4_194_304, 1_000_000_007, 1_000_000_000_000];
    let case = |iteration: u64| {
        let text = integrating_sphere();
        let name = format!("integrating sphere from iteration {iteration} on");
        Case::noisy(
            name,
            "A1, A2, S1",
            0.5 / PI,
            Tolerance::Relative(2e-3),
            (CONSECUTIVE, "iterations"),
            move |round| radiance_of(&text, iteration, round),
        )
    };
    numbers.into_iter().map(case).collect()
}

/// A1: iterations after a thousand million others still count, each with its weight.
fn sum_after_a_jump() -> Case {
    const BEFORE: u64 = 1_000_000_000;
    const AFTER: u64 = 1_000_000;
    let mean = || {
        let mut film = FilmSums::after(1, 1, 0);
        let samples = [PixelSamples::default()];
        film.commit(BEFORE as f64, &[Rgb::splat(3.0)], &samples);
        (0..AFTER).for_each(|_| film.commit(1.0, &[Rgb::splat(5.0)], &samples));
        film.mean()
    };
    let expected = (3.0 * BEFORE as f64 + 5.0 * AFTER as f64) / (BEFORE + AFTER) as f64;
    let name = "mean of 1e9 iterations of radiance 3 and 1e6 of radiance 5";
    Case::exact(name, "A1", expected, Tolerance::Relative(1e-9), (AFTER, "iterations"), mean)
}

/// A1: single precision stalls after 16.7 million equal additions.
fn long_sum() -> Case {
    const COUNT: u64 = 17_000_000;
    let mean = || {
        let mut film = FilmSums::new(1, 1);
        let samples = [PixelSamples::default()];
        (0..COUNT).for_each(|_| film.commit(1.0, &[Rgb::splat(3.0)], &samples));
        film.mean()
    };
    Case::exact(
        "mean of 17 million iterations of radiance 3",
        "A1",
        3.0,
        Tolerance::Relative(1e-12),
        (COUNT, "iterations"),
        mean,
    )
}

/// A3: the sums of iterations 1 to 4 equal the merged sums of 1 to 3 and of 4.
fn merged_parts() -> Case {
    let text = integrating_sphere() + &glass("glass", 1.5, 0.0) + &sphere("ball", [0.6, 0.2, 0.2], 0.2, "glass");
    let difference = move || {
        let whole = session(&text, None, 4, 0);
        let world = world(&text);
        let plan = Plan::new(&world);
        let film = |iterations: std::ops::RangeInclusive<u64>| {
            let mut film = FilmSums::new(16, 16);
            for iteration in iterations {
                let input = PassInput::uncancelled(&world, &plan, 1, iteration);
                let weight = plan.weight(iteration);
                iterate(&input, &PassMeter::default(), |c| film.commit(weight, &c.photons, &c.samples))
                    .expect("never cancelled");
            }
            film
        };
        let mut parts = film(1..=3);
        parts.merge(&film(4..=4));
        parts.mean() / whole.film().mean() - 1.0
    };
    Case::exact(
        "film merged of parts over the film of one run",
        "A3",
        0.0,
        Tolerance::Absolute(1e-12),
        (4, "iterations"),
        difference,
    )
}
