//! The flux that sheets and photons bring together: all light that the lamp sends.

use super::caustics::Caustics;
use crate::transport::points::fresnel;
use crate::transport::testing::{lamp, object, quad, sphere};
use std::f64::consts::PI;

const PIXELS: u32 = 192;
const MATERIALS: &str = r#"
[[material]]
name = "glass"
type = "glass"
ior = 1.5
tint = [0.9, 0.8, 0.7]
absorption = [0.5, 0.2, 0.1]
[[material]]
name = "water"
type = "glass"
ior = 1.33
absorption = [0.1, 0.2, 0.3]
"#;

/// A grey ball around everything.
fn surroundings() -> String {
    sphere("surroundings", [0.0; 3], 8.0, "grey")
}

#[test]
fn a_ball_of_mirror_sends_on_all_light_that_meets_it() {
    let scene = [surroundings(), sphere("ball", [0.5, -0.3, -1.0], 1.0, "mirror"), lamp([0.5, 1.0, 1.0])].concat();
    let distance_squared: f64 = 1.3 * 1.3 + 2.0 * 2.0;
    let expected = 0.8 * 2.0 * PI * (1.0 - (1.0 - 1.0 / distance_squared).sqrt());
    let found = Caustics::new(&scene, PIXELS, 4).flux_by_events()[&1];
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} instead of {expected}");
}

/// A lamp in the middle of balls: each interface is met at a right angle, and light that it reflects comes back through the lamp.
#[test]
fn balls_in_balls_around_the_lamp_transmit_by_fresnel_and_beer() {
    let materials =
        "[[material]]\nname = \"core\"\ntype = \"glass\"\nior = 2\nabsorption = [0.1, 0.1, 0.1]\ntint = [0.9, 0.9, 0.9]
        [[material]]\nname = \"shell\"\ntype = \"glass\"\nior = 1.33\nabsorption = [0.2, 0.2, 0.2]\n";
    let balls = [sphere("core", [0.0; 3], 1.0, "core"), sphere("shell", [0.0; 3], 2.0, "shell"), surroundings()];
    let scene = [materials, &balls.concat(), &lamp([0.0; 3])].concat();
    let found = Caustics::new(&scene, PIXELS, 4).flux_by_events();
    let (of_core, of_shell) = (fresnel(1.0, 1.33 / 2.0).reflectance, fresnel(1.0, 1.0 / 1.33).reflectance);
    let (core, shell) = ((-0.1f64).exp(), (-0.2f64).exp());
    // Flux that arrives at the surface of the core from within, at the surface of the shell, and at the core from the shell.
    let [mut within, mut outward, mut inward] = [4.0 * PI * core, 0.0, 0.0];
    let mut all = 0.0;
    for events in 1..16 {
        let expected = outward * (1.0 - of_shell);
        all += expected;
        let found = found.get(&events).copied().unwrap_or(0.0);
        // Photons bring the faint ways.
        assert!((found - expected).abs() <= 4e-4 * all, "{found} instead of {expected} after {events} events");
        [within, outward, inward] = [
            (within * of_core + inward * (1.0 - of_core) * 0.9) * core * core,
            (within * (1.0 - of_core) * 0.9 + inward * of_core) * shell,
            outward * of_shell * shell,
        ];
    }
}

/// Of light that goes up in water, the surface lets out a part and reflects the rest, down to grazing angles.
#[test]
fn a_surface_of_water_sends_all_light_up_or_down() {
    let plane = |name: &str, material: &str, height: f64| {
        object(name, "plane", material, &format!("point = [0, 0, {height}]\nnormal = [0, 0, 1]"))
    };
    let planes = [plane("floor", "grey", 0.0), plane("surface", "water", 1.0), plane("ceiling", "grey", 2.0)];
    let water = "[[material]]\nname = \"water\"\ntype = \"glass\"\nior = 1.33\n";
    let scene = [water, &planes.concat(), &lamp([0.2, 0.1, 0.3])].concat();
    let steps = 100_000;
    let transmitted = |k: i32| {
        let cos = (f64::from(k) + 0.5) / f64::from(steps);
        (1.0 - fresnel(cos, 1.0 / 1.33).reflectance) / f64::from(steps)
    };
    let up = 2.0 * PI * (0..steps).map(transmitted).sum::<f64>();
    let fluxes = Caustics::new(&scene, PIXELS, 4).fluxes();
    let mut found: Vec<f64> =
        fluxes.iter().filter(|(tag, _)| *tag & 0xff == 1).map(|(_, fluxes)| fluxes.iter().sum::<f64>() / 4.0).collect();
    found.sort_by(f64::total_cmp);
    let mut expected = [up, 2.0 * PI - up];
    expected.sort_by(f64::total_cmp);
    assert_eq!(found.len(), 2, "up and down");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} instead of {expected}");
    }
}

/// The mean, and its standard error.
fn mean(values: &[f64]) -> [f64; 2] {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    [mean, (squares / (count * (count - 1.0))).sqrt()]
}

/// Of every way over each number of events to each side of a surface.
fn assert_share_the_light(objects: &[String]) {
    let floor = quad("floor", [[-4.0, -4.0, -2.0], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0]], "grey");
    let scene = [MATERIALS, &surroundings(), &floor, &objects.concat()].concat();
    let together = Caustics::new(&scene, PIXELS, 4).fluxes();
    let alone = Caustics::by_photons(&scene, PIXELS, 4).fluxes();
    let all: f64 = alone.values().map(|fluxes| mean(fluxes)[0]).sum();
    let (mut difference, mut variance) = (0.0, 0.0);
    for tag in alone.keys().chain(together.keys().filter(|tag| !alone.contains_key(tag))) {
        let [[found, noise], [expected, expected_noise]] =
            [&together, &alone].map(|fluxes| fluxes.get(tag).map_or([0.0; 2], |fluxes| mean(fluxes)));
        let noise = noise.hypot(expected_noise);
        let most = 1e-3 * all + 4.0 * noise;
        assert!((found - expected).abs() < most, "{found} instead of {expected} of {all} by the way {tag:x}");
        difference += found - expected;
        variance += noise * noise;
    }
    assert!(difference.abs() < 5e-4 * all + 4.0 * variance.sqrt(), "{difference} too much of {all}");
}

#[test]
fn sheets_and_photons_share_the_light_of_glass_in_water() {
    let pond = [sphere("pond", [0.0; 3], 1.2, "water"), sphere("marble", [0.2, 0.1, 0.0], 0.6, "glass")];
    assert_share_the_light(&[pond.concat(), lamp([0.5, 1.0, 3.0])]);
}

#[test]
fn sheets_and_photons_share_the_light_of_total_reflection_in_a_ball() {
    assert_share_the_light(&[sphere("ball", [0.0; 3], 1.2, "glass"), lamp([0.5, 0.6, 0.2])]);
}

/// A patch that bends over itself.
fn fold(material: &str) -> String {
    let rows = [[-1.0, -0.5], [1.5, -0.8], [-1.5, 0.8], [1.0, 0.5]];
    let point = |i: usize, j: usize| [rows[i][0], 0.8 * j as f64 - 1.2, rows[i][1]];
    let net: [[[f64; 3]; 4]; 4] = std::array::from_fn(|i| std::array::from_fn(|j| point(i, j)));
    object("fold", "bezier", material, &format!("patches = [{net:?}]"))
}

#[test]
fn sheets_and_photons_share_the_light_of_a_folded_patch_from_both_sides() {
    for height in [3.0, -1.5] {
        assert_share_the_light(&[fold("mirror"), lamp([0.5, 1.0, height])]);
    }
}

#[test]
fn sheets_and_photons_share_the_light_on_a_folded_patch_and_a_ball() {
    let mirror = quad("mirror", [[-1.0, -1.0, 1.5], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], "mirror");
    assert_share_the_light(&[
        fold("grey"),
        sphere("ball", [0.6, 0.6, 0.3], 0.4, "grey"),
        mirror,
        lamp([0.5, 0.3, 1.2]),
    ]);
}

#[test]
fn sheets_and_photons_share_the_light_of_a_closed_body_of_patches() {
    let bulge = 1.3;
    let patch = |sign: f64| -> [[[f64; 3]; 4]; 4] {
        let height = |i: usize, j: usize| if (1..3).contains(&i) && (1..3).contains(&j) { sign * bulge } else { 0.0 };
        let x = |i: usize| sign * (0.8 * i as f64 - 1.2);
        std::array::from_fn(|i| std::array::from_fn(|j| [x(i), 0.8 * j as f64 - 1.2, height(i, j)]))
    };
    let pillow = object("pillow", "bezier", "glass", &format!("patches = [{:?}, {:?}]", patch(1.0), patch(-1.0)));
    assert_share_the_light(&[pillow, sphere("bubble", [0.1, 0.0, 0.0], 0.3, "water"), lamp([0.5, 1.0, 3.0])]);
}

#[test]
fn sheets_and_photons_share_the_light_of_bodies_that_touch() {
    let face = |name: &str, height: f64, up: bool, material: &str| {
        let edges = if up { [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0]] } else { [[0.0, 2.0, 0.0], [2.0, 0.0, 0.0]] };
        quad(name, [[-1.0, -1.0, height], edges[0], edges[1]], material)
    };
    let glass = [face("top of glass", 0.5, true, "glass"), face("bottom of glass", 0.0, false, "glass")];
    let water = [face("top of water", 0.0, true, "water"), face("bottom of water", -0.5, false, "water")];
    assert_share_the_light(&[glass.concat(), water.concat(), lamp([0.5, 1.0, 3.0])]);
}

#[test]
fn sheets_and_photons_share_the_light_of_many_small_balls() {
    let material = |k: usize| if k.is_multiple_of(2) { "mirror" } else { "glass" };
    let center = |k: usize| [0.22 * (k % 8) as f64 - 0.8, 0.22 * (k / 8) as f64 - 0.5, 0.0];
    let beads: String = (0..40).map(|k| sphere(&format!("bead {k}"), center(k), 0.1, material(k))).collect();
    assert_share_the_light(&[beads, lamp([0.2, 0.3, 1.5])]);
}
