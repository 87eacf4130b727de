//! Newton's method for the root in a part of a patch, with proof of what it found.

use super::power::{PowerForm, Tangents};
use super::unit::UnitRay;

/// Roots this far outside of a part, in x and y, still count: neighbouring parts and patches overlap by far more than
/// rounding, hence no ray slips between them, and by far less than anyone can see.
const SLACK: f64 = 1e-9;

/// Steps, relative to the part, below which the next one is lost in rounding: the error is the square of the last step.
const LAST_STEP: f64 = 1e-6;

/// Steps after which subdivision is the better way. From within a nearly flat part three suffice.
const MAX_STEPS: usize = 8;

/// Steps that may lead out of the part before subdivision takes over.
const MAX_CLAMPED: usize = 1;

/// Part of the parameter square, by its middle and half its size, in `x = 2 u - 1` and `y = 2 v - 1`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Domain {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) half_x: f64,
    pub(super) half_y: f64,
}

/// A root: x, y, and the height z on the ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) z: f64,
}

/// What Newton's method proved.
pub(super) enum Outcome {
    /// The only root of the part.
    Root(Root),
    /// The part has no root.
    None,
    /// Nothing.
    Unknown,
}

impl Domain {
    pub(super) const WHOLE: Self = Self { x: 0.0, y: 0.0, half_x: 1.0, half_y: 1.0 };

    pub(super) fn halves_x(&self) -> [Self; 2] {
        let half_x = 0.5 * self.half_x;
        [Self { x: self.x - half_x, half_x, ..*self }, Self { x: self.x + half_x, half_x, ..*self }]
    }

    pub(super) fn halves_y(&self) -> [Self; 2] {
        let half_y = 0.5 * self.half_y;
        [Self { y: self.y - half_y, half_y, ..*self }, Self { y: self.y + half_y, half_y, ..*self }]
    }
}

/// Looks for the root in a part where the ray is known to meet the patch once at most, starting from (x, y).
///
/// `nonlinearity` is a bound c of the norm of `A J - 1` over the part, in coordinates in which the part is the square
/// `[-1, 1]^2`: J is the Jacobian of the equations and A some matrix. A Newton step from x leads to within
/// `k |x - root|` of the root, with `k = 2 c / (1 - c)`, since the inverse of `A J` is at most `1 / (1 - c)` and two
/// values of `A J` differ by at most 2 c. So with the length s of the step, the root is at most
/// `k / (1 - k) s = 2 c / (1 - 3 c) s` away from where the step leads. With c >= 1/3 that says nothing, and a root may be
/// found but not excluded.
#[inline(always)]
pub(super) fn solve(patch: &PowerForm, ray: &UnitRay, part: &Domain, nonlinearity: f64, start: (f64, f64)) -> Outcome {
    let reach = if nonlinearity < 0.33 { 2.0 * nonlinearity / (1.0 - 3.0 * nonlinearity) } else { f64::INFINITY };
    let (limit_x, limit_y) = (part.half_x + SLACK, part.half_y + SLACK);
    let (mut x, mut y) = start;
    let mut clamped = 0;
    for _ in 0..MAX_STEPS {
        let p = patch.tangents(x, y);
        let (dx, dy) = step(&p, ray);
        let (off_x, off_y) = ((x + dx - part.x).abs() - limit_x, (y + dy - part.y).abs() - limit_y);
        let length = (dx.abs() / part.half_x).max(dy.abs() / part.half_y);
        let outside = (off_x / part.half_x).max(off_y / part.half_y);
        if outside > reach * length {
            return Outcome::None;
        }
        if length < LAST_STEP && outside <= 0.0 {
            let position = p.position + dx * p.dx + dy * p.dy;
            return Outcome::Root(Root { x: x + dx, y: y + dy, z: ray.direction.dot(position - ray.origin) });
        }
        clamped += usize::from(outside > 0.0);
        if clamped > MAX_CLAMPED || outside.is_nan() {
            break;
        }
        x = (x + dx).clamp(part.x - limit_x, part.x + limit_x);
        y = (y + dy).clamp(part.y - limit_y, part.y + limit_y);
    }
    Outcome::Unknown
}

/// The Newton step: where the ray meets the tangent plane, by Cramer's rule. Not finite where it does not.
#[inline(always)]
fn step(p: &Tangents, ray: &UnitRay) -> (f64, f64) {
    let to_ray = ray.origin - p.position;
    let across_y = p.dy.cross(ray.direction);
    let inverse = 1.0 / p.dx.dot(across_y);
    (to_ray.dot(across_y) * inverse, p.dx.cross(to_ray).dot(ray.direction) * inverse)
}
