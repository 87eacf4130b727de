//! Scenes, sessions and measures that several tests use.

use glam::DVec3;
use patchlight::engine::{PassMeter, Session, iterate};
use patchlight::film::LinearImage;
use patchlight::math::Rgb;
use patchlight::scene::{Location, SceneFile};
use patchlight::transport::{Cancel, PassInput, Plan};
use patchlight::world::{World, prepare};
use std::f64::consts::PI;
use std::path::Path;
use std::process::{Command, Output};

#[path = "../shared/scene_text.rs"]
mod scene_text;
#[path = "../shared/solids.rs"]
mod solids;

pub(crate) use scene_text::{HEAD, lamp, object, quad, sphere};
pub(crate) use solids::{box_of, dented_cube};

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

/// One object of flat patches for the quads of a text.
pub(crate) fn patches_of(quads: &str, material: &str) -> String {
    let vector = |line: &str| -> [f64; 3] {
        let (_, list) = line.split_once('[').expect("a list");
        let numbers: Vec<f64> =
            list.trim_end_matches(']').split(',').map(|x| x.trim().parse().expect("a number")).collect();
        numbers.try_into().expect("three")
    };
    let of = |key: &str| quads.lines().filter(|line| line.starts_with(key)).map(vector).collect::<Vec<_>>();
    let (corners, us, vs) = (of("corner"), of("edge_u"), of("edge_v"));
    let patch = |k: usize| {
        let point = |i: usize, j: usize| {
            [0, 1, 2].map(|x| corners[k][x] + us[k][x] * i as f64 / 3.0 + vs[k][x] * j as f64 / 3.0)
        };
        format!("{:?}", [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| point(i, j))))
    };
    let patches: Vec<String> = (0..corners.len()).map(patch).collect();
    object(&format!("patches of {material}"), "bezier", material, &format!("patches = [{}]\n", patches.join(", ")))
}

/// The middle of the spot in [`spot_scene`].
const SPOT: DVec3 = DVec3::new(2.0, 1.2, 0.0);

/// The text of a square spot about (2, 1.2, 0) that looks to -x, `half` being half its side, and of a point light before its middle, `half`
/// away. The spot's material must be diffuse with an albedo of 0.5.
pub(crate) fn spot_scene(half: f64, material: &str) -> String {
    let side = 2.0 * half;
    let corner = SPOT + DVec3::new(0.0, -half, half);
    quad("spot", [corner.to_array(), [0.0, 0.0, -side], [0.0, side, 0.0]], material)
        + &lamp([SPOT.x - half, SPOT.y, SPOT.z])
}

/// Radiance that a point of the plane y = 0 scatters from the spot of [`spot_scene`]: the sum over `n` x `n` cells of the spot.
/// `scattering` returns the scattering function at the point for light from a position on the spot; 0 where an object hides it.
pub(crate) fn spot_radiance(half: f64, n: u32, point: DVec3, scattering: impl Fn(DVec3) -> f64) -> f64 {
    let offset = |k: u32| half * (f64::from(2 * k + 1) / f64::from(n) - 1.0);
    let from_cell = |k: u32| {
        let spot = SPOT + DVec3::new(0.0, offset(k / n), offset(k % n));
        let to_lamp = SPOT - half * DVec3::X - spot;
        let to_spot = spot - point;
        let irradiance = -to_lamp.x / to_lamp.length().powi(3);
        let geometry = to_spot.x * to_spot.y / to_spot.length_squared().powi(2);
        0.5 / PI * irradiance * geometry * scattering(spot)
    };
    (2.0 * half / f64::from(n)).powi(2) * (0..n * n).map(from_cell).sum::<f64>()
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
    iterate(&input, &PassMeter::default(), |contribution| contribution.photons.clone()).expect("never cancelled")
}
