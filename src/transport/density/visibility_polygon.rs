//! The visibility polygon: the part of a plane that a point of the plane sees past objects standing on it. Photons behind such an object
//! say nothing about the light at the point, however near they are.

use super::kernel::Moments;
use crate::geometry::Primitive;
use crate::math::Ray;
use crate::world::World;
use glam::{DVec2, DVec3};

/// Directions of the rays that find the polygon. If the rays in every other direction meet nothing, the rest are not traced.
/// Twice as many double the rays at points beside objects; with half as many, objects that subtend less than 90 degrees slip between the
/// first rays, and the polygon cuts the corners of objects across 45 degrees.
const DIRECTIONS: usize = 16;
/// Height of the rays above the plane, as a fraction of the greatest distance: low enough to meet an object that touches the plane in one point
/// close to that point.
const HEIGHT: f64 = 0.01;
/// Length of the rays, as a fraction of the distance to the edge: a longer ray could hit a wall along the edge, which hides nothing.
const WHOLE: f64 = 0.999;

/// A star-shaped polygon around a point of a plane, all of it visible from the point.
#[derive(Clone, Debug)]
pub(in crate::transport) struct VisibilityPolygon {
    e0: DVec3,
    e1: DVec3,
    /// [`diamond_angle`] of the first corner.
    turn: f64,
    /// Corners relative to the point, counterclockwise, evenly spaced by [`diamond_angle`].
    corners: [DVec2; DIRECTIONS],
    /// Distance from the point to the nearest occluder.
    nearest: f64,
}

/// A point of a primitive whose visibility polygon is wanted.
pub(in crate::transport) struct VisibilityQuery<'a> {
    pub(in crate::transport) world: &'a World,
    pub(in crate::transport) primitive: &'a Primitive,
    /// Parameters of the point.
    pub(in crate::transport) uv: DVec2,
    /// Unit normal on the visible side.
    pub(in crate::transport) normal: DVec3,
    /// Radius of the disc that the polygon must cover, scene units.
    pub(in crate::transport) max_distance: f64,
    /// [`diamond_angle`] of the first direction, random so that the corners do not always lie in the same directions.
    pub(in crate::transport) turn: f64,
}

impl VisibilityQuery<'_> {
    /// The polygon and the number of rays traced; no polygon if nothing hides the primitive within `max_distance`, or if the primitive is
    /// curved.
    pub(in crate::transport) fn polygon(&self) -> (Option<VisibilityPolygon>, u64) {
        let position = match self.primitive {
            Primitive::Quad(quad) => quad.position(self.uv.x, self.uv.y),
            Primitive::Plane(plane) => plane.position(self.uv.x, self.uv.y),
            Primitive::Sphere(_) | Primitive::Patch(_) => return (None, 0),
        };
        let (e0, e1) = self.normal.any_orthonormal_pair();
        let start = position + HEIGHT * self.max_distance * self.normal;
        let mut nearest = f64::INFINITY;
        let mut corners = [DVec2::ZERO; DIRECTIONS];
        let mut trace_along = |k: usize| {
            let unit = at_diamond_angle(self.turn + 4.0 * k as f64 / DIRECTIONS as f64);
            let direction = unit.x * e0 + unit.y * e1;
            let to_edge = match self.primitive {
                Primitive::Quad(quad) => quad.distance_to_edge(self.uv, direction),
                _ => f64::INFINITY,
            };
            // The polygon's sides, not only its corners, must stay beyond `max_distance`.
            let free = to_edge.min(2.0 * self.max_distance);
            let ray = Ray { t_max: WHOLE * free.min(self.max_distance), ..Ray::new(start, direction) };
            let hit = self.world.aggregate.closest_hit(&ray).map_or(f64::INFINITY, |hit| hit.t);
            nearest = hit.min(nearest);
            corners[k] = hit.min(free) * unit;
            hit.is_finite()
        };
        let hidden = (0..DIRECTIONS).step_by(2).filter(|&k| trace_along(k)).count();
        if hidden == 0 {
            return (None, (DIRECTIONS / 2) as u64);
        }
        for k in (1..DIRECTIONS).step_by(2) {
            trace_along(k);
        }
        (Some(VisibilityPolygon { e0, e1, turn: self.turn, corners, nearest }), DIRECTIONS as u64)
    }
}

impl VisibilityPolygon {
    /// Whether an occluder lies within the disc of this radius.
    pub(in crate::transport) fn hides_within(&self, radius: f64) -> bool {
        self.nearest < radius
    }

    /// Whether a point at this offset from the middle projects into the polygon.
    pub(in crate::transport) fn contains(&self, offset: DVec3) -> bool {
        let p = DVec2::new(offset.dot(self.e0), offset.dot(self.e1));
        let sector = (diamond_angle(p) - self.turn).rem_euclid(4.0) / 4.0 * DIRECTIONS as f64;
        let k = sector as usize % DIRECTIONS;
        let (a, b) = (self.corners[k], self.corners[(k + 1) % DIRECTIONS]);
        (b - a).perp_dot(p - a) >= 0.0
    }

    /// Moments of the kernel over the disc of this radius, clipped to the polygon.
    pub(in crate::transport) fn moments(&self, radius: f64) -> Moments {
        Moments::of_polygon(self.corners, radius)
    }

    /// A vector of the plane, in world coordinates.
    pub(in crate::transport) fn in_world(&self, v: DVec2) -> DVec3 {
        v.x * self.e0 + v.y * self.e1
    }
}

/// A number from 0 to 4 that grows with the angle of a vector from the first axis, and is cheaper than the angle.
fn diamond_angle(v: DVec2) -> f64 {
    let fraction = v.y / (v.x.abs() + v.y.abs());
    match (v.x >= 0.0, v.y >= 0.0) {
        (true, true) => fraction,
        (false, _) => 2.0 - fraction,
        (true, false) => 4.0 + fraction,
    }
}

/// The unit vector with this [`diamond_angle`], which repeats after 4.
fn at_diamond_angle(angle: f64) -> DVec2 {
    let turned = angle.rem_euclid(4.0);
    let y = if turned < 1.0 {
        turned
    } else if turned < 3.0 {
        2.0 - turned
    } else {
        turned - 4.0
    };
    let x = 1.0 - y.abs();
    DVec2::new(if (1.0..3.0).contains(&turned) { -x } else { x }, y).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::density::kernel::Clipped;
    use crate::transport::testing::{self, quad};

    /// A floor of 2 x 2 about the origin, and screens that stand on it along x = 0.2 and along its edge x = 1.
    fn world() -> World {
        let screen = |name, x| quad(name, [[x, 0.0, -3.0], [0.0, 0.0, 6.0], [0.0, 1.0, 0.0]], "grey");
        let floor = quad("floor", [[-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "grey");
        testing::world(&[floor, screen("screen", 0.2), screen("wall", 1.0)].concat())
    }

    /// From the point of the floor at x, z = 0.
    fn look(world: &World, x: f64, max_distance: f64) -> Option<VisibilityPolygon> {
        let primitive = &world.aggregate.primitives()[0];
        let uv = DVec2::new(0.5 * (x + 1.0), 0.5);
        VisibilityQuery { world, primitive, uv, normal: DVec3::Y, max_distance, turn: 0.3 }.polygon().0
    }

    #[test]
    fn a_screen_hides_the_floor_behind_it() {
        let world = world();
        let view = look(&world, 0.0, 0.5).expect("the screen hides a part");
        assert!(view.hides_within(0.25) && !view.hides_within(0.19));
        for (x, z, seen) in [(0.19, 0.05, true), (0.21, 0.05, false), (-0.45, 0.1, true), (0.3, -0.3, false)] {
            assert_eq!(view.contains(DVec3::new(x, 0.0, z)), seen, "({x}, {z})");
        }
        // The same as a floor that ends there, but for the corners between two directions.
        let ends = Clipped::new(DVec2::new(-1.0, -1.0), DVec2::new(1.2, 0.0), DVec2::new(0.0, 2.0), [false; 4], 0.5);
        let ((_, found), (_, expected)) = (
            view.moments(0.5).slope_and_integral(false, 0.5),
            ends.expect("the disc is clipped").moments().slope_and_integral(false, 0.5),
        );
        assert!((found / expected - 1.0).abs() < 0.03, "{found} against {expected}");
    }

    #[test]
    fn walls_along_edges_hide_nothing() {
        let world = world();
        assert!(look(&world, -0.5, 0.5).is_none());
        assert!(look(&world, 0.8, 0.5).is_none());
    }

    #[test]
    fn diamond_angles_grow_around_the_circle() {
        for k in 0..80 {
            let angle = f64::from(k) / 20.0;
            let v = at_diamond_angle(angle);
            assert!((v.length() - 1.0).abs() < 1e-12 && (diamond_angle(v) - angle).abs() < 1e-12, "{angle}");
            let next = at_diamond_angle(angle + 0.05);
            assert!(v.perp_dot(next) > 0.0 && at_diamond_angle(angle + 4.0).abs_diff_eq(v, 1e-12), "{angle}");
        }
    }
}
