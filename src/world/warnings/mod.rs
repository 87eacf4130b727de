//! Faults of a scene that can be rendered: glass that is open or inside out, lights and cameras inside of solids.
//!
//! | file | holds |
//! |---|---|
//! | `warning` | [`Warning`] |
//! | `passing` | rays that pass some primitives |
//! | `contact` | faces of two bodies that coincide |
//! | `edges` | edges of glass around which light goes |
//! | `enclosure` | opaque surfaces that enclose a point |

mod contact;
mod edges;
mod enclosure;
mod passing;
mod warning;

use super::World;
use super::bodies::{Body, point_of, spread};
use super::prepare::light;
use crate::math::{Ray, Rgb, warp};
use crate::scene::Scene;
use contact::of_contacts;
use edges::free_edge;
use enclosure::Enclosure;
use glam::DVec3;
use passing::nearest_except;
pub use warning::Warning;

/// Rays into a body that tell whether walls close it. Fewer would leave gaps of a few percent to chance; more would take time after each
/// edit.
const TEST_RAYS: usize = 256;
/// Distance of the first hit of such a ray, in diagonals of the body's box: the ray does not hit its own surface again.
const LEAST_STEP: f64 = 1e-9;
/// Rays that may find a way out of a body without a warning, 3 %. With fewer, rays through the seams of walls would warn of closed rooms;
/// with more, larger gaps would pass.
const MOST_LEAKING: usize = TEST_RAYS / 32;

/// The warnings about a scene and its world.
pub fn warnings(scene: &Scene, world: &World) -> Vec<Warning> {
    let mut warnings = Vec::new();
    world.bodies.iter().for_each(|body| of_body(scene, world, body, &mut warnings));
    of_contacts(scene, world, &mut warnings);
    of_camera(scene, world, &mut warnings);
    for named in scene.lights.iter().filter(|named| light(named).power() != Rgb::ZERO) {
        let (light, subject) = (light(named), format!("light \"{}\"", named.name));
        if !light.is_outside() {
            of_light(scene, world, subject, light.center(), &mut warnings);
        }
    }
    warnings
}

/// The objects of a scene by their names, in words.
fn objects(scene: &Scene, mut objects: Vec<u32>) -> String {
    objects.dedup();
    let names: Vec<String> = objects.iter().map(|&o| format!("\"{}\"", scene.objects[o as usize].name)).collect();
    format!("{} {}", if names.len() == 1 { "object" } else { "objects" }, names.join(", "))
}

/// A camera inside of glass, or inside of an opaque solid without light.
fn of_camera(scene: &Scene, world: &World, warnings: &mut Vec<Warning>) {
    if let Some(body) = world.body(&world.camera_media) {
        let fault = format!("is inside of the glass \"{}\" and sees through it", body.name);
        warnings.push(Warning::new("the camera", fault, "move it out, unless that is meant"));
    }
    let camera = scene.camera.position;
    let sees_a_lamp = || world.lights.iter().any(|light| !light.is_outside() && sees(world, camera, light.center()));
    if world.lights.is_empty() || sees_a_lamp() {
        return;
    }
    // A room that is one object, with a lamp in it, is no fault.
    if let Some(solid) = Enclosure::around(world, camera)
        && world.lights.iter().all(|light| light.is_outside() || !solid.contains(world, light.center()))
    {
        let solid = objects(scene, solid.objects);
        let fault = format!("is inside of the opaque {solid}, without a light: the picture is black");
        warnings.push(Warning::new("the camera", fault, "move it out, or put a light in"));
    }
}

/// A light inside of glass, or inside of an opaque solid without the camera.
fn of_light(scene: &Scene, world: &World, subject: String, center: DVec3, warnings: &mut Vec<Warning>) {
    // A cavity of the index of air makes a hollow bulb.
    if let Some(body) = world.body(&world.media_around(center)).filter(|body| !body.is_air()) {
        let fault = format!("is inside of the glass \"{}\": all of its light comes out through the glass", body.name);
        warnings.push(Warning::new(subject.clone(), fault, "move it out, unless that is meant"));
    }
    let camera = scene.camera.position;
    if sees(world, center, camera) {
        return;
    }
    // A lamp in a room that is one object, with the camera in it, is no fault.
    if let Some(solid) = Enclosure::around(world, center).filter(|solid| !solid.contains(world, camera)) {
        let fault = format!("is inside of the opaque {}: none of its light comes out", objects(scene, solid.objects));
        warnings.push(Warning::new(subject, fault, "move it out, or leave an opening"));
    }
}

/// Whether no opaque surface stands between two points.
fn sees(world: &World, from: DVec3, to: DVec3) -> bool {
    let ray = Ray { t_max: 1.0, ..Ray::new(from, to - from) };
    nearest_except(world, &ray, |p| world.object_of(p).is_none() || world.body_of(p).is_some()).is_none()
}

/// The gaps of a body, and its objects with normals to the inside.
fn of_body(scene: &Scene, world: &World, body: &Body, warnings: &mut Vec<Warning>) {
    let primitives = world.aggregate.primitives();
    let named =
        |of: &[u32]| format!("glass of {}", objects(scene, of.iter().filter_map(|&p| world.object_of(p)).collect()));
    let is_open = !body.is_closed() && body.has_gaps(primitives);
    let free = free_edge(world, body);
    if free.is_some() || is_open && leaks(world, body) {
        let at = free
            .and_then(|p| world.object_of(p))
            .map_or(String::new(), |object| format!(" at the edge of \"{}\"", scene.objects[object as usize].name));
        let fault =
            format!("has gaps{at}: light that goes through a gap is taken to be on the other side of the glass");
        let remedy = "close it with surfaces of glass or opaque walls; objects that bound one piece need the same `body`, \
                      and glass of another body does not close it";
        warnings.push(Warning::new(named(&body.primitives), fault, remedy));
        return;
    }
    if is_open {
        return;
    }
    let inward = body.facing_inward(primitives, &world.surfaces);
    if !inward.is_empty() {
        let fault = "is inside out: its normals point inward, so the space around it is taken for glass".to_owned();
        let remedy = "exchange edge_u and edge_v of a quad, or reverse the order of the rows of each patch";
        warnings.push(Warning::new(named(&inward), fault, remedy));
    }
}

/// Whether light inside of an open body finds a way out that is not through its surface: past the walls around it.
fn leaks(world: &World, body: &Body) -> bool {
    let leaks = |k: &usize| {
        let at = body.primitives[k % body.primitives.len()];
        let Some((point, normal)) = point_of(&world.aggregate.primitives()[at as usize], spread(*k)) else {
            return false;
        };
        let direction = warp::uniform_sphere(spread(k / 2));
        let inward = -direction.dot(normal).signum() * direction;
        let ray = Ray { t_min: LEAST_STEP * body.bounds.diagonal(), ..Ray::new(point, inward) };
        let is_other_glass = |p: u32| world.body_of(p).is_some() && !body.primitives.contains(&p);
        nearest_except(world, &ray, is_other_glass)
            .is_none_or(|(primitive, front)| front && body.primitives.contains(&primitive))
    };
    (0..TEST_RAYS).filter(leaks).count() > MOST_LEAKING
}
