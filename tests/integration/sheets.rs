//! Surfaces of patches whose edges nearly meet: they look as if their edges were equal.

use crate::support::{assert_near, lamp, mean, object, quad, render};
use glam::DVec3;
use patchlight::film::LinearImage;
use std::array::from_fn;

/// Greatest errors of coordinates of control points, in sizes of a patch.
const ERRORS: [f64; 5] = [0.0, 1e-16, 1e-9, 1e-6, 1e-3];
/// Patches along each side of a parallelogram.
const SPLIT: usize = 4;

/// A camera, a white material, one of clear glass and one of glass that absorbs light.
fn head(position: [f64; 3], target: [f64; 3], fov: f64) -> String {
    format!(
        "[camera]\nposition = {position:?}\ntarget = {target:?}\nfov_y = {fov:?}\n[film]\nwidth = 24\nheight = 24\n\
         [[material]]\nname = \"white\"\ntype = \"diffuse\"\nalbedo = [0.8, 0.8, 0.8]\n\
         [[material]]\nname = \"clear\"\ntype = \"glass\"\nior = 1.5\n\
         [[material]]\nname = \"smoke\"\ntype = \"glass\"\nior = 1.5\nabsorption = [1, 1, 1]\n"
    )
}

/// A corner and two edges of each face of the box from -1 to 1; the normals point to the outside.
fn faces() -> Vec<[DVec3; 3]> {
    let face = |k: usize| {
        let [out, a, b] = [0, 1, 2].map(|axis| DVec3::AXES[(k + axis) % 3]);
        if k < 3 { [out - a - b, 2.0 * a, 2.0 * b] } else { [-out - a - b, 2.0 * b, 2.0 * a] }
    };
    (0..6).map(face).collect()
}

/// The parallelograms as quads, each an object.
fn quads(parallelograms: &[[DVec3; 3]], material: &str) -> String {
    let quad = |(k, vectors): (usize, &[DVec3; 3])| quad(&format!("quad {k}"), vectors.map(DVec3::into), material);
    parallelograms.iter().enumerate().map(quad).collect()
}

/// The parallelograms as patches of one object. Each coordinate of their control points is off by up to `error` sizes of a patch. Where
/// `is_turned`, some of the patches have normals on the other side.
fn patches(parallelograms: &[[DVec3; 3]], error: f64, is_turned: bool, material: &str) -> String {
    let mut numbers = 0;
    let mut moved = |p: DVec3| -> [f64; 3] {
        let mut number = || {
            numbers += 1;
            2.0 * (f64::from(numbers) * 0.618_034).fract() - 1.0
        };
        (p + error * DVec3::new(number(), number(), number())).into()
    };
    let nets: Vec<[[[f64; 3]; 4]; 4]> = (0..parallelograms.len() * SPLIT * SPLIT)
        .map(|k| {
            let [corner, edge_u, edge_v] = parallelograms[k / (SPLIT * SPLIT)];
            let along = |edge: DVec3, cell: usize, i: usize| edge * (3 * cell + i) as f64 / (3 * SPLIT) as f64;
            let point = |i, j| corner + along(edge_u, k / SPLIT % SPLIT, i) + along(edge_v, k % SPLIT, j);
            from_fn(|i| from_fn(|j| moved(if is_turned && k * k % 7 < 3 { point(j, i) } else { point(i, j) })))
        })
        .collect();
    object("patches", "bezier", material, &format!("patches = {nets:?}"))
}

/// Asserts means within 0.5 % and pixels within 12 %: the noise of both pictures.
fn assert_same(found: &LinearImage, expected: &LinearImage, what: &str) {
    assert_near(mean(found), mean(expected), 0.005, what);
    for (k, (a, b)) in found.pixels.iter().zip(&expected.pixels).enumerate() {
        assert!((a.y - b.y).abs() <= 0.12 * b.y, "{what}: pixel {k} is {}, of quads {}", a.y, b.y);
    }
}

/// Interreflection in a closed box reaches every seam and corner.
#[test]
fn a_closed_box_of_patches_is_as_bright_as_one_of_quads() {
    let inside = head([0.7, 0.6, 0.8], [-0.5, -0.4, -0.3], 70.0) + &lamp([0.1, 0.3, -0.2]);
    let expected = render(&(inside.clone() + &quads(&faces(), "white")), 24);
    for (error, is_turned) in [(0.0, false), (1e-16, true), (1e-9, false), (1e-3, true)] {
        let found = render(&(inside.clone() + &patches(&faces(), error, is_turned, "white")), 24);
        assert_same(&found, &expected, &format!("an error of {error}"));
    }
}

/// Light from two walls on a floor, without a line along its seams.
#[test]
fn a_sheet_of_patches_shows_no_seams() {
    let walls = quads(
        &[[-DVec3::X - DVec3::Z, 2.0 * DVec3::X, DVec3::Y], [DVec3::X - DVec3::Z, 2.0 * DVec3::Z, DVec3::Y]],
        "white",
    );
    let room = head([0.0, 1.2, 0.6], [0.0, 0.0, 0.0], 50.0) + &lamp([0.6, 0.2, 0.3]) + &walls;
    let floor = [[-DVec3::X + DVec3::Z, 2.0 * DVec3::X, -2.0 * DVec3::Z]];
    let expected = render(&(room.clone() + &quads(&floor, "white").replace("quad 0", "floor")), 32);
    for error in ERRORS {
        for is_turned in [false, true] {
            let found = render(&(room.clone() + &patches(&floor, error, is_turned, "white")), 32);
            assert_same(&found, &expected, &format!("an error of {error}, turned over: {is_turned}"));
        }
    }
}

/// A ray that meets a gap or an overlap of patches stays right about the body that it is in.
#[test]
fn glass_of_patches_is_a_body_without_gaps() {
    let furnace = head([2.0, 1.7, 4.0], [0.0; 3], 32.0) + "[render]\nmax_bounces = 400\nbackground = [1, 1, 1]\n";
    let smoke = mean(&render(&(furnace.clone() + &quads(&faces(), "smoke")), 16));
    for error in ERRORS {
        let picture = |material| mean(&render(&(furnace.clone() + &patches(&faces(), error, false, material)), 16));
        assert_near(picture("clear"), 1.0, 1e-3, &format!("clear glass, an error of {error}"));
        assert_near(picture("smoke"), smoke, 1e-3, &format!("absorbing glass, an error of {error}"));
    }
}
