use glam::DVec3;
use patchlight::engine::Session;
use patchlight::film::LinearImage;
use patchlight::scene::{Location, SceneFile};
use patchlight::transport::{Cancel, Component};
use patchlight::world::{World, prepare};

/// The scene of a text without its `version`. Paths in it are absolute or relative to the working directory.
pub(crate) fn scene(text: &str) -> SceneFile {
    SceneFile::parse(&format!("version = 1\n{text}"), Location::Unsaved).expect("the scene is valid")
}

/// The prepared world of a scene's text.
pub(crate) fn world(text: &str) -> World {
    prepare(&scene(text).scene, &Location::Unsaved, None).expect("the scene can be prepared")
}

/// The session of a scene's text after this many iterations; of one component of the light if one is given. The round is the seed.
pub(crate) fn session(text: &str, only: Option<Component>, iterations: u64, round: u64) -> Session {
    let session = Session::prepare(&scene(text), 1 + round, None).expect("the scene can be prepared");
    let mut session = session.only(only);
    while session.iterations() < iterations {
        session.advance(Cancel::NEVER).expect("never cancelled");
    }
    session
}

/// The picture of a scene's text.
pub(crate) fn picture(text: &str, iterations: u64, round: u64) -> LinearImage {
    session(text, None, iterations, round).film().image()
}

/// The picture of one component of the light.
pub(crate) fn component(text: &str, only: Component, iterations: u64, round: u64) -> LinearImage {
    session(text, Some(only), iterations, round).film().image()
}

/// Mean over pixels and channels.
pub(crate) fn mean(image: &LinearImage) -> f64 {
    image.pixels.iter().map(|p| f64::from(p.element_sum()) / 3.0).sum::<f64>() / image.pixels.len() as f64
}

/// The means over pixels and channels of `side` x `side` equal blocks.
pub(crate) fn blocks(image: &LinearImage, side: u32) -> Vec<f64> {
    let (columns, rows) = (image.width / side, image.height / side);
    let block = |k: u32| {
        let pixel = |n: u32| (k / side * rows + n / columns) * image.width + k % side * columns + n % columns;
        let sum = (0..columns * rows).map(|n| f64::from(image.pixels[pixel(n) as usize].element_sum())).sum::<f64>();
        sum / f64::from(3 * columns * rows)
    };
    (0..side * side).map(block).collect()
}

/// The number of pixels that are negative or not finite.
pub(crate) fn improper(image: &LinearImage) -> u64 {
    image.pixels.iter().filter(|pixel| !pixel.is_finite() || pixel.min_element() < 0.0).count() as u64
}

/// Improper pixels and samples dropped because they were not finite, after this many iterations.
pub(crate) fn anomalies(text: &str, iterations: u64, round: u64) -> u64 {
    let session = session(text, None, iterations, round);
    improper(&session.film().image()) + session.stats().dropped_samples
}

/// A number from 0 to below 1 for a round, an index and a dimension: SplitMix64's hash of the three.
pub(crate) fn unit(round: u64, index: u64, dimension: u64) -> f64 {
    let mixed =
        (round << 40 ^ index).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ dimension.wrapping_mul(0xd1b5_4a32_d192_ed03);
    let mixed = (mixed ^ mixed >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((mixed ^ mixed >> 31) >> 11) as f64 * 2f64.powi(-53)
}

/// A unit direction, evenly distributed, from a round and an index.
pub(crate) fn direction(round: u64, index: u64) -> DVec3 {
    let z = 1.0 - 2.0 * unit(round, index, 11);
    let (sin, cos) = (std::f64::consts::TAU * unit(round, index, 12)).sin_cos();
    let ring = (1.0 - z * z).sqrt();
    DVec3::new(ring * cos, ring * sin, z)
}
