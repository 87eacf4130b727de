//! Renders the references that the pictures of the built-in scenes are tested against:
//! `cargo run --release --example make_references [FILE]`.
//!
//! The file has a line for each scene: its name, and the three channels of each block's mean.

#![allow(clippy::expect_used, reason = "references of a scene that cannot be rendered do not exist")]

#[path = "../tests/shared/block_means.rs"]
mod block_means;

use block_means::{block_means, rendered, small};
use patchlight::scene::built_in_scenes;
use std::path::PathBuf;

/// Noise far below the noise of the test, which renders 16 iterations.
const ITERATIONS: u64 = 512;
/// A seed that no test uses: references must not share the noise of the tested pictures.
const SEED: u64 = 77;

fn main() -> std::io::Result<()> {
    let file = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("tests/data/built-in.txt"), PathBuf::from);
    std::fs::write(file, built_in_scenes().iter().map(|scene| line(scene.name)).collect::<String>())
}

fn line(scene: &str) -> String {
    let means = block_means(&rendered(&small(scene), None, ITERATIONS, SEED));
    let numbers = means.iter().flat_map(|mean| mean.to_array()).map(|x| format!("{x:.6}"));
    format!("{scene} {}\n", numbers.collect::<Vec<_>>().join(" "))
}
