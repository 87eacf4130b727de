//! Newton's method for the root in a part of a patch, with proof of what it found.

use super::ControlNet;
use super::power::{PowerForm, Tangents};
use super::unit::UnitRay;
use crate::math::lanes::Lanes;
use glam::DVec3;

/// How far outside of a part roots still count, in x and y: neighbouring parts and patches overlap by far more than
/// rounding, hence no ray slips between them, and by far less than anyone can see. Where a derivative vanishes, that is no
/// overlap in space; there subdivision decides, with a slack of its own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slack {
    x: f64,
    y: f64,
}

impl Slack {
    /// For a patch in unit space, by its control points.
    pub(super) fn new(net: &ControlNet) -> Self {
        Self { x: along(&net.transposed()), y: along(net) }
    }
}

/// The overlap of all parts, in x and y.
const OVERLAP: f64 = 1e-9;
/// The least overlap in unit space, for patches that are narrow: some digits of a ray that starts thousands of patches
/// away are lost.
const OVERLAP_IN_SPACE: f64 = 1e-11;
/// No overlap is larger, in x and y, however narrow the patch.
const MOST_OVERLAP: f64 = 1e-6;

/// The slack along the rows of a net.
fn along(net: &ControlNet) -> f64 {
    let steps = net.points.iter().flat_map(|row| row.windows(2).map(|pair| pair[0].distance(pair[1])));
    // Three steps over the two units of x.
    let longest = 1.5 * steps.fold(0.0, f64::max);
    (OVERLAP + OVERLAP_IN_SPACE / longest).min(MOST_OVERLAP)
}

/// Steps, relative to the part, after which no further one is made: the next would be this step squared, times what parts
/// bend, some 1e-12 of the patch.
const LAST_STEP: f64 = 1e-5;

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

    /// By how much a point is outside of the domain enlarged by a factor, and by some slack, in units of its half size;
    /// negative inside.
    #[inline(always)]
    fn outside(&self, x: f64, y: f64, enlarged: f64, slack: Slack) -> f64 {
        let off = |distance: f64, half: f64, slack: f64| (distance.abs() - enlarged * half - slack) / half;
        let (x, y) = (off(x - self.x, self.half_x, slack.x), off(y - self.y, self.half_y, slack.y));
        // Keeps a NaN.
        if x > y { x } else { y }
    }

    /// The nearest point of the domain enlarged in the same way.
    #[inline(always)]
    fn clamped(&self, x: f64, y: f64, enlarged: f64, slack: Slack) -> (f64, f64) {
        let limit = |x: f64, middle: f64, half: f64, slack: f64| {
            let half = enlarged * half + slack;
            x.clamp(middle - half, middle + half)
        };
        (limit(x, self.x, self.half_x, slack.x), limit(y, self.y, self.half_y, slack.y))
    }

    /// Where the part, enlarged by a factor, begins and ends in u.
    #[inline(always)]
    pub(super) fn ends_u(&self, enlarged: f64) -> (f64, f64) {
        (0.5 * (self.x - enlarged * self.half_x) + 0.5, 0.5 * (self.x + enlarged * self.half_x) + 0.5)
    }

    /// Where it begins and ends in v.
    #[inline(always)]
    pub(super) fn ends_v(&self, enlarged: f64) -> (f64, f64) {
        (0.5 * (self.y - enlarged * self.half_y) + 0.5, 0.5 * (self.y + enlarged * self.half_y) + 0.5)
    }

    #[inline(always)]
    pub(super) fn halves_x(&self) -> [Self; 2] {
        let half_x = 0.5 * self.half_x;
        [Self { x: self.x - half_x, half_x, ..*self }, Self { x: self.x + half_x, half_x, ..*self }]
    }

    #[inline(always)]
    pub(super) fn halves_y(&self) -> [Self; 2] {
        let half_y = 0.5 * self.half_y;
        [Self { y: self.y - half_y, half_y, ..*self }, Self { y: self.y + half_y, half_y, ..*self }]
    }
}

/// What is known of the roots in and around a part.
pub(super) struct Knowledge {
    /// The part enlarged by this factor has no more than one root with `slope`.
    pub(super) enlarged: f64,
    /// The sign of `direction . (dS/dx x dS/dy)` at the root to look for; zero if there is no more than one of either.
    pub(super) slope: f64,
    /// A root in the part is no farther from where a Newton step leads than this times the length of the step; infinite
    /// if that is unknown.
    pub(super) reach: f64,
}

impl Knowledge {
    /// From a bound c of the norm of `A J - 1` over a part, with J the Jacobian of the equations and A some matrix, in
    /// coordinates in which the part is the square `[-1, 1]^2`. None unless it makes a root unique.
    ///
    /// A Newton step from x leads to within `k |x - root|` of the root, with `k = 2 c / (1 - c)`, since the inverse of
    /// `A J` is at most `1 / (1 - c)` and two values of `A J` differ by at most 2 c. So with the length s of the step, the
    /// root is at most `k / (1 - k) s = 2 c / (1 - 3 c) s` away from where the step leads, as long as `3 c < 1`.
    pub(super) fn from_nonlinearity(c: f64) -> Option<Self> {
        let reach = if c < 0.33 { 2.0 * c / (1.0 - 3.0 * c) } else { f64::INFINITY };
        (c < 1.0).then_some(Self { enlarged: 1.0, slope: 0.0, reach })
    }
}

/// Looks for the root in a part, starting from (x, y).
#[inline(always)]
pub(super) fn solve(
    l: impl Lanes,
    patch: &PowerForm,
    ray: &UnitRay,
    part: &Domain,
    known: &Knowledge,
    start: (f64, f64),
) -> Outcome {
    let (mut x, mut y) = start;
    let mut clamped = 0;
    for _ in 0..MAX_STEPS {
        let p = patch.tangents(l, x, y);
        let step = step(l, &p, ray);
        let (next_x, next_y) = (x + step.dx, y + step.dy);
        let length = (step.dx.abs() / part.half_x).max(step.dy.abs() / part.half_y);
        let outside = part.outside(next_x, next_y, 1.0, patch.slack);
        if outside > known.reach * length {
            return Outcome::None;
        }
        let beyond =
            if known.enlarged == 1.0 { outside } else { part.outside(next_x, next_y, known.enlarged, patch.slack) };
        if length < LAST_STEP && beyond <= 0.0 {
            if step.slope * known.slope < 0.0 {
                return Outcome::Unknown;
            }
            if outside > 0.0 {
                return Outcome::None;
            }
            let position = p.position + step.dx * p.dx + step.dy * p.dy;
            return Outcome::Root(Root { x: next_x, y: next_y, z: ray.direction.dot(position - ray.origin) });
        }
        clamped += usize::from(beyond > 0.0);
        if clamped > MAX_CLAMPED || beyond.is_nan() {
            break;
        }
        (x, y) = part.clamped(next_x, next_y, known.enlarged, patch.slack);
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

/// The Newton step: to where the ray meets the tangent plane, by Cramer's rule. Not finite where it does not.
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
