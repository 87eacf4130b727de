//! Valid files, from which edits begin.

use super::bodies::scene_of_films;
use patchlight::engine::{Checkpoint, Run, Session};
use patchlight::film::{LinearImage, Provenance, write_exr};
use patchlight::math::Rgb;
use patchlight::transport::Cancel;

/// Scenes with every kind of table, material, light and shape.
pub(super) fn scenes() -> Vec<Vec<u8>> {
    let texts = [
        include_str!("../../../scenes/report.toml"),
        include_str!("../../../scenes/lens.toml"),
        include_str!("../../../benches/suite/others/gloss-floor-300.toml"),
        EVERYTHING,
    ];
    // Textures lie in the project, not beside the edited file.
    let assets = concat!(env!("CARGO_MANIFEST_DIR"), "/assets");
    texts.map(|text| text.replace("../assets", assets).into_bytes()).to_vec()
}

/// The tables that the built-in scenes lack.
const EVERYTHING: &str = r#"version = 1
name = "everything"
[camera]
position = [0.0, 0.5, 3.8]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_y = 40.0
[film]
width = 8
height = 8
exposure = 0.5
tone_curve = "filmic"
[render]
max_bounces = 4
background = [0.1, 0.1, 0.2]
[[texture]]
name = "planks"
file = "../assets/textures/planks.png"
encoding = "srgb"
[[material]]
name = "white"
type = "diffuse"
albedo = { texture = "planks", scale = [4.0, 4.0] }
height_map = { texture = "planks", scale = [4.0, 4.0], depth = 0.01 }
[[material]]
name = "gloss"
type = "phong"
albedo = [0.5, 0.4, 0.3]
specular = [0.1, 0.1, 0.1]
exponent = 60.0
normal_map = { texture = "planks", scale = [1.0, 1.0], strength = 0.5 }
[[material]]
name = "polish"
type = "polished"
albedo = [0.6, 0.3, 0.35]
reflectance = [0.25, 0.2, 0.2]
[[material]]
name = "mirror"
type = "mirror"
reflectance = [1.0, 1.0, 1.0]
[[material]]
name = "glass"
type = "glass"
ior = 1.5
tint = [0.9, 1.0, 1.0]
absorption = [0.1, 0.2, 0.0]
priority = 2
[[light]]
name = "point"
type = "point"
position = [0.0, 0.85, 0.0]
intensity = [1.5, 1.5, 1.5]
[[light]]
name = "ball"
type = "sphere"
center = [0.5, 0.85, 0.0]
radius = 0.1
radiance = [1.5, 1.5, 1.5]
[[light]]
name = "square"
type = "quad"
corner = [0.0, 0.9, 0.0]
edge_u = [0.2, 0.0, 0.0]
edge_v = [0.0, 0.0, 0.2]
radiance = [1.5, 1.5, 1.5]
[[light]]
name = "sun"
type = "sun"
direction = [0.1, -1.0, 0.2]
irradiance = [1.0, 1.0, 1.0]
diameter = 0.53
[[light]]
name = "beam"
type = "beam"
center = [0.0, 2.0, 0.0]
direction = [0.0, -1.0, 0.0]
radius = 0.2
power = [1.0, 1.0, 1.0]
[[object]]
name = "ground"
type = "plane"
point = [0.0, -1.0, 0.0]
normal = [0.0, 1.0, 0.0]
material = "white"
[[object]]
name = "wall"
type = "quad"
corner = [-1.0, -1.0, -1.0]
edge_u = [2.0, 0.0, 0.0]
edge_v = [0.0, 2.0, 0.0]
material = "polish"
[[object]]
name = "ball"
type = "sphere"
center = [0.4, -0.65, 0.2]
radius = 0.35
material = "glass"
body = "ball"
[[object]]
name = "sheet"
type = "bezier"
material = "gloss"
transform = { translate = [0, 0, 0], rotate = [0, 30, 0], scale = [0.3, -0.3, 0.3] }
patches = [[ [[0,0,0],[0,0,1],[0,0,2],[0,0,3]], [[1,0,0],[1,1,1],[1,1,2],[1,0,3]], [[2,0,0],[2,1,1],[2,1,2],[2,0,3]], [[3,0,0],[3,0,1],[3,0,2],[3,0,3]] ]]
"#;

/// One patch with comments, and the teapot.
pub(super) fn patches() -> Vec<Vec<u8>> {
    let points: String = (0..16).map(|k| format!("{}.0 {:e} {}\n", k / 4, 0.1 * f64::from(k % 5), k % 4)).collect();
    vec![format!("# one patch\n1\n3 3\n{points}").into_bytes(), include_bytes!("../../../scenes/teapot.bpt").to_vec()]
}

/// PNG and JPEG files, one with EXIF data.
pub(super) fn textures() -> Vec<Vec<u8>> {
    vec![
        include_bytes!("../../data/field/normal.png").to_vec(),
        include_bytes!("../../data/exif/orientation-6.jpg").to_vec(),
        include_bytes!("../../../assets/textures/tiles.png").to_vec(),
    ]
}

/// A small picture and the header that states a huge one.
pub(super) fn exrs() -> Vec<Vec<u8>> {
    let pixels = (0..35).map(|k| Rgb::new(k as f32, 1.0 / k as f32, -1e30)).collect();
    let written = exr_bytes(&LinearImage { width: 7, height: 5, pixels });
    vec![written, include_bytes!("../../data/field/huge-window.exr").to_vec()]
}

/// The bytes of the EXR file of a picture.
pub(super) fn exr_bytes(image: &LinearImage) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("picture.exr");
    write_exr(&path, image, &Provenance::default()).expect("the picture can be written");
    std::fs::read(&path).expect("the picture can be read")
}

/// Rays with and without the least distance.
pub(super) fn rays() -> Vec<Vec<u8>> {
    let plain = "ox,oy,oz,dx,dy,dz\n1.5,3,1.5,0,-1,0\n1.5,3,1.5,1e-3,-1,0\n0,0,0,1,0,0\n";
    let with_least = "# rays\nid,dz,oy,oz,dx,dy,ox,tmin\n7,1,2,3,4,5,6,0.25\n8,1,2,3,4,5,6,\n";
    vec![plain.as_bytes().to_vec(), with_least.as_bytes().to_vec()]
}

/// Films after one iteration, and after some that refined the plan.
pub(super) fn films() -> Vec<Vec<u8>> {
    [1, 5].map(film_bytes).to_vec()
}

/// The checkpoint of a film of this many iterations.
pub(super) fn film_bytes(iterations: u64) -> Vec<u8> {
    let file = scene_of_films();
    let run = Run::new(&file, 1, None).expect("a run");
    let mut session = Session::prepare(&file, 1, None).expect("the scene can be prepared");
    while session.iterations() < iterations {
        session.advance(Cancel::NEVER).expect("never cancelled");
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.film");
    Checkpoint::write(&path, &run, session.part()).expect("the film can be written");
    std::fs::read(path).expect("the film can be read")
}
