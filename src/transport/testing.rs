//! Fixtures of the tests of light transport.

use super::counters::Counters;
use super::points::{Clearance, Vertex, VisiblePoint};
use crate::math::{Ray, Rgb};
use crate::scene::{Location, SceneFile};
use crate::world::{Lobe, Scattering, Surface, World, prepare};
use glam::{DVec2, Vec2, Vec3};
use scene_text::HEAD;

#[path = "../../tests/shared/scene_text.rs"]
mod scene_text;

pub(super) use scene_text::{lamp, object, quad, sphere};

/// The world of a scene's text with the camera and the materials white, grey, black and mirror.
pub(super) fn world(text: &str) -> World {
    let file = SceneFile::parse(&format!("version = 1\n{HEAD}{text}"), Location::Unsaved).expect("the scene is valid");
    prepare(&file.scene, &file.location, None).expect("the scene can be prepared")
}

/// The vertex at a ray's first hit.
pub(super) fn vertex(world: &World, ray: &Ray) -> Vertex {
    let hit = world.aggregate.closest_hit(ray).expect("the ray meets a surface");
    let Surface::Object { front_side, material, .. } = world.surfaces[hit.primitive as usize] else {
        panic!("the ray meets a light")
    };
    Vertex::at_hit(world, ray, hit, [front_side, material], &mut Counters::default())
}

/// A visible point of a white surface in the plane y = 0, at its origin.
pub(super) fn visible_point() -> VisiblePoint {
    VisiblePoint {
        pixel: 0,
        in_pixel: Vec2::splat(0.5),
        way: Some(0),
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
