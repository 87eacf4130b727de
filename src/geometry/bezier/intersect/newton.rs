//! Newton's method for the hit of a ray on a subpatch: the root of two equations, the offsets of a point of the patch
//! from the ray along two axes across the ray \[Kajiya82\]. As in \[Toth85\], a bound of the Jacobian proves the
//! result.

use super::power::{PowerForm, Tangents};
use crate::geometry::bezier::unit::{Domain, UnitRay};
use crate::math::lanes::Lanes;
use glam::DVec3;

/// Newton's method ends after a step shorter than this, relative to the subpatch: the next step would be about the square of
/// this one times the bending, some 1e-12 of the patch.
const LAST_STEP: f64 = 1e-5;

/// Steps after which subdivision takes over. Three suffice within a nearly flat subpatch.
const MAX_STEPS: usize = 8;

/// Steps that may lead out of the subpatch before subdivision takes over.
const MAX_CLAMPED: usize = 1;

/// A root: its parameters x and y, and its z on the ray, in unit space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Root {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) z: f64,
}

/// The result of Newton's method, with its proof.
pub(crate) enum Outcome {
    /// This is the only root in the subpatch.
    Root(Root),
    /// The subpatch has no root.
    NoRoot,
    /// The bounds prove neither: subdivision has to decide.
    Unknown,
}

/// Why a root in a subpatch is unique: from this, Newton's method concludes that its root is the only root, or that no
/// root exists.
pub(crate) struct Uniqueness {
    /// The domain enlarged by this factor has at most one root with this `slope`.
    pub(crate) enlargement: f64,
    /// The sign of `direction . (dS/dx x dS/dy)` at the root; zero if there is at most one root of either sign.
    pub(crate) slope: f64,
    /// The distance of a root in the subpatch to the end of a Newton step is at most this times the length of the step;
    /// infinite if no such bound is known.
    pub(crate) reach: f64,
}

impl Uniqueness {
    /// From a bound c of the norm of `A J - 1` over a subpatch, where J is the Jacobian of the equations and A any matrix,
    /// in coordinates in which the domain is the square `[-1, 1]^2`. `None` where c proves no uniqueness.
    ///
    /// A Newton step from x ends within `k |x - root|` of the root, with `k = 2 c / (1 - c)`: the inverse of `A J` is at
    /// most `1 / (1 - c)`, and two values of `A J` differ by at most 2 c. For a step of length s, the root is thus at most
    /// `k / (1 - k) s = 2 c / (1 - 3 c) s` away from the end of the step, as long as `3 c < 1`.
    pub(crate) fn from_nonlinearity(c: f64) -> Option<Self> {
        let reach = if c < 0.33 { 2.0 * c / (1.0 - 3.0 * c) } else { f64::INFINITY };
        (c < 1.0).then_some(Self { enlargement: 1.0, slope: 0.0, reach })
    }
}

/// Looks for the root in a subpatch by Newton's method, from a start (x, y).
#[inline(always)]
pub(crate) fn solve(
    l: impl Lanes,
    patch: &PowerForm,
    ray: &UnitRay,
    domain: &Domain,
    uniqueness: &Uniqueness,
    start: (f64, f64),
) -> Outcome {
    let (mut x, mut y) = start;
    let mut clamped = 0;
    for _ in 0..MAX_STEPS {
        let p = patch.tangents(l, x, y);
        let step = step(l, &p, ray);
        let (next_x, next_y) = (x + step.dx, y + step.dy);
        let length = (step.dx.abs() / domain.half_x).max(step.dy.abs() / domain.half_y);
        let outside = domain.outside(next_x, next_y, 1.0, patch.slack);
        if outside > uniqueness.reach * length {
            return Outcome::NoRoot;
        }
        let enlargement = uniqueness.enlargement;
        let beyond =
            if enlargement == 1.0 { outside } else { domain.outside(next_x, next_y, enlargement, patch.slack) };
        if length < LAST_STEP && beyond <= 0.0 {
            if step.slope * uniqueness.slope < 0.0 {
                return Outcome::Unknown;
            }
            if outside > 0.0 {
                return Outcome::NoRoot;
            }
            let position = p.position + step.dx * p.dx + step.dy * p.dy;
            return Outcome::Root(Root { x: next_x, y: next_y, z: ray.direction.dot(position - ray.origin) });
        }
        clamped += usize::from(beyond > 0.0);
        if clamped > MAX_CLAMPED || beyond.is_nan() {
            break;
        }
        (x, y) = domain.clamped(next_x, next_y, enlargement, patch.slack);
    }
    Outcome::Unknown
}

/// A Newton step.
struct Step {
    dx: f64,
    dy: f64,
    /// `direction . (dS/dx x dS/dy)`.
    slope: f64,
}

/// The Newton step, by Cramer's rule, to the intersection of the ray with the tangent plane. Not finite where they are
/// parallel.
#[inline(always)]
fn step(l: impl Lanes, p: &Tangents, ray: &UnitRay) -> Step {
    let to_ray = ray.origin - p.position;
    let across_y = cross(l, p.dy, ray.direction);
    let slope = dot(l, p.dx, across_y);
    let inverse = 1.0 / slope;
    let dx = dot(l, to_ray, across_y) * inverse;
    Step { dx, dy: dot(l, cross(l, p.dx, to_ray), ray.direction) * inverse, slope }
}

#[inline(always)]
fn dot(l: impl Lanes, a: DVec3, b: DVec3) -> f64 {
    l.mul_add_f64(a.x, b.x, l.mul_add_f64(a.y, b.y, a.z * b.z))
}

#[inline(always)]
fn cross(l: impl Lanes, a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(
        l.mul_add_f64(a.y, b.z, -(a.z * b.y)),
        l.mul_add_f64(a.z, b.x, -(a.x * b.z)),
        l.mul_add_f64(a.x, b.y, -(a.y * b.x)),
    )
}
