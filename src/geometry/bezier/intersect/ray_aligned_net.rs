//! A control net in coordinates along a ray: intersection becomes the pair of equations `x(u, v) = y(u, v) = 0`, as in Bezier
//! clipping \[NSK90\].

use crate::geometry::bezier::unit::{Domain, Interval, Ordinates, Row, SoaNet, UnitRay};
use crate::math::OrthonormalBasis;
use glam::{DVec2, DVec3};

/// Bound of the rounding of coordinates in unit space, in double precision.
pub(crate) const ROUNDING: f64 = 1e-14;

/// Roots this far outside of a subpatch still are hits, in units of its parameters.
const SLACK: f64 = 1e-9;
/// Roots this far outside in unit space still are hits: more than the rounding of rays that start thousands of patch sizes
/// away.
const SLACK_IN_SPACE: f64 = 1e-11;

/// The control net of a subpatch in coordinates of a ray: z along its direction, x = y = 0 on the ray.
#[derive(Clone, Copy)]
pub(crate) struct RayAlignedNet(SoaNet);

/// The affine part of a [`RayAlignedNet`], and the conclusions from it.
pub(crate) struct Affine {
    /// Whether the control points prove that the ray misses the subpatch.
    pub(crate) is_missed: bool,
    /// Bound of the norm of `A J - 1` over the subpatch, for [`super::newton::Uniqueness::from_nonlinearity`].
    pub(crate) nonlinearity: f64,
    /// The root of the affine part, in parameters from -1 to 1.
    pub(crate) start: [f64; 2],
}

impl RayAlignedNet {
    /// The net of a patch in the coordinates of a ray; both in unit space.
    #[inline(always)]
    pub(crate) fn new(net: &SoaNet, ray: &UnitRay) -> Self {
        let basis = OrthonormalBasis::from_normal(ray.direction);
        Self(net.in_coordinates([basis.tangent, basis.bitangent, basis.normal], ray.origin))
    }

    /// The net of a subpatch.
    #[inline(always)]
    pub(crate) fn restricted(&self, domain: &Domain) -> Self {
        Self(self.0.restricted(domain.interval_u(), domain.interval_v()))
    }

    /// Whether all control points lie on one side of the ray, or outside of `z_min` to `z_max`, by more than `slack`.
    #[inline(always)]
    pub(crate) fn misses(&self, z_min: f64, z_max: f64, slack: f64) -> bool {
        let z = self.0.z.range();
        self.0.x.range().excludes_zero(slack)
            || self.0.y.range().excludes_zero(slack)
            || z.low > z_max + slack
            || z.high < z_min - slack
    }

    /// Whether the box of the control points is at most this large along each axis.
    #[inline(always)]
    pub(crate) fn fits_in(&self, size: f64) -> bool {
        self.0.bounds().size().max_element() <= size
    }

    /// The mean z of the corners.
    #[inline(always)]
    pub(crate) fn mean_z(&self) -> f64 {
        self.0.z.corner_mean()
    }

    /// The subpatches over `u <= 1/2` and over `u >= 1/2`.
    #[inline(always)]
    pub(crate) fn split_u(&self) -> [Self; 2] {
        let [a, b] = self.0.split_u();
        [Self(a), Self(b)]
    }

    /// The subpatches over `v <= 1/2` and over `v >= 1/2`.
    #[inline(always)]
    pub(crate) fn split_v(&self) -> [Self; 2] {
        let [a, b] = self.0.split_v();
        [Self(a), Self(b)]
    }

    /// The net rotated about the ray until x runs along the longer of its mean partial derivatives: a long and narrow
    /// subpatch becomes thin in y, as in \[EHS05\].
    #[inline(always)]
    pub(crate) fn rotated(&self) -> Self {
        let [along_u, along_v] = self.0.mean_derivatives().map(DVec3::truncate);
        let along = if along_u.length_squared() > along_v.length_squared() { along_u } else { along_v };
        let Some(e) = along.try_normalize() else {
            return *self;
        };
        let SoaNet { x, y, z } = &self.0;
        Self(SoaNet { x: combine(e.x, x, e.y, y), y: combine(-e.y, x, e.x, y), z: *z })
    }

    /// The affine part, in coordinates in which the net is on average its own parameters: the inverse of the mean Jacobian
    /// is the matrix A. `None` where that Jacobian has no inverse.
    #[inline(always)]
    pub(crate) fn affine(&self) -> Option<Affine> {
        let [du, dv] = self.0.mean_derivatives();
        let (du, dv) = (du.truncate(), dv.truncate());
        let determinant = du.perp_dot(dv);
        if determinant.abs() <= 1e-12 * du.length() * dv.length() {
            return None;
        }
        let (du, dv) = (du / determinant, dv / determinant);
        let x = combine(dv.y, &self.0.x, -dv.x, &self.0.y);
        let y = combine(-du.y, &self.0.x, du.x, &self.0.y);
        // Where a derivative vanishes, subpatches become so small or so thin that rounding is not small against them.
        let slack = |row: DVec2| SLACK + SLACK_IN_SPACE * (row.x.abs() + row.y.abs());
        // 3/2 times the differences of ordinates, for parameters from -1 to 1.
        let derivative = |ordinates: &Ordinates| Interval::of(&ordinates.differences()).scaled(1.5);
        let (xt, yt) = (x.transposed(), y.transposed());
        let norm_x = derivative(&x).minus(1.0).magnitude() + derivative(&xt).magnitude();
        let norm_y = derivative(&y).magnitude() + derivative(&yt).minus(1.0).magnitude();
        Some(Affine {
            is_missed: x.range().excludes_zero(slack(dv)) || y.range().excludes_zero(slack(du)),
            nonlinearity: norm_x.max(norm_y),
            start: [-x.corner_mean(), -y.corner_mean()],
        })
    }

    /// Whether to split in u rather than in v: along the axis of the stronger bending, or along the longer axis of a
    /// subpatch that hardly bends.
    #[inline(always)]
    pub(crate) fn splits_in_u(&self) -> bool {
        let SoaNet { x, y, z } = &self.0;
        let (xt, yt, zt) = (x.transposed(), y.transposed(), z.transposed());
        let long = [magnitude(&x.differences(), &y.differences()), magnitude(&xt.differences(), &yt.differences())];
        let mut bend = [
            magnitude(&x.second_differences(), &y.second_differences()),
            magnitude(&xt.second_differences(), &yt.second_differences()),
        ];
        // A twist turns the shorter derivative: a split along the axis across it reduces the twist.
        let reduced_by = usize::from(long[0] < long[1]);
        bend[reduced_by] = bend[reduced_by].max(magnitude(&x.mixed_differences(), &y.mixed_differences()));
        if bend[0].max(bend[1]) > 1e-3 * long[0].max(long[1]) {
            return bend[0] >= bend[1];
        }
        let deep = |z: &Ordinates| Interval::of(&z.differences()).magnitude();
        deep(z).max(long[0]) >= deep(&zt).max(long[1])
    }
}

/// The greatest absolute value in both.
#[inline(always)]
fn magnitude<const N: usize>(x: &[Row; N], y: &[Row; N]) -> f64 {
    Interval::of(x).magnitude().max(Interval::of(y).magnitude())
}

/// `a x + b y`, for each number.
#[inline(always)]
fn combine(a: f64, Ordinates(x): &Ordinates, b: f64, Ordinates(y): &Ordinates) -> Ordinates {
    Ordinates([x[0] * a + y[0] * b, x[1] * a + y[1] * b, x[2] * a + y[2] * b, x[3] * a + y[3] * b])
}
