//! Faults of a scene that can be rendered: glass that is open or inside out, lights and cameras inside of solids.

use super::bodies::{Body, point_of, spread};
use super::prepare::light;
use super::{Surface, World};
use crate::math::{Ray, Rgb, warp};
use crate::scene::{Scene, Shape};
use glam::DVec3;

/// Rays into a body that tell whether walls close it. Fewer would leave gaps of a few percent to chance; more would take time after each
/// edit.
const TEST_RAYS: usize = 256;
/// Distance of the first hit of such a ray, in diagonals of the body's box: the ray does not hit its own surface again.
const LEAST_STEP: f64 = 1e-9;
/// Rays that may find a way out of a body without a warning, 3 %. With fewer, rays through the seams of walls would warn of closed rooms;
/// with more, larger gaps would pass.
const MOST_LEAKING: usize = TEST_RAYS / 32;

/// A fault of a scene that can be rendered, but is likely not meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The object, the light or the camera, with its name.
    pub subject: String,
    /// The fault, and its effect on the picture.
    pub fault: String,
    /// How to mend it.
    pub remedy: String,
}

/// The warnings about a scene and its world.
pub fn warnings(scene: &Scene, world: &World) -> Vec<Warning> {
    let mut warnings = Vec::new();
    world.bodies.iter().for_each(|body| of_body(scene, world, body, &mut warnings));
    of_contacts(scene, world, &mut warnings);
    let solids = solids(scene, world);
    let hidden_by = |point: DVec3| solids.iter().find(|solid| solid.contains(point, world.aggregate.primitives()));
    let camera = scene.camera.position;
    if let Some(body) = world.body(&world.camera_media) {
        let fault = format!("is inside of the glass \"{}\" and sees through it", body.name);
        warnings.push(Warning::new("the camera", fault, "move it out, unless that is meant"));
    }
    for named in scene.lights.iter().filter(|named| light(named).power() != Rgb::ZERO) {
        let (light, subject) = (light(named), format!("light \"{}\"", named.name));
        if light.is_outside() {
            continue;
        }
        let center = light.center();
        // A cavity of the index of air makes a hollow bulb.
        if let Some(body) = world.body(&world.media_around(center)).filter(|body| !body.is_air()) {
            let fault =
                format!("is inside of the glass \"{}\": all of its light comes out through the glass", body.name);
            warnings.push(Warning::new(subject.clone(), fault, "move it out, unless that is meant"));
        }
        // A lamp in a room that is one object, with the camera in it, is no fault.
        if let Some(solid) = hidden_by(center).filter(|solid| !solid.contains(camera, world.aggregate.primitives())) {
            let fault = format!("is inside of the opaque object \"{}\": none of its light comes out", solid.name);
            warnings.push(Warning::new(subject, fault, "move it out of the object"));
        }
    }
    warnings
}

impl Warning {
    fn new(subject: impl Into<String>, fault: String, remedy: &str) -> Self {
        Self { subject: subject.into(), fault, remedy: remedy.to_owned() }
    }
}

/// The gaps of a body, and its objects with normals to the inside.
fn of_body(scene: &Scene, world: &World, body: &Body, warnings: &mut Vec<Warning>) {
    let primitives = world.aggregate.primitives();
    let objects = |of: &[u32]| {
        let mut objects: Vec<u32> = of.iter().filter_map(|&p| world.object_of(p)).collect();
        objects.dedup();
        let names: Vec<String> = objects.iter().map(|&o| format!("\"{}\"", scene.objects[o as usize].name)).collect();
        format!("{} {}", if names.len() == 1 { "object" } else { "objects" }, names.join(", "))
    };
    if body.has_gaps(primitives) {
        if leaks(world, body) {
            let subject = format!("glass of {}", objects(&body.primitives));
            let fault =
                "has gaps: light that goes through a gap is taken to be on the other side of the glass".to_owned();
            let remedy =
                "close it with surfaces of glass or opaque walls; objects that bound one piece need the same `body`";
            warnings.push(Warning::new(subject, fault, remedy));
        }
        return;
    }
    let inward = body.facing_inward(primitives);
    if !inward.is_empty() {
        let subject = format!("glass of {}", objects(&inward));
        let fault = "is inside out: its normals point inward, so the space around it is taken for glass".to_owned();
        let remedy = "exchange edge_u and edge_v of a quad, or reverse the order of the rows of each patch";
        warnings.push(Warning::new(subject, fault, remedy));
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
        world
            .aggregate
            .closest_hit(&ray)
            .is_none_or(|hit| body.primitives.contains(&hit.primitive) && world.surface_point(&ray, hit).front)
    };
    (0..TEST_RAYS).filter(leaks).count() > MOST_LEAKING
}

/// Surfaces of one medium that coincide and belong to two bodies.
fn of_contacts(scene: &Scene, world: &World, warnings: &mut Vec<Warning>) {
    for (a, b) in world.contacts.pairs() {
        let (Some(body), Some(other)) = (world.body_of(a), world.body_of(b)) else { continue };
        let [p, q] = [body, other].map(|rank| &world.bodies[rank as usize]);
        if body != other && (p.ior, p.absorption) == (q.ior, q.absorption) {
            let names = [a, b].map(|k| world.object_of(k).map_or("", |o| &scene.objects[o as usize].name));
            let fault =
                format!("coincides with a face of \"{}\", of the same medium: the faces are invisible", names[1]);
            let remedy = "leave both faces out, or give the objects the same `body`";
            warnings.push(Warning::new(format!("object \"{}\"", names[0]), fault, remedy));
        }
    }
}

/// The opaque objects that may hold something: spheres and closed sets of patches.
fn solids(scene: &Scene, world: &World) -> Vec<Body> {
    let mut solids: Vec<(u32, Body)> = Vec::new();
    for (p, surface) in (0..).zip(&world.surfaces) {
        let Surface::Object { object, body: None, .. } = *surface else { continue };
        if !matches!(scene.objects[object as usize].shape, Shape::Sphere { .. } | Shape::Bezier(_)) {
            continue;
        }
        if solids.last().is_none_or(|(last, _)| *last != object) {
            solids.push((object, Body::new(scene.objects[object as usize].name.clone(), 1.0, Rgb::ZERO)));
        }
        if let Some((_, solid)) = solids.last_mut() {
            solid.add(p, &world.aggregate.primitives()[p as usize]);
        }
    }
    solids.into_iter().map(|(_, solid)| solid).collect()
}
