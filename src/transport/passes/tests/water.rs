//! A floor z = 0 under water with a surface about z = 1.

use super::caustics::{Caustics, Rectangle};
use crate::transport::points::fresnel;
use crate::transport::testing::{lamp, object, quad};
use glam::DVec2;
use std::f64::consts::PI;

const IOR: f64 = 1.33;
const ABSORPTION: f64 = 0.2;
const DEPTH: f64 = 1.0;
/// Rays straight down, of irradiance 1.
const SUN_ABOVE: &str =
    "[[light]]\nname = \"sun\"\ntype = \"sun\"\ndirection = [0, 0, -1]\nirradiance = [1, 1, 1]\ndiameter = 0\n";

/// The caustics on the floor for a surface and a light.
fn pool(surface: &str, light: &str, pixels: u32) -> Caustics {
    let water =
        format!("[[material]]\nname = \"water\"\ntype = \"glass\"\nior = {IOR}\nabsorption = [{ABSORPTION}, 0, 0]\n");
    let floor = quad("floor", [[-4.0, -4.0, 0.0], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0]], "grey");
    Caustics::new(&[&water, &floor, surface, light].concat(), pixels, 4)
}

fn flat_surface() -> String {
    quad("water", [[-4.0, -4.0, DEPTH], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0]], "water")
}

/// Angle to the normal behind the surface for the angle before it.
fn refracted(angle: f64) -> f64 {
    (angle.sin() / IOR).asin()
}

/// The part of light that passes the surface at this angle before it, and then this distance in the water.
fn passed(angle: f64, distance: f64) -> f64 {
    (1.0 - fresnel(angle.cos(), IOR).reflectance) * (-ABSORPTION * distance).exp()
}

/// The zero of an increasing function between two numbers, by bisection.
fn zero(f: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        *(if f(middle) < 0.0 { &mut low } else { &mut high }) = middle;
    }
    0.5 * (low + high)
}

/// The mean of a smooth function over a square by Gauss's rule with 3 x 3 points.
fn mean_over(middle: DVec2, side: f64, f: impl Fn(DVec2) -> f64) -> f64 {
    let rule = [(-0.6f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6f64.sqrt(), 5.0 / 18.0)];
    let row = |(y, of_row): (f64, f64)| {
        rule.map(|(x, weight)| of_row * weight * f(middle + 0.5 * side * DVec2::new(x, y))).iter().sum::<f64>()
    };
    rule.map(row).iter().sum()
}

/// Light from the height `h` over the water, at the angle `i` to the vertical before and `t` behind its surface, lands at
/// `rho(i) = h tan i + depth tan t`: the irradiance is `intensity (1 - R) exp(-a depth / cos t) sin i di / (rho drho)`.
#[test]
fn a_lamp_over_flat_water_lights_the_floor_by_snell_and_fresnel() {
    let (h, below_lamp) = (2.0, DVec2::new(0.1, 0.2));
    let caustics = pool(&flat_surface(), &lamp([0.1, 0.2, DEPTH + h]), 512);
    let irradiance = |at: DVec2| {
        let distance = at.distance(below_lamp);
        let i = zero(|i| h * i.tan() + DEPTH * refracted(i).tan() - distance, [0.0, 1.5]);
        let t = refracted(i);
        let rho_over_sine = h / i.cos() + DEPTH / (IOR * t.cos());
        let derivative = h / i.cos().powi(2) + DEPTH / t.cos().powi(2) * i.cos() / (IOR * t.cos());
        passed(i, DEPTH / t.cos()) / (rho_over_sine * derivative)
    };
    let ratio = |middle: DVec2, side: f64| {
        caustics.irradiance(&Rectangle::on_floor(middle, side), 1) / mean_over(middle, side, irradiance)
    };
    let places = [(0.2, 0.3), (0.4, 0.5), (-1.0, 0.1), (1.2, -1.4), (-2.1, -2.1), (2.5, 0.2), (0.3, -2.6), (-0.5, 1.7)];
    let ratios = places.map(|(x, y)| ratio(below_lamp + DVec2::new(x, y), 0.1));
    let near = [(0.0, 0.0), (0.05, 0.0), (0.1, 0.1)].map(|(x, y)| ratio(below_lamp + DVec2::new(x, y), 0.1));
    // Two to seven pixels wide.
    let narrow = [0.01, 0.02, 0.04].map(|side| ratio(below_lamp, side));
    let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
    assert!((mean - 1.0).abs() < 1e-3, "{ratios:?}");
    assert!(ratios.iter().all(|ratio| (ratio - 1.0).abs() < 3e-3), "{ratios:?}");
    assert!(near.iter().all(|ratio| (ratio - 1.0).abs() < 5e-3), "{near:?} near the pole of the chart below the lamp");
    assert!(narrow.iter().all(|ratio| (ratio - 1.0).abs() < 0.01), "{narrow:?} at the pole");
}

/// Parallel rays stay parallel: the irradiance is even, less what the surface reflects and the water absorbs.
#[test]
fn parallel_rays_through_flat_water_light_the_floor_evenly() {
    let sun =
        "[[light]]\nname = \"sun\"\ntype = \"sun\"\ndirection = [0.5, 0, -1]\nirradiance = [1, 1, 1]\ndiameter = 0\n";
    let beam = format!(
        "[[light]]\nname = \"beam\"\ntype = \"beam\"\ncenter = [-1, 0, 3]\ndirection = [0.5, 0, -1]\nradius = 1\npower = [{PI}, {PI}, {PI}]\n"
    );
    let i = 0.5f64.atan();
    let t = refracted(i);
    let expected = i.cos() * passed(i, DEPTH / t.cos());
    for light in [sun, &beam] {
        let caustics = pool(&flat_surface(), light, 128);
        // The axis of the beam meets the water at x = 0.
        let middle = DVec2::new(DEPTH * t.tan(), 0.0);
        for (x, y) in [(0.0, 0.0), (0.3, 0.4), (-0.2, -0.6), (-0.7, 0.1), (0.4, -0.5)] {
            let found = caustics.irradiance(&Rectangle::on_floor(middle + DVec2::new(x, y), 0.1), 1);
            assert!((found / expected - 1.0).abs() < 1e-5, "{found} instead of {expected} at {x}, {y}");
        }
    }
}

/// The surface shows a lamp in the water at `d = 1.5` over the floor. Beyond the critical angle it reflects all light.
#[test]
fn a_lamp_in_the_water_lights_the_floor_as_its_image_by_total_reflection() {
    let caustics = pool(&flat_surface(), &lamp([0.0, 0.0, 0.5]), 256);
    let irradiance = |at: DVec2| {
        let distance = at.length().hypot(1.5);
        1.5 / distance.powi(3) * (-ABSORPTION * distance).exp()
    };
    // The critical angle lies at the radius 1.71.
    for (x, y) in [(1.8, 0.5), (-2.0, 0.3), (0.4, -2.4), (2.0, 2.0), (-1.7, 1.9), (2.9, -0.2)] {
        let middle = DVec2::new(x, y);
        let ratio = caustics.irradiance(&Rectangle::on_floor(middle, 0.1), 1) / mean_over(middle, 0.1, irradiance);
        assert!((ratio - 1.0).abs() < 3e-3, "{ratio} at {x}, {y}");
    }
}

/// Half the width of the wave.
const REACH: f64 = 1.2;

/// The height of a wave over its mean, a cubic function of x, and its slope.
fn wave(x: f64) -> [f64; 2] {
    [0.3 * (x * x * x - x), 0.3 * (3.0 * x * x - 1.0)]
}

/// A single patch has the wave exactly.
fn wavy_surface() -> String {
    let third = 2.0 * REACH / 3.0;
    let [[start, rise], [end, last_rise]] = [-REACH, REACH].map(wave);
    let heights = [start, start + third * rise, end - third * last_rise, end];
    let point = |i: usize, j: usize| [third * i as f64 - REACH, 2.0 * j as f64 - 3.0, DEPTH + heights[i]];
    let net: [[[f64; 3]; 4]; 4] = std::array::from_fn(|i| std::array::from_fn(|j| point(i, j)));
    object("water", "bezier", "water", &format!("patches = [{net:?}]"))
}

/// Light straight down at x, where the wave is steep by the angle `i`, lands at `x + depth(x) tan(i - t)`: the mean over a square is an
/// integral over x.
#[test]
fn parallel_rays_through_a_wave_light_the_floor_by_its_curvature() {
    let caustics = pool(&wavy_surface(), SUN_ABOVE, 512);
    let landing = |x: f64| {
        let [height, slope] = wave(x);
        let (i, depth) = (slope.atan(), DEPTH + height);
        let turn = i - refracted(i);
        (x + depth * turn.tan(), passed(i, depth / turn.cos()))
    };
    let steps = 40_000;
    let at = |k: i32| landing(REACH * (2.0 * f64::from(k) / f64::from(steps) - 1.0));
    let light: Vec<(f64, f64)> = (0..=steps).map(at).collect();
    let expected = |min: f64, max: f64| {
        let of_step = |ends: &[(f64, f64)]| {
            let (a, b) = (ends[0].0.min(ends[1].0), ends[0].0.max(ends[1].0));
            0.5 * (ends[0].1 + ends[1].1) * ((b.min(max) - a.max(min)) / (b - a)).clamp(0.0, 1.0)
        };
        light.windows(2).map(of_step).sum::<f64>() * 2.0 * REACH / f64::from(steps) / (max - min)
    };
    let (count, side) = (40, 0.05);
    let mut sum = 0.0;
    for k in 0..count {
        let middle = DVec2::new(0.05 * f64::from(k) - 1.0, 0.03 * f64::from(k) - 0.5);
        let expected = expected(middle.x - 0.5 * side, middle.x + 0.5 * side);
        let ratio = caustics.irradiance(&Rectangle::on_floor(middle, side), 1) / expected;
        assert!((ratio - 1.0).abs() < 0.01, "{ratio} at {middle}");
        sum += ratio / f64::from(count);
    }
    assert!((sum - 1.0).abs() < 1e-3, "{sum} in the mean");
}
