//! A control net seen along a ray: the intersection becomes a pair of equations `x(u, v) = y(u, v) = 0`.

use super::ControlNet;
use crate::math::{Frame, Ray};
use glam::{DVec2, DVec3};
use std::array::from_fn;

type Rows = [[f64; 4]; 4];

/// Coordinates along and across a ray: z along its direction, in scene units, x = y = 0 on the ray.
///
/// The origin is the ray's point nearest to the middle of the patch, so that a ray that starts far away costs no
/// digits near the patch.
pub(super) struct RaySpace {
    frame: Frame,
    origin: DVec3,
    /// Scene units per unit of t.
    pub(super) speed: f64,
    /// The ray's t at z = 0.
    t_at_origin: f64,
}

impl RaySpace {
    /// The space of a ray given relative to the middle of the patch; none for a direction that has no length.
    pub(super) fn new(ray: &Ray) -> Option<Self> {
        let speed = ray.direction.length();
        let direction = ray.direction.try_normalize()?;
        let distance = -ray.origin.dot(direction);
        let origin = ray.origin + distance * direction;
        Some(Self { frame: Frame::from_normal(direction), origin, speed, t_at_origin: distance / speed })
    }

    /// The t of the ray's point nearest to the surface point at height z.
    pub(super) fn t_from_z(&self, z: f64) -> f64 {
        self.t_at_origin + z / self.speed
    }

    /// The height z of the ray's point at t.
    pub(super) fn z_from_t(&self, t: f64) -> f64 {
        (t - self.t_at_origin) * self.speed
    }

    fn local(&self, p: DVec3) -> DVec3 {
        self.frame.local_from_world(p - self.origin)
    }
}

/// The coordinates of 16 control points in a [`RaySpace`], `rows[i][j]` with i along u.
#[derive(Clone, Copy)]
pub(super) struct RayNet {
    x: Rows,
    y: Rows,
    z: Rows,
}

/// A point of a [`RayNet`] with its partial derivatives.
pub(super) struct RayPoint {
    pub(super) xy: DVec2,
    pub(super) z: f64,
    pub(super) du: DVec2,
    pub(super) dv: DVec2,
}

impl RayNet {
    pub(super) fn new(net: &ControlNet, space: &RaySpace) -> Self {
        let local = net.points.map(|row| row.map(|p| space.local(p)));
        let axis = |k: usize| from_fn(|i| from_fn(|j| local[i][j][k]));
        Self { x: axis(0), y: axis(1), z: axis(2) }
    }

    /// The smallest and the largest coordinate of the control points on each axis.
    pub(super) fn bounds(&self) -> [(f64, f64); 3] {
        [&self.x, &self.y, &self.z].map(range)
    }

    /// Evaluates at (u, v) with first derivatives.
    pub(super) fn eval(&self, u: f64, v: f64) -> RayPoint {
        let (bu, du) = (weights(u), derivative_weights(u));
        let (bv, dv) = (weights(v), derivative_weights(v));
        let sum = |rows: &Rows, a: &[f64; 4], b: &[f64; 4]| {
            let column: [f64; 4] =
                from_fn(|j| (a[0] * rows[0][j] + a[1] * rows[1][j]) + (a[2] * rows[2][j] + a[3] * rows[3][j]));
            (column[0] * b[0] + column[1] * b[1]) + (column[2] * b[2] + column[3] * b[3])
        };
        let xy = |a: &[f64; 4], b: &[f64; 4]| DVec2::new(sum(&self.x, a, b), sum(&self.y, a, b));
        RayPoint { xy: xy(&bu, &bv), z: sum(&self.z, &bu, &bv), du: xy(&du, &bv), dv: xy(&bu, &dv) }
    }

    /// The halves `u <= 1/2` and `u >= 1/2`.
    pub(super) fn split_u(&self) -> [Self; 2] {
        let [x, y, z] = [&self.x, &self.y, &self.z].map(halves);
        [Self { x: x[0], y: y[0], z: z[0] }, Self { x: x[1], y: y[1], z: z[1] }]
    }

    /// The halves `v <= 1/2` and `v >= 1/2`.
    pub(super) fn split_v(&self) -> [Self; 2] {
        self.transposed().split_u().map(|half| half.transposed())
    }

    fn transposed(&self) -> Self {
        let [x, y, z] = [&self.x, &self.y, &self.z].map(transpose);
        Self { x, y, z }
    }

    /// The part turned about the ray until x runs along the longer of its mean partial derivatives: a long and narrow
    /// part becomes thin in y.
    pub(super) fn turned(&self) -> Self {
        let [along_u, along_v] = self.mean_derivatives();
        let along = if along_u.length_squared() > along_v.length_squared() { along_u } else { along_v };
        let Some(e) = along.try_normalize() else {
            return *self;
        };
        Self { x: combine(e.x, &self.x, e.y, &self.y), y: combine(-e.y, &self.x, e.x, &self.y), z: self.z }
    }

    /// The means of the partial derivatives of (x, y) over the part.
    fn mean_derivatives(&self) -> [DVec2; 2] {
        let corner = |i: usize, j: usize| DVec2::new(self.x[i][j], self.y[i][j]);
        let diagonals = (corner(3, 3) - corner(0, 0), corner(3, 0) - corner(0, 3));
        [0.5 * (diagonals.0 + diagonals.1), 0.5 * (diagonals.0 - diagonals.1)]
    }

    /// The coordinates (x, y) in which the part is affine on average: the inverse of the mean Jacobian applied to x and
    /// y. None where that has no inverse.
    fn preconditioned(&self) -> Option<[Rows; 2]> {
        let [du, dv] = self.mean_derivatives();
        let determinant = du.perp_dot(dv);
        if determinant.abs() <= 1e-12 * du.length() * dv.length() {
            return None;
        }
        let (du, dv) = (du / determinant, dv / determinant);
        Some([combine(dv.y, &self.x, -dv.x, &self.y), combine(-du.y, &self.x, du.x, &self.y)])
    }

    /// Whether the ray meets the part at no more than one point, or at none.
    ///
    /// With A the inverse of the mean Jacobian, an upper bound of the norm of `A J(u, v) - 1` over the part follows from
    /// the control points of the derivatives. Below 1 the map (u, v) -> (x, y) is one to one; below 1/2, and with the
    /// steps clamped to the part, Newton's method finds the root from anywhere.
    pub(super) fn roots(&self) -> Roots {
        let Some([x, y]) = self.preconditioned() else {
            return Roots::Unknown;
        };
        if [&x, &y].into_iter().map(range).any(|(low, high)| low > 1e-9 || high < -1e-9) {
            return Roots::None;
        }
        let deviation = |rows: &Rows, expected: f64| largest::<3, 4>(&differences(rows), 3.0, expected);
        let (xt, yt) = (transpose(&x), transpose(&y));
        let norm_x = deviation(&x, 1.0) + deviation(&xt, 0.0);
        let norm_y = deviation(&y, 0.0) + deviation(&yt, 1.0);
        if norm_x.max(norm_y) < 0.5 { Roots::AtMostOne } else { Roots::Unknown }
    }

    /// Whether to split across u rather than v: across the axis along which the part bends most; of a part that hardly
    /// bends, the longer one.
    pub(super) fn splits_across_u(&self) -> bool {
        let (mut long, mut bend) = ([0f64; 2], [0f64; 2]);
        let mut twist = 0f64;
        for rows in [&self.x, &self.y] {
            for (axis, rows) in [*rows, transpose(rows)].iter().enumerate() {
                let steps: [_; 3] = differences(rows);
                long[axis] = long[axis].max(largest(&steps, 1.0, 0.0));
                bend[axis] = bend[axis].max(largest::<2, 4>(&differences(&steps), 1.0, 0.0));
                twist = twist.max(largest::<3, 3>(&differences(&transpose(&steps)), 1.0, 0.0));
            }
        }
        // A twist hurts where it turns the shorter derivative: splitting across the other axis tames it.
        let tamed_by = usize::from(long[0] < long[1]);
        bend[tamed_by] = bend[tamed_by].max(twist);
        if bend[0].max(bend[1]) > 1e-3 * long[0].max(long[1]) {
            return bend[0] >= bend[1];
        }
        let [along_u, along_v] = [self.z, transpose(&self.z)].map(|z| largest::<3, 4>(&differences(&z), 1.0, 0.0));
        along_u.max(long[0]) >= along_v.max(long[1])
    }
}

/// What is known of the number of times that a ray meets a part.
pub(super) enum Roots {
    None,
    AtMostOne,
    Unknown,
}

/// `a x + b y`, for each entry.
fn combine(a: f64, x: &Rows, b: f64, y: &Rows) -> Rows {
    from_fn(|i| from_fn(|j| a * x[i][j] + b * y[i][j]))
}

/// The `S = R - 1` differences of neighbours along the first index.
fn differences<const R: usize, const C: usize, const S: usize>(rows: &[[f64; C]; R]) -> [[f64; C]; S] {
    from_fn(|i| from_fn(|j| rows[i + 1][j] - rows[i][j]))
}

fn transpose<const R: usize, const C: usize>(rows: &[[f64; C]; R]) -> [[f64; R]; C] {
    from_fn(|j| from_fn(|i| rows[i][j]))
}

/// The largest absolute value of `scale * entry - offset`.
fn largest<const R: usize, const C: usize>(rows: &[[f64; C]; R], scale: f64, offset: f64) -> f64 {
    rows.iter().flatten().map(|x| (scale * x - offset).abs()).fold(0.0, |m, x| if x > m { x } else { m })
}

fn range(rows: &Rows) -> (f64, f64) {
    rows.iter().flatten().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| {
        (if x < low { x } else { low }, if x > high { x } else { high })
    })
}

/// The cubic Bernstein polynomials.
fn weights(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

/// The derivatives of the cubic Bernstein polynomials.
fn derivative_weights(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t]
}

/// De Casteljau's scheme at 1/2 along the first index.
fn halves(rows: &Rows) -> [Rows; 2] {
    let middle = |a: &[f64; 4], b: &[f64; 4]| -> [f64; 4] { from_fn(|k| 0.5 * (a[k] + b[k])) };
    let (a, b, c) = (middle(&rows[0], &rows[1]), middle(&rows[1], &rows[2]), middle(&rows[2], &rows[3]));
    let (d, e) = (middle(&a, &b), middle(&b, &c));
    let m = middle(&d, &e);
    [[rows[0], a, d, m], [m, e, c, rows[3]]]
}
