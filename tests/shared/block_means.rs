//! Small pictures of the built-in scenes and the means of their blocks, for the test and for the example that writes its
//! references.

use glam::Vec3;
use patchlight::engine::Session;
use patchlight::film::LinearImage;
use patchlight::scene::SceneFile;
use patchlight::transport::{Cancel, Component};

/// Pixels along a side of the rendered pictures.
pub(crate) const SIDE: u32 = 64;
/// Blocks along a side; the references hold the mean of each.
const BLOCKS: usize = 4;

/// A built-in scene with a film of `SIDE` x `SIDE` pixels.
pub(crate) fn small(name: &str) -> SceneFile {
    let mut file = SceneFile::built_in(name).expect("a built-in scene");
    (file.scene.film.width, file.scene.film.height) = (SIDE, SIDE);
    file
}

/// The picture of a scene, or of one component of its light.
pub(crate) fn rendered(file: &SceneFile, only: Option<Component>, iterations: u64, seed: u64) -> LinearImage {
    let mut session = Session::prepare(file, seed, None).expect("the scene can be prepared").only(only);
    while session.iterations() < iterations {
        session.advance(Cancel::NEVER).expect("never cancelled");
    }
    session.film().image()
}

/// The mean colour of each block of a picture of `SIDE` x `SIDE` pixels, row by row from the top.
pub(crate) fn block_means(image: &LinearImage) -> Vec<Vec3> {
    let side = SIDE as usize / BLOCKS;
    let pixels = |block: usize| {
        let (row, column) = (block / BLOCKS * side, block % BLOCKS * side);
        (0..side * side).map(move |k| (row + k / side) * SIDE as usize + column + k % side)
    };
    let mean = |block| pixels(block).map(|k| image.pixels[k]).sum::<Vec3>() / (side * side) as f32;
    (0..BLOCKS * BLOCKS).map(mean).collect()
}
