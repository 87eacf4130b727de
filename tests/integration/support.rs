//! Scenes, sessions and measures that several tests use.

use patchlight::engine::Session;
use patchlight::film::LinearImage;
use patchlight::math::Rgb;
use patchlight::scene::{Location, SceneFile};
use patchlight::transport::{
    Band, Cancel, Contribution, Maps, PassInput, Plan, Rows, camera_pass, caustic_photon_pass, gather,
    global_photon_pass,
};
use patchlight::world::{World, prepare};
use rayon::prelude::*;
use std::path::Path;
use std::process::{Command, Output};

#[path = "../shared/scene_text.rs"]
mod scene_text;

pub(crate) use scene_text::{lamp, object, quad, sphere};

/// The text of a camera, a lamp above it and the materials white, grey, black and mirror.
pub(crate) fn head() -> String {
    scene_text::HEAD.to_owned() + &lamp([0.0, 3.0, 0.0])
}

/// The text of a sphere whose centre is on the x axis.
pub(crate) fn ball(name: &str, x: f64, radius: f64, material: &str) -> String {
    sphere(name, [x, 0.0, 0.0], radius, material)
}

/// The text of the plane y = -1.
pub(crate) fn floor(material: &str) -> String {
    object("floor", "plane", material, "point = [0, -1, 0]\nnormal = [0, 1, 0]")
}

/// The scene of a text without its `version`.
pub(crate) fn scene(text: &str) -> SceneFile {
    SceneFile::parse(&format!("version = 1\n{text}"), Location::Unsaved).expect("the scene is valid")
}

/// The prepared world of a scene's text.
pub(crate) fn world(text: &str) -> World {
    prepare(&scene(text).scene, &Location::Unsaved, None).expect("the scene can be prepared")
}

/// A session with seed 1 after the given number of iterations of a scene's text.
pub(crate) fn session(text: &str, iterations: u64) -> Session {
    session_of_seed(text, iterations, 1)
}

/// A session with this seed after the given number of iterations of a scene's text.
pub(crate) fn session_of_seed(text: &str, iterations: u64, seed: u64) -> Session {
    advanced(Session::prepare(&scene(text), seed, None).expect("the scene can be prepared"), iterations)
}

/// The session after its iteration of this number.
pub(crate) fn advanced(mut session: Session, iterations: u64) -> Session {
    while session.iterations() < iterations {
        session.advance(Cancel::NEVER).expect("never cancelled");
    }
    session
}

/// The picture of a scene's text after the given number of iterations with seed 1.
pub(crate) fn render(text: &str, iterations: u64) -> LinearImage {
    session(text, iterations).film().image()
}

/// Mean over pixels and channels.
pub(crate) fn mean(image: &LinearImage) -> f64 {
    image.pixels.iter().map(|p| f64::from(p.element_sum()) / 3.0).sum::<f64>() / image.pixels.len() as f64
}

/// Asserts a value within this relative error.
pub(crate) fn assert_near(found: f64, expected: f64, relative: f64, what: &str) {
    assert!((found / expected - 1.0).abs() < relative, "{what}: {found}, the formula says {expected}");
}

/// Runs the program in a folder, with no display.
pub(crate) fn patchlight(dir: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_patchlight"))
        .args(arguments)
        .current_dir(dir)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .unwrap()
}

/// Radiance from photons in one iteration of a plan, pixel by pixel.
pub(crate) fn photon_radiance(world: &World, plan: &Plan, seed: u64, iteration: u64) -> Vec<Rgb> {
    let input = PassInput::uncancelled(world, plan, seed, iteration);
    let global = global_photon_pass(&input).expect("never cancelled");
    let caustic = caustic_photon_pass(&input).expect("never cancelled");
    let maps = Maps::build(&caustic.photons, [&global.photons, &global.indirect_caustics, &global.glossy]);
    let band = |rows: &Rows| {
        let seen = camera_pass(&input, rows).expect("never cancelled");
        let gathered = gather(&input, &maps, &seen).expect("never cancelled");
        Band::new(&input, rows, seen, &gathered.points)
    };
    let bands: Vec<Band> = plan.bands(iteration).par_iter().map(band).collect();
    Contribution::new(&bands, &caustic.splats, plan.camera.width).photons
}
