//! Free edges of glass: light goes around them from the outside of a body to its inside.

use super::passing::nearest_except;
use crate::geometry::Primitive;
use crate::math::Ray;
use crate::math::float::SELF_HIT_OFFSET;
use crate::world::bodies::{Body, TOUCHING, point_of, spread, touching};
use crate::world::{Surface, World};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Points at which each edge is tested. With fewer, a gap along a part of an edge would pass.
const POINTS: usize = 4;
/// Tests of one body at most. More would take time after each edit of a body of many surfaces.
const MOST_TESTS: usize = 1024;
/// Distance from an edge at which light goes around it, in diagonals of the body's box: wider gaps are found. A smaller distance would tell
/// of seams that are joined up to the rounding of a file.
const DISTANCE: f64 = 1e-3;
/// Least such distance, in diagonals of the body's box. Surfaces that are narrower, as the rim of a film, have no edges of their own.
const LEAST_DISTANCE: f64 = 1e-6;
/// Least such distance over the rounding of coordinates: else a surface would hide its own edge.
const OVER_ROUNDING: f64 = 100.0;
/// Greatest distance of an edge from the middle of the view, in distances of the camera from what it sees. Light around edges farther away,
/// as at the horizon of a sea, hardly shows.
const FAR: f64 = 20.0;
/// The first hit of a ray that leaves a surface, in lengths of the ray: the ray does not hit the same point again.
const LEAST_STEP: f64 = 0.01;
/// Directions in which the corners of a way around an edge lie, degrees from the surface over its front. Surfaces of a box meet at right
/// angles, so no corner lies on one.
const CORNERS: [f64; 4] = [73.0, 142.0, 211.0, 281.0];
/// Points between the middle of a surface and its edge at which a curved surface is followed.
const STEPS: usize = 8;

/// An edge of a patch or a quad: the edge at `end` of the parameter `axis`.
#[derive(Clone, Copy)]
struct Edge {
    primitive: u32,
    axis: usize,
    end: f64,
}

/// A way around an edge: it begins at a point of the surface beside the edge.
struct Way {
    uv: DVec2,
    start: DVec3,
    /// The unit normal at the start.
    normal: DVec3,
    /// From the start to the edge, across the normal.
    across: DVec3,
}

/// The primitive of the first edge of a body around which light goes from the front of the surface to its back.
pub(super) fn free_edge(world: &World, body: &Body) -> Option<u32> {
    let edges: Vec<Edge> = body.primitives.iter().flat_map(|&p| edges(world, p)).collect();
    let tests = (POINTS * edges.len()).min(MOST_TESTS);
    let test = |k: usize| {
        let edge = edges[k * edges.len() / tests];
        let way = edge.way(world, body, spread(k).x)?;
        (goes_around(world, body, edge.primitive, &way) && !is_hidden(world, edge.primitive, &way))
            .then_some(edge.primitive)
    };
    (0..tests).into_par_iter().find_map_first(test)
}

/// The edges of a primitive, except those over which its sheet goes on.
fn edges(world: &World, primitive: u32) -> impl Iterator<Item = Edge> {
    let shared = match world.surfaces[primitive as usize] {
        Surface::Object { shared, .. } => [shared.u, shared.v],
        Surface::Light(_) => Default::default(),
    };
    let has_edges =
        matches!(world.aggregate.primitives()[primitive as usize], Primitive::Quad(_) | Primitive::Patch(_));
    let all = [0, 1].into_iter().flat_map(|axis| [0, 1].map(|end| (axis, end)));
    all.filter(move |&(axis, end)| has_edges && !shared[axis][end]).map(move |(axis, end)| Edge {
        primitive,
        axis,
        end: end as f64,
    })
}

impl Edge {
    /// The way around the edge at a point along it; `None` where the surface is too narrow, and far from the view.
    fn way(&self, world: &World, body: &Body, along: f64) -> Option<Way> {
        let primitive = &world.aggregate.primitives()[self.primitive as usize];
        // The loop around a point near a corner would meet the edge beyond the corner, too.
        let along = 0.1 + 0.8 * along;
        let at = |inward: f64| {
            let from_end = (self.end - inward).abs();
            if self.axis == 0 { DVec2::new(from_end, along) } else { DVec2::new(along, from_end) }
        };
        let (point, _) = point_of(primitive, at(0.0))?;
        if point.distance(world.view.center) > FAR * world.view.distance {
            return None;
        }
        let half_width = point.distance(point_of(primitive, at(0.5))?.0);
        let distance = DISTANCE * body.bounds.diagonal();
        let uv = at(0.5 * (distance / half_width).min(1.0));
        let (start, normal) = point_of(primitive, uv)?;
        let across = (point - start).reject_from_normalized(normal);
        let rounding = OVER_ROUNDING * SELF_HIT_OFFSET * primitive.magnitude().max_element();
        let least = rounding.max(LEAST_DISTANCE * body.bounds.diagonal());
        (across.length() > least).then_some(Way { uv, start, normal, across })
    }
}

/// Whether a way around the edge, from the front of the surface to its back, meets nothing but glass of other bodies.
fn goes_around(world: &World, body: &Body, primitive: u32, way: &Way) -> bool {
    let edge = way.start + way.across;
    let radius = way.across.length();
    let corner = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        edge - cos * way.across + sin * radius * way.normal
    };
    let [a, b, c, d] = CORNERS.map(corner);
    let corners = [way.start, a, b, c, d, way.start];
    let rank = world.body_of(primitive);
    let is_passed = |p: u32| world.body_of(p).is_some() && world.body_of(p) != rank;
    let hit = corners.windows(2).enumerate().find_map(|(k, ends)| {
        let least = if k == 0 { LEAST_STEP } else { 0.0 };
        let ray = segment(ends[0], ends[1], least);
        nearest_except(world, &ray, is_passed)
    });
    // The last stretch ends at the back of the surface itself, which it may miss by rounding.
    let is_back = hit.is_none_or(|(hit, front)| hit == primitive && !front);
    let on_start = |&&other: &&u32| {
        let shape = &world.aggregate.primitives()[other as usize];
        let rounding = TOUCHING * shape.magnitude().length();
        other != primitive && touching(shape, other, [way.start, way.normal], rounding).is_some()
    };
    // The two faces of a sheet without thickness close each other.
    is_back && body.primitives.iter().find(on_start).is_none()
}

/// Whether an opaque surface stands between the middle of a surface and its edge, on one side or the other: the edge lies in a wall or
/// under the ground.
fn is_hidden(world: &World, primitive: u32, way: &Way) -> bool {
    let is_glass = |p: u32| world.body_of(p).is_some();
    [way.across.length(), -way.across.length()].into_iter().any(|height| {
        let beside = |k: usize| {
            let uv = DVec2::splat(0.5).lerp(way.uv, k as f64 / STEPS as f64);
            point_of(&world.aggregate.primitives()[primitive as usize], uv)
                .map_or(way.start, |(point, normal)| point + height * normal)
        };
        (0..STEPS).any(|k| nearest_except(world, &segment(beside(k), beside(k + 1), 0.0), is_glass).is_some())
    })
}

/// The ray from a point to another one, which hits nothing before it is `least` of its length.
fn segment(from: DVec3, to: DVec3, least: f64) -> Ray {
    let length = from.distance(to);
    Ray { t_min: least * length, t_max: length, ..Ray::new(from, (to - from) / length) }
}
