//! Whether two primitives coincide over an area.

use super::crossings::point_of;
use crate::geometry::{Hit, Plane, Primitive, Sphere};
use crate::math::Ray;
use crate::math::float::{SELF_HIT_OFFSET, rounding};
use glam::{DVec2, DVec3};

/// Tolerance of a contact over the rounding of its surfaces: of curved surfaces, rounding depends on the direction of the normal.
const MARGIN: f64 = 2.0;
/// How near surfaces are that may be in contact, relative to their coordinates: no nearer than a ray starts off a surface that it leaves,
/// else the ray would miss the second surface.
pub(in crate::world) const TOUCHING: f64 = MARGIN * SELF_HIT_OFFSET;
/// Greatest sine of the angle between two flat surfaces that coincide over an area: at greater angles they are within rounding of each
/// other only along a line.
const PARALLEL: f64 = 1e-6;
/// Points along each side of a curved patch at which its distance to another one is tested. Fewer would miss patches that share
/// some thousandths of their area; more would take time for each pair of patches whose boxes meet, after each edit.
const TESTED: usize = 32;
/// The same for patches of one object, of which most pairs only share an edge: enough for patches that coincide as a whole.
const TESTED_IN_OBJECT: usize = 3;

/// A primitive, and the [magnitude](Primitive::magnitude) of its coordinates.
#[derive(Clone, Copy)]
pub(super) struct Shape<'a> {
    pub(super) primitive: &'a Primitive,
    pub(super) magnitude: DVec3,
}

/// A flat primitive.
struct Flat {
    /// Points whose convex hull holds the primitive; none for a plane, which is unbounded.
    points: Vec<DVec3>,
    /// Some edges of that hull.
    edges: [DVec3; 4],
    /// A point of the primitive.
    point: DVec3,
    /// Unit length.
    normal: DVec3,
}

impl Shape<'_> {
    /// At least the tolerance of a contact of this primitive, scene units.
    pub(super) fn reach(&self) -> f64 {
        let extent = self.extent();
        // Three coordinates, each with its own rounding.
        3.0 * TOUCHING * self.magnitude.length().max(if extent.is_finite() { extent } else { 0.0 })
    }

    /// The diagonal of the primitive's box, scene units; infinite for a plane.
    fn extent(&self) -> f64 {
        let bounds = self.primitive.bounds();
        if bounds.is_empty() { f64::INFINITY } else { bounds.diagonal() }
    }

    /// The primitive as a flat one; `None` if it is not flat up to rounding.
    fn flat(&self) -> Option<Flat> {
        match self.primitive {
            Primitive::Quad(quad) => {
                let (u, v) = quad.edges();
                let point = quad.position(0.0, 0.0);
                Some(Flat { points: quad.corners().to_vec(), edges: [u, v, u, v], point, normal: quad.normal() })
            }
            Primitive::Plane(plane) => Some(Flat::unbounded(plane)),
            Primitive::Patch(patch) => {
                let net = patch.net();
                let points = net.points.as_flattened().to_vec();
                let (point, normal) = (points[0], patch.normal(0.5, 0.5));
                let tolerance = MARGIN * rounding(self.magnitude, normal).max(SELF_HIT_OFFSET * self.extent());
                let is_flat = points.iter().all(|p| normal.dot(*p - point).abs() <= tolerance);
                let [a, b, c, d] = [net.points[0][0], net.points[3][0], net.points[3][3], net.points[0][3]];
                is_flat.then(|| Flat { points, edges: [b - a, c - b, d - c, a - d], point, normal })
            }
            Primitive::Sphere(_) => None,
        }
    }
}

impl Flat {
    fn unbounded(plane: &Plane) -> Self {
        Self { points: Vec::new(), edges: [DVec3::ZERO; 4], point: plane.position(0.0, 0.0), normal: plane.normal() }
    }

    /// The least and the greatest coordinate of the points along an axis.
    fn range(&self, axis: DVec3) -> [f64; 2] {
        if self.points.is_empty() {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        let along = self.points.iter().map(|p| axis.dot(*p - self.point));
        let base = axis.dot(self.point);
        along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(base + x), high.max(base + x)])
    }

    /// Whether two flat primitives may share an area of their planes, for this distance between the planes at most. An edge that separates
    /// them shows that they do not.
    fn overlaps(&self, other: &Self, distance: f64) -> bool {
        let heights = other.points.iter().map(|p| self.normal.dot(*p - self.point));
        let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)]);
        let meet = other.points.is_empty() || (low <= distance && high >= -distance);
        let is_parallel = self.normal.cross(other.normal).length() <= PARALLEL;
        let edges = self.edges.iter().chain(&other.edges);
        let mut across =
            edges.map(|edge| edge.cross(self.normal).normalize_or_zero()).filter(|axis| *axis != DVec3::ZERO);
        is_parallel
            && meet
            && across.all(|axis| {
                let ([a, b], [c, d]) = (self.range(axis), other.range(axis));
                b.min(d) - a.max(c) > distance
            })
    }
}

/// The distance at which two primitives are one where they coincide over an area, scene units: at least the rounding of both, and of the extent
/// of the smaller one wherever the origin is. `None` if they do not coincide.
///
/// A part of a polynomial patch can be flat only if the whole is, and is never a part of a sphere.
pub(super) fn contact(a: Shape, b: Shape, is_one_object: bool) -> Option<f64> {
    let least = a.extent().min(b.extent());
    let least = if least.is_finite() { SELF_HIT_OFFSET * least } else { 0.0 };
    let tolerance = |magnitude: DVec3, normal| MARGIN * rounding(magnitude, normal).max(least);
    let both = a.magnitude.max(b.magnitude);
    // Curved surfaces have normals in many directions: the rounding of all coordinates adds up.
    let in_any_direction = tolerance(both, DVec3::ONE);
    match (a.primitive, b.primitive) {
        (Primitive::Sphere(p), Primitive::Sphere(q)) => {
            let known = in_any_direction;
            is_same_sphere(p, q, known).then_some(known)
        }
        (Primitive::Sphere(_), _) | (_, Primitive::Sphere(_)) => None,
        _ => match (a.flat(), b.flat()) {
            (Some(p), Some(q)) => {
                // On an unbounded plane the coordinates of the contact are those of the other primitive.
                let known = tolerance(both, p.normal);
                p.overlaps(&q, known).then_some(known)
            }
            (None, None) => {
                let known = in_any_direction;
                (touches(a, b, known, is_one_object) || touches(b, a, known, is_one_object)).then_some(known)
            }
            _ => None,
        },
    }
}

fn is_same_sphere(a: &Sphere, b: &Sphere, tolerance: f64) -> bool {
    a.center.distance(b.center) + (a.radius - b.radius).abs() <= tolerance
}

/// Whether a tested point of `a` touches `b`.
fn touches(a: Shape, b: Shape, distance: f64, is_one_object: bool) -> bool {
    let bounds = b.primitive.bounds().inflated(distance);
    let along = if is_one_object { TESTED_IN_OBJECT } else { TESTED };
    (0..along * along).any(|k| {
        let uv = (DVec2::new((k % along) as f64, (k / along) as f64) + 0.5) / along as f64;
        point_of(a.primitive, uv).is_some_and(|(point, normal)| {
            bounds.distance(point) == 0.0 && touching(b.primitive, 0, [point, normal], distance).is_some()
        })
    })
}

/// The hit on a primitive within this distance of a point of another surface with this unit normal, and the primitive's unit normal
/// there; `None` where they do not touch.
pub(in crate::world) fn touching(
    primitive: &Primitive,
    index: u32,
    [point, normal]: [DVec3; 2],
    distance: f64,
) -> Option<(Hit, DVec3)> {
    let ray = Ray { t_max: 2.0 * distance, ..Ray::new(point + distance * normal, -normal) };
    let (t, u, v) = primitive.intersect(&ray)?;
    let hit = Hit { t, primitive: index, u, v };
    Some((hit, primitive.surface(&ray, &hit).1))
}
