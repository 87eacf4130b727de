//! Fixtures of the tests of light transport.

use super::counters::Counters;
use super::points::{Clearance, Vertex, VisiblePoint};
use crate::math::{Ray, Rgb};
use crate::scene::{Location, SceneFile};
use crate::world::{Lobe, Scattering, Surface, World, prepare};
use glam::{DVec2, Vec3};

/// A camera, and materials named by what they are: white, grey (albedo 0.5), black, mirror (reflectance 0.8).
const HEAD: &str = r#"version = 1
[camera]
position = [0, 0, 4]
target = [0, 0, 0]
fov_y = 40
[[material]]
name = "white"
type = "diffuse"
albedo = [1, 1, 1]
[[material]]
name = "grey"
type = "diffuse"
albedo = [0.5, 0.5, 0.5]
[[material]]
name = "black"
type = "diffuse"
albedo = [0, 0, 0]
[[material]]
name = "mirror"
type = "mirror"
reflectance = [0.8, 0.8, 0.8]
"#;

/// The world of a scene with the materials white, grey, black and mirror.
pub(super) fn world(text: &str) -> World {
    let file = SceneFile::parse(&format!("{HEAD}{text}"), Location::Unsaved).expect("the scene is valid");
    prepare(&file.scene, &file.location, None).expect("the scene can be prepared")
}

/// The text of a sphere.
pub(super) fn sphere(name: &str, center: [f64; 3], radius: f64, material: &str) -> String {
    object(name, "sphere", material, &format!("center = {center:?}\nradius = {radius}"))
}

/// The text of a quad.
pub(super) fn quad(name: &str, [corner, edge_u, edge_v]: [[f64; 3]; 3], material: &str) -> String {
    object(name, "quad", material, &format!("corner = {corner:?}\nedge_u = {edge_u:?}\nedge_v = {edge_v:?}"))
}

fn object(name: &str, shape: &str, material: &str, rest: &str) -> String {
    format!("[[object]]\nname = \"{name}\"\ntype = \"{shape}\"\nmaterial = \"{material}\"\n{rest}\n")
}

/// The text of a point light of intensity 1.
pub(super) fn lamp(position: [f64; 3]) -> String {
    format!("[[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = {position:?}\nintensity = [1, 1, 1]\n")
}

/// The vertex at a ray's first hit.
pub(super) fn vertex(world: &World, ray: &Ray) -> Vertex {
    let hit = world.aggregate.closest_hit(ray).expect("the ray meets a surface");
    let Surface::Object { object, material, .. } = world.surfaces[hit.primitive as usize] else {
        panic!("the ray meets a light")
    };
    let point = world.surface_point(ray, hit);
    Vertex::new(world, point, [object, material], -ray.direction, &mut Counters::default())
}

/// A visible point of a white surface in the plane y = 0, at its origin.
pub(super) fn visible_point() -> VisiblePoint {
    VisiblePoint {
        pixel: 0,
        position: Vec3::ZERO,
        n_side: Vec3::Y,
        n_shade: Vec3::Y,
        wo: Vec3::Y,
        throughput: Rgb::ONE,
        scattering: Scattering { albedo: Rgb::ONE, lobe: Lobe::None },
        footprint: 0.1,
        clearance: Clearance::FREE,
        primitive: 0,
        uv: DVec2::ZERO,
        tag: 0,
        photon_bounces: 3,
        mean_albedo: Rgb::ONE,
        spread: 0.0,
        first_facet: 0,
        facets: 0,
        seen_directly: true,
        on_an_edge: false,
        blur: 0.0,
    }
}
