//! The closed forms in other units and off the origin: G5.

use crate::suite::{
    Case, Tolerance, camera, component, diffuse, glass, mean, object, patch_ball, picture, point_light, quad,
    render_limits, sphere,
};
use glam::DVec3;
use patchlight::transport::Component;
use std::f64::consts::PI;

/// The unit of a scene, and the place of its origin in units.
struct Frame {
    unit: f64,
    origin: DVec3,
}

impl Frame {
    fn point(&self, x: f64, y: f64, z: f64) -> [f64; 3] {
        (self.unit * (DVec3::new(x, y, z) + self.origin)).to_array()
    }

    fn vector(&self, x: f64, y: f64, z: f64) -> [f64; 3] {
        (self.unit * DVec3::new(x, y, z)).to_array()
    }

    /// Intensity that gives the same irradiance in any unit.
    fn intensity(&self) -> f64 {
        self.unit * self.unit
    }
}

pub(crate) fn cases() -> Vec<Case> {
    let scales = [1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6].map(|unit| (format!("scale {unit:e}"), unit, 0.0));
    let offsets = [1e2, 1e4, 1e5, 1e6].map(|offset| (format!("offset {offset:e}"), 1.0, offset));
    let mut cases = Vec::new();
    for (name, unit, offset) in scales.into_iter().chain(offsets) {
        let frame = || Frame { unit, origin: offset * DVec3::new(1.0, -0.7, 0.3) };
        for (what, text, only, expected) in [
            ("integrating sphere", integrating_sphere(&frame()), Component::Interreflection, 0.5 / PI),
            ("absorbing ball of patches", absorbing_ball(&frame()), Component::Direct, in_absorbing_ball()),
            ("pool", pool(&frame()), Component::Caustics, in_pool()),
        ] {
            // Positions at 1e6 units have 1e-10 of a unit, in f32 relative to the middle of the view 1e-7.
            let name = format!("{what}, {name}");
            cases.push(Case::noisy(
                name,
                "G5",
                expected,
                Tolerance::Relative(4e-3),
                (16, "iterations"),
                move |round| mean(&component(&text, only, 16, round)),
            ));
        }
        let text = point_light_on_ground(&frame());
        let expected = 1.0 / PI * 2.0 / 5f64.powf(1.5);
        let name = format!("point light, {name}");
        cases.push(Case::noisy(name, "G5", expected, Tolerance::Relative(1e-3), (4, "iterations"), move |round| {
            mean(&picture(&text, 4, round))
        }));
    }
    cases
}

fn integrating_sphere(frame: &Frame) -> String {
    [
        camera(frame.point(0.1, 0.0, 0.2), frame.point(1.0, 0.3, 0.0), 90.0, 8),
        render_limits(100, 0.0),
        diffuse("wall", 0.5),
        sphere("room", frame.point(0.0, 0.0, 0.0), frame.unit, "wall"),
        point_light(frame.point(0.5, -0.3, 0.2), frame.intensity()),
    ]
    .concat()
}

fn in_absorbing_ball() -> f64 {
    let passed = (-0.7f64).exp();
    2.25 * 0.96 * passed / (1.0 - 0.04 * passed * passed)
}

/// The camera in the middle.
fn absorbing_ball(frame: &Frame) -> String {
    [
        camera(frame.point(0.0, 0.0, 0.0), frame.point(0.3, 0.2, -1.0), 60.0, 8),
        render_limits(64, 1.0),
        glass("glass", 1.5, 0.7 / frame.unit),
        patch_ball("ball", frame.point(0.0, 0.0, 0.0), frame.unit, "glass", ""),
    ]
    .concat()
}

fn in_pool() -> f64 {
    let n = 1.33f64;
    0.5 / PI * 4.0 * n / (n + 1.0).powi(2) / (1.0 + 1.0 / n).powi(2)
}

/// The floor of a pool, seen from under water beside the foot of the lamp.
fn pool(frame: &Frame) -> String {
    let [corner, edge_u, edge_v] =
        [frame.point(-1.5, -1.0, 1.5), frame.vector(3.0, 0.0, 0.0), frame.vector(0.0, 0.0, -3.0)];
    let surface = format!("point = {:?}\nnormal = [0, 1, 0]", frame.point(0.0, 0.0, 0.0));
    [
        camera(frame.point(0.4, -0.2, 0.0), frame.point(0.0, -1.0, 0.0), 6.0, 8),
        render_limits(2, 0.0),
        glass("water", 1.33, 0.0),
        diffuse("floor", 0.5),
        object("surface", "plane", "water", &surface),
        quad("ground", [corner, edge_u, edge_v], "floor"),
        point_light(frame.point(0.0, 1.0, 0.0), frame.intensity()),
    ]
    .concat()
}

fn point_light_on_ground(frame: &Frame) -> String {
    let plane = format!("point = {:?}\nnormal = [0, 1, 0]", frame.point(0.0, 0.0, 0.0));
    [
        camera(frame.point(4.0, 3.0, 0.0), frame.point(1.0, 0.0, 0.0), 0.02, 8),
        diffuse("white", 1.0),
        object("ground", "plane", "white", &plane),
        point_light(frame.point(0.0, 2.0, 0.0), frame.intensity()),
    ]
    .concat()
}
