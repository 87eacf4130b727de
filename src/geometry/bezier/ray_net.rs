//! A control net seen along a ray: the intersection becomes a pair of equations `x(u, v) = y(u, v) = 0`.

use super::ControlNet;
use super::newton::Domain;
use super::row::{Row, Rows, transpose};
use super::unit::UnitRay;
use crate::math::Frame;
use glam::DVec2;

/// The control points of a part of a patch along and across a ray, `rows[i][j]` with i along u: z along its direction,
/// x = y = 0 on the ray.
#[derive(Clone, Copy)]
pub(super) struct RayNet {
    x: Rows,
    y: Rows,
    z: Rows,
}

/// What the affine part of a [`RayNet`] tells.
pub(super) struct Affine {
    /// Whether the control points prove that the ray passes by.
    pub(super) is_missed: bool,
    /// Bound of the norm of `A J - 1` over the part, see [`super::newton::solve`].
    pub(super) nonlinearity: f64,
    /// The root of the affine part, in parameters from -1 to 1.
    pub(super) start: [f64; 2],
}

impl RayNet {
    /// The net of a patch, given in unit space, along a ray.
    #[inline(always)]
    pub(super) fn new(net: &ControlNet, ray: &UnitRay) -> Self {
        let frame = Frame::from_normal(ray.direction);
        let mut rows = Self { x: [Row::ZERO; 4], y: [Row::ZERO; 4], z: [Row::ZERO; 4] };
        for i in 0..4 {
            for j in 0..4 {
                let p = net.points[i][j] - ray.origin;
                rows.x[i].0[j] = p.dot(frame.tangent);
                rows.y[i].0[j] = p.dot(frame.bitangent);
                rows.z[i].0[j] = p.dot(frame.normal);
            }
        }
        rows
    }

    /// The net of a part.
    #[inline(always)]
    pub(super) fn restricted(&self, part: &Domain) -> Self {
        let ends = |middle: f64, half: f64| [0.5 * (middle - half) + 0.5, 0.5 * (middle + half) + 0.5];
        let ([u0, u1], [v0, v1]) = (ends(part.x, part.half_x), ends(part.y, part.half_y));
        let part = |rows: &Rows| transpose(&restrict(&transpose(&restrict(rows, u0, u1)), v0, v1));
        Self { x: part(&self.x), y: part(&self.y), z: part(&self.z) }
    }

    /// Whether all control points lie on one side of the ray by more than `slack`, or before or behind the given range.
    #[inline(always)]
    pub(super) fn misses(&self, z_min: f64, z_max: f64, slack: f64) -> bool {
        let [x, y, z] = self.ranges();
        excludes_zero(x, slack) || excludes_zero(y, slack) || z.1 < z_min - slack || z.0 > z_max + slack
    }

    /// The smallest and the largest coordinate on each axis.
    #[inline(always)]
    pub(super) fn ranges(&self) -> [(f64, f64); 3] {
        [range(&self.x), range(&self.y), range(&self.z)]
    }

    /// The mean of the corners along the ray.
    #[inline(always)]
    pub(super) fn middle_z(&self) -> f64 {
        middle(&self.z)
    }

    /// The halves `u <= 1/2` and `u >= 1/2`.
    #[inline(always)]
    pub(super) fn split_u(&self) -> [Self; 2] {
        let ([x0, x1], [y0, y1], [z0, z1]) = (halves(&self.x), halves(&self.y), halves(&self.z));
        [Self { x: x0, y: y0, z: z0 }, Self { x: x1, y: y1, z: z1 }]
    }

    /// The halves `v <= 1/2` and `v >= 1/2`.
    #[inline(always)]
    pub(super) fn split_v(&self) -> [Self; 2] {
        let [a, b] = self.transposed().split_u();
        [a.transposed(), b.transposed()]
    }

    /// The same surface with the roles of u and v exchanged.
    #[inline(always)]
    fn transposed(&self) -> Self {
        Self { x: transpose(&self.x), y: transpose(&self.y), z: transpose(&self.z) }
    }

    /// The part turned about the ray until x runs along the longer of its mean partial derivatives: a long and narrow
    /// part becomes thin in y.
    #[inline(always)]
    pub(super) fn turned(&self) -> Self {
        let [along_u, along_v] = self.mean_derivatives();
        let along = if along_u.length_squared() > along_v.length_squared() { along_u } else { along_v };
        let Some(e) = along.try_normalize() else {
            return *self;
        };
        Self { x: combine(e.x, &self.x, e.y, &self.y), y: combine(-e.y, &self.x, e.x, &self.y), z: self.z }
    }

    /// The means of the partial derivatives of (x, y), with parameters from -1 to 1.
    #[inline(always)]
    fn mean_derivatives(&self) -> [DVec2; 2] {
        let corner = |i: usize, j: usize| DVec2::new(self.x[i].0[j], self.y[i].0[j]);
        let diagonals = (corner(3, 3) - corner(0, 0), corner(3, 0) - corner(0, 3));
        [0.25 * (diagonals.0 + diagonals.1), 0.25 * (diagonals.0 - diagonals.1)]
    }

    /// What the control points tell in coordinates in which the part is affine on average, with the inverse of the mean
    /// Jacobian for A. None where it has no inverse.
    #[inline(always)]
    pub(super) fn affine(&self) -> Option<Affine> {
        let [du, dv] = self.mean_derivatives();
        let determinant = du.perp_dot(dv);
        if determinant.abs() <= 1e-12 * du.length() * dv.length() {
            return None;
        }
        let (du, dv) = (du / determinant, dv / determinant);
        let x = combine(dv.y, &self.x, -dv.x, &self.y);
        let y = combine(-du.y, &self.x, du.x, &self.y);
        let (xt, yt) = (transpose(&x), transpose(&y));
        // 1.5 times the step between control points: three steps for parameters from -1 to 1.
        let norm_x = largest(&steps(&x), 1.5, 1.0) + largest(&steps(&xt), 1.5, 0.0);
        let norm_y = largest(&steps(&y), 1.5, 0.0) + largest(&steps(&yt), 1.5, 1.0);
        Some(Affine {
            is_missed: excludes_zero(range(&x), 1e-9) || excludes_zero(range(&y), 1e-9),
            nonlinearity: norm_x.max(norm_y),
            start: [-middle(&x), -middle(&y)],
        })
    }

    /// Whether to split across u rather than v: across the axis along which the part bends most; of a part that hardly
    /// bends, the longer one.
    #[inline(always)]
    pub(super) fn splits_across_u(&self) -> bool {
        let (mut long, mut bend, mut twist) = ([0f64; 2], [0f64; 2], 0f64);
        for rows in [&self.x, &self.y] {
            for (axis, rows) in [*rows, transpose(rows)].iter().enumerate() {
                let [a, b, c] = steps(rows);
                long[axis] = long[axis].max(largest(&[a, b, c], 1.0, 0.0));
                bend[axis] = bend[axis].max(largest(&[b - a, c - b], 1.0, 0.0));
                if axis == 0 {
                    // Across the other axis: a step from each entry to the next.
                    let next = |Row([_, b, c, d]): Row| Row([b, c, d, d]);
                    twist = twist.max(largest(&[next(a) - a, next(b) - b, next(c) - c], 1.0, 0.0));
                }
            }
        }
        // A twist hurts where it turns the shorter derivative: splitting across the other axis tames it.
        let tamed_by = usize::from(long[0] < long[1]);
        bend[tamed_by] = bend[tamed_by].max(twist);
        if bend[0].max(bend[1]) > 1e-3 * long[0].max(long[1]) {
            return bend[0] >= bend[1];
        }
        let [deep_u, deep_v] = [self.z, transpose(&self.z)].map(|z| largest(&steps(&z), 1.0, 0.0));
        deep_u.max(long[0]) >= deep_v.max(long[1])
    }
}

#[inline(always)]
fn excludes_zero((low, high): (f64, f64), slack: f64) -> bool {
    low > slack || high < -slack
}

/// The mean of the four corners.
#[inline(always)]
fn middle(rows: &Rows) -> f64 {
    0.25 * ((rows[0].0[0] + rows[3].0[3]) + (rows[0].0[3] + rows[3].0[0]))
}

/// `a x + b y`, for each entry.
#[inline(always)]
fn combine(a: f64, x: &Rows, b: f64, y: &Rows) -> Rows {
    let row = |k: usize| x[k] * a + y[k] * b;
    [row(0), row(1), row(2), row(3)]
}

/// The differences of neighbouring rows.
#[inline(always)]
fn steps(rows: &Rows) -> [Row; 3] {
    [rows[1] - rows[0], rows[2] - rows[1], rows[3] - rows[2]]
}

/// The largest absolute value of `scale * entry - offset`.
#[inline(always)]
fn largest<const N: usize>(rows: &[Row; N], scale: f64, offset: f64) -> f64 {
    rows.iter().fold(Row::ZERO, |largest, row| (*row * scale - Row::splat(offset)).abs().max(largest)).greatest()
}

/// The smallest and the largest entry.
#[inline(always)]
fn range([a, b, c, d]: &Rows) -> (f64, f64) {
    (a.min(*b).min(c.min(*d)).least(), a.max(*b).max(c.max(*d)).greatest())
}

/// De Casteljau's scheme at 1/2 along the first index.
#[inline(always)]
fn halves(rows: &Rows) -> [Rows; 2] {
    let middle = |a: Row, b: Row| (a + b) * 0.5;
    let (a, b, c) = (middle(rows[0], rows[1]), middle(rows[1], rows[2]), middle(rows[2], rows[3]));
    let (d, e) = (middle(a, b), middle(b, c));
    let m = middle(d, e);
    [[rows[0], a, d, m], [m, e, c, rows[3]]]
}

/// The part from `low` to `high` along the first index: each control point of the part is the blossom of the curve at
/// three values, each of them `low` or `high`.
#[inline(always)]
fn restrict(rows: &Rows, low: f64, high: f64) -> Rows {
    let mix = |a: Row, b: Row, t: f64| a * (1.0 - t) + b * t;
    let steps = |t: f64| [mix(rows[0], rows[1], t), mix(rows[1], rows[2], t), mix(rows[2], rows[3], t)];
    let ([a, b, c], [d, e, f]) = (steps(low), steps(high));
    let (ab, bc, de, ef) = (mix(a, b, low), mix(b, c, low), mix(d, e, high), mix(e, f, high));
    [mix(ab, bc, low), mix(ab, bc, high), mix(de, ef, low), mix(de, ef, high)]
}
