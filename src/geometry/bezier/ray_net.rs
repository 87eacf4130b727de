//! A control net seen along a ray: the intersection becomes a pair of equations `x(u, v) = y(u, v) = 0`.

use super::newton::Domain;
use super::row::{Range, Row, Rows};
use super::row_net::RowNet;
use super::unit::UnitRay;
use crate::math::OrthonormalBasis;
use glam::{DVec2, DVec3};

/// Rounding of coordinates in unit space is below this.
pub(super) const ROUNDING: f64 = 1e-14;

/// Roots this far outside of a part still count, in units of the part.
const SLACK: f64 = 1e-9;
/// Roots this far outside still count in unit space: more than the rounding of rays that start thousands of patches away.
const SLACK_IN_SPACE: f64 = 1e-11;

/// The control points of a part of a patch along and across a ray: z along its direction, x = y = 0 on the ray.
#[derive(Clone, Copy)]
pub(super) struct RayNet(RowNet);

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
    pub(super) fn new(net: &RowNet, ray: &UnitRay) -> Self {
        let basis = OrthonormalBasis::from_normal(ray.direction);
        Self(net.in_coordinates([basis.tangent, basis.bitangent, basis.normal], ray.origin))
    }

    /// The net of a part.
    #[inline(always)]
    pub(super) fn restricted(&self, part: &Domain) -> Self {
        Self(self.0.restricted(part.ends_u(1.0), part.ends_v(1.0)))
    }

    /// Whether all control points lie on one side of the ray by more than `slack`, or before or behind the given range.
    #[inline(always)]
    pub(super) fn misses(&self, z_min: f64, z_max: f64, slack: f64) -> bool {
        let z = self.0.z.range();
        self.0.x.range().excludes_zero(slack)
            || self.0.y.range().excludes_zero(slack)
            || z.low > z_max + slack
            || z.high < z_min - slack
    }

    /// Whether all control points are within this distance of each other, along each axis.
    #[inline(always)]
    pub(super) fn is_within(&self, size: f64) -> bool {
        self.0.bounds().size().max_element() <= size
    }

    /// The mean of the corners along the ray.
    #[inline(always)]
    pub(super) fn middle_z(&self) -> f64 {
        self.0.z.middle()
    }

    /// The halves `u <= 1/2` and `u >= 1/2`.
    #[inline(always)]
    pub(super) fn split_u(&self) -> [Self; 2] {
        let [a, b] = self.0.split_u();
        [Self(a), Self(b)]
    }

    /// The halves `v <= 1/2` and `v >= 1/2`.
    #[inline(always)]
    pub(super) fn split_v(&self) -> [Self; 2] {
        let [a, b] = self.0.split_v();
        [Self(a), Self(b)]
    }

    /// The part turned about the ray until x runs along the longer of its mean partial derivatives: a long and narrow
    /// part becomes thin in y.
    #[inline(always)]
    pub(super) fn turned(&self) -> Self {
        let [along_u, along_v] = self.0.mean_derivatives().map(DVec3::truncate);
        let along = if along_u.length_squared() > along_v.length_squared() { along_u } else { along_v };
        let Some(e) = along.try_normalize() else {
            return *self;
        };
        let RowNet { x, y, z } = &self.0;
        Self(RowNet { x: combine(e.x, x, e.y, y), y: combine(-e.y, x, e.x, y), z: *z })
    }

    /// What the control points tell in coordinates in which the part is affine on average, with the inverse of the mean
    /// Jacobian for A. None where it has no inverse.
    #[inline(always)]
    pub(super) fn affine(&self) -> Option<Affine> {
        let [du, dv] = self.0.mean_derivatives();
        let (du, dv) = (du.truncate(), dv.truncate());
        let determinant = du.perp_dot(dv);
        if determinant.abs() <= 1e-12 * du.length() * dv.length() {
            return None;
        }
        let (du, dv) = (du / determinant, dv / determinant);
        let x = combine(dv.y, &self.0.x, -dv.x, &self.0.y);
        let y = combine(-du.y, &self.0.x, du.x, &self.0.y);
        // Where a derivative vanishes, parts get so small or so thin that rounding is not small against them.
        let slack = |row: DVec2| SLACK + SLACK_IN_SPACE * (row.x.abs() + row.y.abs());
        // 1.5 times the step between control points: three steps for parameters from -1 to 1.
        let derivative = |rows: &Rows| Range::of(&rows.steps()).scaled(1.5);
        let (xt, yt) = (x.transposed(), y.transposed());
        let norm_x = derivative(&x).less(1.0).greatest() + derivative(&xt).greatest();
        let norm_y = derivative(&y).greatest() + derivative(&yt).less(1.0).greatest();
        Some(Affine {
            is_missed: x.range().excludes_zero(slack(dv)) || y.range().excludes_zero(slack(du)),
            nonlinearity: norm_x.max(norm_y),
            start: [-x.middle(), -y.middle()],
        })
    }

    /// Whether to split across u rather than v: across the axis along which the part bends most; of a part that hardly
    /// bends, the longer one.
    #[inline(always)]
    pub(super) fn splits_across_u(&self) -> bool {
        let RowNet { x, y, z } = &self.0;
        let (xt, yt, zt) = (x.transposed(), y.transposed(), z.transposed());
        let long = [greatest(&x.steps(), &y.steps()), greatest(&xt.steps(), &yt.steps())];
        let mut bend = [greatest(&x.bends(), &y.bends()), greatest(&xt.bends(), &yt.bends())];
        // A twist hurts where it turns the shorter derivative: splitting across the other axis tames it.
        let tamed_by = usize::from(long[0] < long[1]);
        bend[tamed_by] = bend[tamed_by].max(greatest(&x.twists(), &y.twists()));
        if bend[0].max(bend[1]) > 1e-3 * long[0].max(long[1]) {
            return bend[0] >= bend[1];
        }
        let deep = |z: &Rows| Range::of(&z.steps()).greatest();
        deep(z).max(long[0]) >= deep(&zt).max(long[1])
    }
}

/// The greatest absolute value in both.
#[inline(always)]
fn greatest<const N: usize>(x: &[Row; N], y: &[Row; N]) -> f64 {
    Range::of(x).greatest().max(Range::of(y).greatest())
}

/// `a x + b y`, for each number.
#[inline(always)]
fn combine(a: f64, Rows(x): &Rows, b: f64, Rows(y): &Rows) -> Rows {
    Rows([x[0] * a + y[0] * b, x[1] * a + y[1] * b, x[2] * a + y[2] * b, x[3] * a + y[3] * b])
}
