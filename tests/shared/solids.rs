//! Solids for integration tests and the stress suite.

use super::quad;
use glam::DVec3;
use patchlight::geometry::bezier::ControlNet;

/// The faces of a box with normals to the outside, each with a material; "left" is at the smallest x, "back" at the smallest z.
pub(crate) fn box_of(name: &str, [low, high]: [[f64; 3]; 2], material: impl Fn(&str) -> &'static str) -> String {
    let d = [0, 1, 2].map(|k| high[k] - low[k]);
    let (x, y, z) = ([d[0], 0.0, 0.0], [0.0, d[1], 0.0], [0.0, 0.0, d[2]]);
    let faces = [
        ("left", [low, z, y]),
        ("right", [[high[0], low[1], low[2]], y, z]),
        ("bottom", [low, x, z]),
        ("top", [[low[0], high[1], low[2]], z, x]),
        ("back", [low, y, x]),
        ("front", [[low[0], low[1], high[2]], x, y]),
    ];
    faces.iter().map(|(face, edges)| quad(&format!("{name} {face}"), *edges, material(face))).collect()
}

/// A rounded cube with dents: six faces whose edges run on a sphere, all normals outward. Rays meet it up to four times.
pub(crate) fn dented_cube() -> Vec<ControlNet> {
    let face = |axis: usize, side: f64| {
        let point = |i: usize, j: usize| {
            let mut p = [0.0; 3];
            p[axis] = side;
            p[(axis + 1) % 3] = 2.0 / 3.0 * i as f64 - 1.0;
            p[(axis + 2) % 3] = side * (2.0 / 3.0 * j as f64 - 1.0);
            let inner = (1..=2).contains(&i) && (1..=2).contains(&j);
            DVec3::from_array(p).normalize() * if inner && side < 0.0 { 0.6 } else { 1.3 }
        };
        ControlNet { points: std::array::from_fn(|i| std::array::from_fn(|j| point(i, j))) }
    };
    (0..6).map(|k| face(k / 2, [-1.0, 1.0][k % 2])).collect()
}
