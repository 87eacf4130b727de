//! Scenes from the practice of users that were once wrong; other files hold the cases whose kind they test.

use crate::suite::{
    Case, Tolerance, ball_nets, box_of, camera, component, diffuse, glass, improper, mean, object, picture,
    point_light, quad, render_limits, sphere, unit,
};
use patchlight::film::{LinearImage, read_exr};
use patchlight::geometry::bezier::read_bpt;
use patchlight::scene::SceneFile;
use patchlight::transport::Component;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

pub(crate) fn cases() -> Vec<Case> {
    [media(), seams(), files(), negative()].into_iter().flatten().collect()
}

/// A file of the tests.
fn data(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(file)
}

/// Camera and lamps in absorbing bodies; plates in contact.
fn media() -> Vec<Case> {
    let passed = (-0.7f64).exp();
    let out_of_ball = 0.96 * passed / (1.0 - 0.04 * passed * passed);
    let in_ball = [
        camera([0.0; 3], [0.0, 0.0, -1.0], 60.0, 16),
        render_limits(64, 1.0),
        glass("g", 1.5, 0.7),
        sphere("ball", [0.0; 3], 1.0, "g"),
    ]
    .concat();
    // The lamp in the middle of the ball lights the ground at 3 units below it, seen beside the ball.
    let lamp_in_ball = [
        camera([0.0, -2.0, 4.0], [0.0, -3.0, 0.0], 1.0, 8),
        render_limits(64, 0.0),
        diffuse("white", 1.0),
        glass("g", 1.5, 0.7),
        object("floor", "plane", "white", "point = [0, -3, 0]\nnormal = [0, 1, 0]"),
        sphere("ball", [0.0; 3], 1.0, "g"),
        point_light([0.0; 3], 10.0),
    ]
    .concat();
    let n = 1.33f64;
    let transmittance = 4.0 * n / (n + 1.0).powi(2);
    // The lamp 0.6 above the floor, 1 unit of water above the floor: absorbed on both ways.
    let lamp_in_pool = [
        camera([0.3, 6.0, 0.0], [0.3, -1.0, 0.001], 0.1, 8),
        render_limits(8, 0.0),
        glass("water", n, 1.0),
        diffuse("floor", 0.5),
        object("surface", "plane", "water", "point = [0, 0, 0]\nnormal = [0, 1, 0]"),
        object("ground", "plane", "floor", "point = [0, -1, 0]\nnormal = [0, 1, 0]"),
        point_light([0.3, -0.4, 0.0], 1.0),
    ]
    .concat();
    let seen = 0.5 / PI / 0.36 * (-0.6f64).exp() * (-1.0f64).exp() * transmittance / (n * n);
    // Two plates that share a face, 1 unit thick together: they brighten the point below the lamp by refraction.
    let plate = |name: &str, low: f64, high: f64| box_of(name, [[-20.0, low, -20.0], [20.0, high, 20.0]], |_| "g");
    let plates = [
        camera([1.0, 0.8, 0.0], [0.0; 3], 0.5, 8),
        render_limits(32, 0.0),
        diffuse("white", 1.0),
        glass("g", 1.5, 0.0),
        quad("floor", [[-4.0, 0.0, 4.0], [8.0, 0.0, 0.0], [0.0, 0.0, -8.0]], "white"),
        plate("p", 1.0, 1.5),
        plate("q", 1.5, 2.0),
        point_light([0.0, 3.0, 0.0], 9.0),
    ]
    .concat();
    let caustic =
        |text: String, iterations| move |round| mean(&component(&text, Component::Caustics, iterations, round));
    vec![
        Case::noisy(
            "camera in an absorbing ball",
            "field 1a",
            2.25 * out_of_ball,
            Tolerance::Relative(1e-3),
            (16, "iterations"),
            move |round| mean(&picture(&in_ball, 16, round)),
        ),
        Case::noisy(
            "lamp in an absorbing ball",
            "field 2a",
            10.0 * out_of_ball / (9.0 * PI),
            Tolerance::Relative(5e-3),
            (32, "iterations"),
            caustic(lamp_in_ball, 32),
        ),
        Case::noisy(
            "lamp in an absorbing pool",
            "field 2d",
            seen,
            Tolerance::Relative(1e-3),
            (16, "iterations"),
            move |round| mean(&component(&lamp_in_pool, Component::Direct, 16, round)),
        ),
        Case::noisy(
            "plates that touch",
            "field 4b",
            below_plate(),
            Tolerance::Relative(5e-3),
            (32, "iterations"),
            caustic(plates, 32),
        ),
    ]
}

/// Radiance of a white floor below a lamp of 9 W/sr at 3 units, through a plate of index 1.5 and thickness 1, on the axis: every pair of
/// reflections in the plate lengthens the way in it by two units.
fn below_plate() -> f64 {
    let (reflected, index) = (0.04f64, 1.5);
    let term = |pairs: i32| {
        let apparent = 2.0 + f64::from(2 * pairs + 1) / index;
        (1.0 - reflected).powi(2) * reflected.powi(2 * pairs) / (apparent * apparent)
    };
    9.0 / PI * (0..6).map(term).sum::<f64>()
}

/// An integrating sphere of patches whose edges differ by these fractions of the radius.
fn seams() -> Vec<Case> {
    let case = |error: f64| {
        let mut nets = ball_nets([0.0; 3], 1.0);
        for (k, coordinate) in nets.as_flattened_mut().as_flattened_mut().as_flattened_mut().iter_mut().enumerate() {
            *coordinate += error * (2.0 * unit(0, k as u64, 0) - 1.0);
        }
        let text = [
            camera([0.1, 0.0, 0.2], [1.0, 0.3, 0.0], 90.0, 16),
            render_limits(100, 0.0),
            diffuse("wall", 0.5),
            object("room", "bezier", "wall", &format!("patches = {nets:?}")),
            point_light([0.5, -0.3, 0.2], 1.0),
        ]
        .concat();
        let name = format!("integrating sphere of patches with edges {error:e} apart");
        // The octants are 2e-4 too large in the mean; an error of 1e-3 changes areas by as much.
        Case::noisy(name, "field 12", 0.5 / PI, Tolerance::Relative(2e-3), (16, "iterations"), move |round| {
            mean(&component(&text, Component::Interreflection, 16, round))
        })
    };
    [0.0, 1e-16, 1e-9, 1e-6, 1e-3].into_iter().map(case).collect()
}

/// Comments in `.bpt` files, the orientation of JPEGs, and an EXR file that states a huge window.
fn files() -> Vec<Case> {
    let bpt = || {
        let points: String = (0..16).map(|k| format!("{} 0 {}\n", k / 4, k % 4)).collect();
        let lines = format!("# patches\n1\n\n# degrees\n3 3\n{points}# the end\n");
        let texts = [lines.clone(), lines.replace('\n', "\r\n"), lines.replace('\n', "\r")];
        texts.iter().filter(|text| read_bpt(text).is_ok_and(|nets| nets.len() == 1)).count() as f64
    };
    let huge = || match read_exr(&data("field/huge-window.exr")) {
        Ok(_) => 1.0,
        Err(error) => f64::from(u8::from(!error.to_string().contains("huge-window.exr"))),
    };
    let upright = || {
        let picture =
            patchlight::scene::Location::Unsaved.read_picture(&data("exif/orientation-6.jpg").display().to_string());
        let picture = picture.expect("a picture").into_rgb8();
        let [red, _, blue] = picture.get_pixel(picture.width() / 4, picture.height() / 4).0;
        f64::from(blue) - f64::from(red)
    };
    vec![
        Case::exact(
            "line ends in which a .bpt file with comments reads",
            "field 10",
            3.0,
            Tolerance::Absolute(0.0),
            (3, "files"),
            bpt,
        ),
        Case::exact(
            "huge window of an EXR file accepted, or file not named",
            "field 15",
            0.0,
            Tolerance::Absolute(0.0),
            (1, "files"),
            huge,
        ),
        Case::exact(
            "blue over red at the top left of a turned JPEG",
            "field 9",
            200.0,
            Tolerance::Absolute(55.0),
            (1, "files"),
            upright,
        ),
    ]
}

/// No negative radiance among many random objects.
fn negative() -> Vec<Case> {
    let negative = |round| {
        let file = SceneFile::open(&data("field/many-objects.toml")).expect("the scene is valid");
        let mut session =
            patchlight::engine::Session::prepare(&file, 1 + round, None).expect("the scene can be prepared");
        for _ in 0..8 {
            session.advance(patchlight::transport::Cancel::NEVER).expect("never cancelled");
        }
        let image: LinearImage = session.film().image();
        improper(&image) + session.stats().dropped_samples
    };
    vec![Case::faults("improper pixels: many random objects", "field 17", (144, "pixels"), negative)]
}
