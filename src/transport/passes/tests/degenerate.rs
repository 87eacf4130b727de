//! Maps from directions to places that are not one to one.

use super::caustics::{Caustics, Rectangle};
use crate::transport::testing::{lamp, object, quad, sphere};
use glam::DVec3;
use std::f64::consts::PI;

/// A patch has the paraboloid `z = (x^2 + y^2) / 4` exactly: rays along its axis meet in a point, the focus at z = 1.
#[test]
fn a_paraboloid_brings_all_light_to_its_focus() {
    // Control values of x^2 / 4: those of the quadratic, raised to degree 3.
    let parabola = |min: f64, max: f64| {
        [min * min, min * (min + 2.0 * max) / 3.0, max * (max + 2.0 * min) / 3.0, max * max].map(|square| square / 4.0)
    };
    let (of_x, of_y) = (parabola(0.5, 1.5), parabola(-0.5, 0.5));
    let point = |i: usize, j: usize| [0.5 + i as f64 / 3.0, j as f64 / 3.0 - 0.5, of_x[i] + of_y[j]];
    let net: [[[f64; 3]; 4]; 4] = std::array::from_fn(|i| std::array::from_fn(|j| point(i, j)));
    let scene = [
        &object("mirror", "bezier", "mirror", &format!("patches = [{net:?}]")),
        &quad("screen", [[0.0, -0.2, 0.8], [0.0, 0.4, 0.0], [0.0, 0.0, 0.4]], "grey"),
        &quad("floor", [[-4.0, -4.0, -1.0], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0]], "grey"),
        "[[light]]\nname = \"sun\"\ntype = \"sun\"\ndirection = [0, 0, -1]\nirradiance = [1, 1, 1]\ndiameter = 0\n",
    ];
    let caustics = Caustics::new(&scene.concat(), 192, 4);
    for side in [0.3, 0.01, 1e-4] {
        let around = Rectangle { middle: DVec3::Z, sides: [DVec3::Y * side, DVec3::Z * side] };
        let flux = caustics.irradiance(&around, 1) * side * side;
        assert!((flux / 0.8 - 1.0).abs() < 1e-3, "{flux} within {side}");
    }
}

/// Light of a lamp in the middle of a ball of mirror comes back through the lamp: opposite of another ball, it lands there.
#[test]
fn light_that_comes_back_through_its_lamp_goes_on() {
    let balls = [sphere("around", [0.0; 3], 6.0, "mirror"), sphere("ball", [2.0, 0.0, 0.0], 0.5, "grey")];
    let found = Caustics::new(&[balls.concat(), lamp([0.0; 3])].concat(), 192, 4).flux_by_events();
    let expected = 0.8 * 2.0 * PI * (1.0 - (1.0f64 - 1.0 / 16.0).sqrt());
    assert!((found[&1] / expected - 1.0).abs() < 1e-3, "{found:?} instead of {expected}");
    assert_eq!(found.len(), 1, "no other light lands anywhere");
}
