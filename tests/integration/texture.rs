//! Textures and relief maps finer than pixels.

use crate::support::{advanced, assert_near, mean, render};
use patchlight::engine::Session;
use patchlight::film::LinearImage;
use patchlight::scene::SceneFile;
use patchlight::transport::Component;
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// A floor seen from above beside a bright wall, with 24 x 24 tiles: white halves that look at the wall, grey ones that look away.
const SCENE: &str = r#"
version = 1
[camera]
position = [0, 4, 0]
target = [0, 0, 0]
up = [0, 0, -1]
fov_y = 26
[render]
max_bounces = 2
[[texture]]
name = "color"
file = "color.png"
encoding = "linear"
[[texture]]
name = "normal"
file = "normal.png"
[[material]]
name = "tiles"
type = "diffuse"
albedo = { texture = "color", scale = [24, 24] }
normal_map = { texture = "normal", scale = [24, 24] }
[[material]]
name = "wall"
type = "diffuse"
albedo = [0.8, 0.8, 0.8]
[[light]]
name = "lamp"
type = "point"
position = [0, 1, 0]
intensity = [1, 1, 1]
[[object]]
name = "floor"
type = "quad"
material = "tiles"
corner = [-1, 0, 1]
edge_u = [2, 0, 0]
edge_v = [0, 0, -2]
[[object]]
name = "wall"
type = "quad"
material = "wall"
corner = [1.5, -1, -3]
edge_u = [0, 0, 6]
edge_v = [0, 4, 0]
"#;

fn write_textures(folder: &Path) {
    let halves = |left: [u8; 3], right: [u8; 3]| {
        image::RgbImage::from_fn(16, 16, |x, _| image::Rgb(if x < 8 { left } else { right }))
    };
    halves([255; 3], [80; 3]).save(folder.join("color.png")).unwrap();
    // The normals (0.6, 0, 0.8) and (-0.6, 0, 0.8).
    halves([204, 128, 230], [51, 128, 230]).save(folder.join("normal.png")).unwrap();
}

fn interreflection(file: &SceneFile, side: u32, iterations: u64) -> LinearImage {
    let mut file = file.clone();
    (file.scene.film.width, file.scene.film.height) = (side, side);
    let session = Session::prepare(&file, 1, None).expect("the scene can be prepared");
    advanced(session.only(Some(Component::Interreflection)), iterations).film().image()
}

#[test]
fn coarse_pixels_average_the_texture_and_the_relief_that_they_cover() {
    let folder = tempfile::tempdir().unwrap();
    write_textures(folder.path());
    std::fs::write(folder.path().join("tiles.toml"), SCENE).unwrap();
    let file = SceneFile::open(&folder.path().join("tiles.toml")).expect("the scene is valid");
    // Pixels a fifteenth of a tile, and pixels half as large again as a tile.
    let (fine, coarse) = (interreflection(&file, 320, 6), interreflection(&file, 16, 100));
    let truth = |x: usize, y: usize| {
        let inside = (0..400).map(|j| fine.pixels[(20 * y + j / 20) * 320 + 20 * x + j % 20].x);
        inside.sum::<f32>() / 400.0
    };
    let (mut squares, mut total, mut total_fine) = (0.0, 0.0, 0.0);
    for x in 0..16 {
        let ratios: Vec<f32> = (0..16).map(|y| coarse.pixels[16 * y + x].x / truth(x, y)).collect();
        // Discs are wide where pixels are: light is blurred across columns, along which it hardly changes.
        let blur = ratios.iter().sum::<f32>() / 16.0;
        squares += ratios.iter().map(|ratio| (ratio / blur - 1.0).powi(2)).sum::<f32>();
        total += (0..16).map(|y| coarse.pixels[16 * y + x].x).sum::<f32>();
        total_fine += (0..16).map(|y| truth(x, y)).sum::<f32>();
    }
    // Both know the floor to less than 1 %.
    assert!((total / total_fine - 1.0).abs() < 0.015, "{total} against {total_fine}");
    let noise = (squares / 256.0).sqrt();
    // 0.061; one point of the texture for each pixel in an iteration leaves 0.105.
    assert!(noise < 0.08, "{noise} in a pixel");
}

/// Fraction of the albedo that a diffuse surface reflects of uniform light, where its shading normal has this cosine to its normal: the
/// mean of the ratio of cosines, which the renderer clamps to 8. Without the clamp it is `(1 + cos) / 2`.
fn reflected_fraction(cos: f64) -> f64 {
    let sin = (1.0 - cos * cos).sqrt();
    let n = 512;
    let ratio = |k: u32| {
        let (sin2, angle) = ((f64::from(k / n) + 0.5) / f64::from(n), (f64::from(k % n) + 0.5) / f64::from(n) * TAU);
        (cos + sin * angle.cos() * (sin2 / (1.0 - sin2)).sqrt()).clamp(0.0, 8.0)
    };
    (0..n * n).map(ratio).sum::<f64>() / f64::from(n * n)
}

/// A closed sphere with a lamp in its middle, whose shading normal has the same angle to the normal everywhere. Diffuse reflection of
/// direct light has the radiance `rho cos / pi`, equal to all sides, so all light between walls is uniform and the radiance is
/// `rho cos / pi / (1 - rho fraction)`, if photons scatter by the function that camera paths evaluate.
#[test]
fn relief_reflects_photons_as_it_does_direct_light() {
    let folder = tempfile::tempdir().unwrap();
    let normal = folder.path().join("tilted.png");
    // The normal (0.6, 0, 0.8): its cosine is 0.801 after rounding to eight bits.
    image::RgbImage::from_pixel(4, 4, image::Rgb([204, 128, 230])).save(&normal).unwrap();
    let (albedo, cos) = (0.8, 0.801);
    let text = format!(
        "[camera]\nposition = [0.1, 0.0, 0.2]\ntarget = [1.0, 0.3, 0.0]\nfov_y = 90.0\n[film]\nwidth = 24\nheight = 24
        [render]\nmax_bounces = 64
        [[texture]]\nname = \"tilt\"\nfile = {normal:?}
        [[material]]\nname = \"m\"\ntype = \"diffuse\"\nalbedo = [{albedo}, {albedo}, {albedo}]
        normal_map = {{ texture = \"tilt\" }}
        [[object]]\nname = \"s\"\ntype = \"sphere\"\ncenter = [0,0,0]\nradius = 1.0\nmaterial = \"m\"
        [[light]]\nname = \"l\"\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = [1, 1, 1]\n"
    );
    let expected = albedo * cos / PI / (1.0 - albedo * reflected_fraction(cos));
    // Photons that scatter only before the shading normal leave 0.57 of it. 16 iterations of 16,384 paths, whose flux grows up to 8 times
    // at a grazing angle: a standard error of 0.9 %; 1024 iterations come as near as 0.01 %.
    assert_near(mean(&render(&text, 16)), expected, 0.04, "radiance");
}
