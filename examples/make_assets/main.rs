//! Draws the textures of the built-in scenes: `cargo run --release --example make_assets [FOLDER]`.
//!
//! Every picture is a function of its coordinates, with (0, 0) at the bottom left as in the scene format, so the files do not depend
//! on the machine. All textures but the face repeat without a seam.

mod bricks;
mod canvas;
mod face;
mod flowers;
mod noise;
mod planks;
mod plaster;
mod tiles;

use canvas::{normal_map, paint};
use std::path::{Path, PathBuf};

fn main() -> image::ImageResult<()> {
    let folder = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("assets/textures"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    let save = |name: &str, image: image::RgbImage| image.save(Path::new(&folder).join(name));
    save("planks.png", paint(768, 768, planks::color))?;
    save("bricks.png", paint(512, 512, bricks::color))?;
    save("bricks-normal.png", normal_map(512, bricks::height))?;
    save("plaster-normal.png", normal_map(512, plaster::height))?;
    save("face.png", paint(1024, 1024, face::color))?;
    save("flowers.png", paint(768, 768, flowers::color))?;
    save("tiles.png", paint(512, 512, tiles::color))
}
