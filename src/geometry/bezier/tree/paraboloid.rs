//! A subpatch as a paraboloid, with bounds of its distance from the surface in height and in slope. Replacing a small
//! subpatch by a simpler surface with a bound of the error is common \[Toth85\]; the paraboloid, which leaves a
//! quadratic equation and proves the number of roots, is ours.

use crate::geometry::bezier::unit::{Domain, Interval, Ordinates, ROUNDING, Row, SoaNet};
use crate::math::lanes::simd_dispatch;
use glam::DVec3;
use std::array::from_fn;

/// The paraboloid of a subpatch describes a domain larger than the subpatch's own by this factor: its bounds hold in the
/// neighbourhood too, and a root just outside proves that no root is inside.
pub(crate) const MARGIN: f64 = 1.25;

/// A subpatch in unit space, in coordinates (alpha, beta, gamma) in which it is nearly the graph
/// `gamma = offset + h_aa alpha^2 / 2 + h_ab alpha beta + h_bb beta^2 / 2` over a square.
///
/// The parameters s and t of the subpatch run from `-1 / MARGIN` to `1 / MARGIN`; all bounds hold from -1 to 1. The
/// numbers are rounded to `f32` first, so that the bounds hold for the rounded numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Paraboloid {
    pub(crate) domain: Domain,
    /// The point at which alpha, beta and gamma are zero.
    pub(crate) center: DVec3,
    /// The gradients of alpha, beta and gamma; the gradient of gamma has unit length.
    pub(crate) axes: [DVec3; 3],
    /// The second derivatives `h_aa`, `h_ab`, `h_bb`.
    pub(crate) hessian: [f64; 3],
    /// The height of the paraboloid at alpha = beta = 0.
    pub(crate) offset: f64,
    /// Bounds of |alpha|, |beta| and |gamma| on the subpatch.
    pub(crate) extent: [f64; 3],
    /// Bound of the difference in gamma between the surface and the paraboloid.
    pub(crate) error: f64,
    /// Bounds of the difference in slope, by alpha and by beta, between the surface and the paraboloid.
    pub(crate) slope_error: [f64; 2],
    /// A chord between two points of the surface with |s| and |t| below this lies over the image of the square.
    pub(crate) convex: f64,
}

impl Paraboloid {
    /// The paraboloid of a subpatch, given by its net in unit space and its domain.
    pub(crate) fn new(subpatch: &SoaNet, domain: Domain) -> Self {
        fit(subpatch, domain)
    }

    /// A subpatch of which only the size is known: its mean derivatives span no plane.
    #[inline(always)]
    fn degenerate(net: &SoaNet, domain: Domain, center: DVec3) -> Self {
        let bounds = net.bounds();
        let radius = (center - bounds.min).max(bounds.max - center).length();
        Self {
            domain,
            center,
            axes: [DVec3::X, DVec3::Y, DVec3::Z],
            hessian: [0.0; 3],
            offset: 0.0,
            extent: [radius + ROUNDING; 3],
            error: f64::INFINITY,
            slope_error: [f64::INFINITY; 2],
            convex: 0.0,
        }
    }

    /// Fits the paraboloid and bounds its errors, by the ordinates of the differences.
    #[inline(always)]
    fn fitted(mut self, net: &SoaNet) -> Self {
        let radius = self.extent[0];
        let SoaNet { x: alpha, y: beta, z: gamma } = net.in_coordinates(self.axes, self.center);
        let drift_a = drift(&alpha);
        let drift_b = drift(&beta.transposed());
        let drift = drift_a.max(drift_b);
        // The map from (s, t) covers the square of half size `1 - drift` in (alpha, beta), which holds all points with
        // |s|, |t| below `1 - 2 drift` and the chords between them.
        self.convex = 1.0 - 2.0 * drift - 1e-5;
        self.extent = [drift_a + 1.0 / MARGIN, drift_b + 1.0 / MARGIN, gamma.range().magnitude()];
        let shear = shear(&alpha, &beta);
        if shear < 0.9 && self.convex > 1.0 / MARGIN {
            self.bound_curved(&alpha, &beta, &gamma, shear, radius);
        } else if shear < 0.9 {
            self.bound_flat(&gamma, shear);
        }
        self.extent = from_fn(|k| self.extent[k] + ROUNDING * self.axes[k].length());
        self
    }

    /// Fits a plane. The bound of the slope compares two points of the surface along the straight line between their
    /// parameters: if their (alpha, beta) differ by D, their (s, t) differ by D up to `shear / (1 - shear)` times the
    /// larger component of D.
    #[inline(always)]
    fn bound_flat(&mut self, gamma: &Ordinates, shear: f64) {
        let Interval { low, high } = gamma.range();
        let [by_s, by_t] =
            [gamma, &gamma.transposed()].map(|height| 1.5 * Interval::of(&height.differences()).magnitude());
        let mixed = shear / (1.0 - shear) * (by_s + by_t);
        self.offset = f64::from((0.5 * (low + high)) as f32);
        self.error = (high - self.offset).max(self.offset - low) + ROUNDING;
        self.slope_error = [by_s + mixed + ROUNDING, by_t + mixed + ROUNDING];
        self.convex = 1.0;
    }

    /// Fits a curved paraboloid.
    #[inline(always)]
    fn bound_curved(&mut self, alpha: &Ordinates, beta: &Ordinates, gamma: &Ordinates, shear: f64, radius: f64) {
        self.hessian = mean_hessian(gamma);
        let [h_aa, h_ab, h_bb] = self.hessian;
        let (mut half_gradient_a, mut half_gradient_b) = (Ordinates::ZERO, Ordinates::ZERO);
        for i in 0..4 {
            half_gradient_a.0[i] = alpha.0[i] * (-0.5 * h_aa) + beta.0[i] * -h_ab;
            half_gradient_b.0[i] = beta.0[i] * (-0.5 * h_bb);
        }
        let one = Ordinates([Row::splat(1.0); 4]);
        let residual = sum_of_products([(gamma, &one), (alpha, &half_gradient_a), (beta, &half_gradient_b)]);
        let (Interval { low, high }, [by_s, by_t]) = bounds_of(&residual);
        self.offset = f64::from((0.5 * (low + high)) as f32);
        // From derivatives by (s, t) to derivatives by (alpha, beta): the inverse of a Jacobian that differs from 1 by
        // `shear`.
        let mixed = shear / (1.0 - shear) * by_s.max(by_t);
        // Points on rays that hit the subpatch have coordinates below the lengths of the axes times the radius; the second
        // derivatives amplify their rounding.
        let turns = [h_aa.abs() + h_ab.abs(), h_ab.abs() + h_bb.abs()];
        let growth: f64 = (0..2).map(|k| self.axes[k].length_squared() * radius * turns[k]).sum();
        let rounding = ROUNDING * (1.0 + growth);
        self.error = (high - self.offset).max(self.offset - low) + rounding;
        self.slope_error = [by_s + mixed + rounding, by_t + mixed + rounding];
    }
}

simd_dispatch! {
    fn fit(subpatch: &SoaNet, domain: Domain) -> Paraboloid {
        let ends = (0.5 - 0.5 * MARGIN, 0.5 + 0.5 * MARGIN);
        let net = subpatch.restricted(ends, ends);
        let center = rounded(net.corner_mean());
        let degenerate = Paraboloid::degenerate(&net, domain, center);
        match mean_gradients(&net) {
            Some(axes) => Paraboloid { axes: axes.map(rounded), ..degenerate }.fitted(&net),
            None => degenerate,
        }
    }
}

/// The gradients of affine coordinates (alpha, beta, gamma) in which a net is on average `(s, t, 0)`, with its parameters
/// s and t from -1 to 1; the gradient of gamma has unit length. `None` where the mean partial derivatives span no plane.
#[inline(always)]
pub(crate) fn mean_gradients(net: &SoaNet) -> Option<[DVec3; 3]> {
    let [a, b] = net.mean_derivatives();
    let normal = a.cross(b);
    if normal.length() <= 1e-6 * a.length() * b.length() || normal.length() < 1e-12 {
        return None;
    }
    let normal = normal.normalize();
    let (across_b, across_a) = (b.cross(normal), normal.cross(a));
    Some([across_b / across_b.dot(a), across_a / across_a.dot(b), normal])
}

/// The vector with its coordinates rounded to `f32`.
fn rounded(p: DVec3) -> DVec3 {
    p.as_vec3().as_dvec3()
}

/// The greatest difference between a coordinate and the parameter s along u, whose ordinates are -1, -1/3, 1/3, 1.
#[inline(always)]
fn drift(coordinate: &Ordinates) -> f64 {
    let [a, b, c, d] = coordinate.0;
    let third = Row::splat(1.0 / 3.0);
    let one = Row::splat(1.0);
    Interval::of(&[a + one, b + third, c - third, d - one]).magnitude()
}

/// The means of the second derivatives by ss, st and tt, rounded to `f32`. With parameters from -1 to 1 the ordinates of a
/// derivative are 3/2 times the differences.
#[inline(always)]
fn mean_hessian(values: &Ordinates) -> [f64; 3] {
    let mean = |[a, b]: [Row; 2]| 1.5 / 8.0 * (a + b).0.iter().sum::<f64>();
    // The sum of the nine mixed differences is this difference of the corners.
    let [Row([a, .., b]), _, _, Row([c, .., d])] = values.0;
    [mean(values.second_differences()), 2.25 / 9.0 * (d - c - b + a), mean(values.transposed().second_differences())]
        .map(|h| f64::from(h as f32))
}

/// Bound of the maximum norm of `J - 1` and of its transpose, with J the Jacobian of (alpha, beta) by (s, t).
#[inline(always)]
fn shear(alpha: &Ordinates, beta: &Ordinates) -> f64 {
    let derivative = |ordinates: &Ordinates| Interval::of(&ordinates.differences()).scaled(1.5);
    let (ss, st) = (derivative(alpha).minus(1.0).magnitude(), derivative(&alpha.transposed()).magnitude());
    let (ts, tt) = (derivative(beta).magnitude(), derivative(&beta.transposed()).minus(1.0).magnitude());
    (ss + st).max(ts + tt).max(ss + ts).max(st + tt) + ROUNDING
}

/// A polynomial of degree 6 in each parameter by its Bezier ordinates `[i][j]`; column 7 repeats column 6.
type Sextic = [[Row; 2]; 7];

/// The sum of products of bicubic polynomials \[FaroukiRajan88\].
///
/// Once ordinates are scaled by their binomial coefficients, polynomials in Bernstein form multiply like polynomials in
/// power form.
#[inline(always)]
fn sum_of_products(terms: [(&Ordinates, &Ordinates); 3]) -> Sextic {
    const CUBIC: [f64; 4] = [1.0, 3.0, 3.0, 1.0];
    const SEXTIC: [f64; 7] = [1.0, 1.0 / 6.0, 1.0 / 15.0, 1.0 / 20.0, 1.0 / 15.0, 1.0 / 6.0, 1.0];
    // Indexed by row of the product and column of the first factor: rows for different columns of the product are
    // separate sums, so that no addition waits for another.
    let mut sums = [[Row::ZERO; 4]; 7];
    for (a, b) in terms {
        let scaled: [Row; 4] = from_fn(|k| b.0[k] * (Row(CUBIC) * CUBIC[k]));
        for i in 0..4 {
            for j in 0..4 {
                let weight = CUBIC[i] * CUBIC[j] * a.0[i].0[j];
                for k in 0..4 {
                    sums[i + k][j] = sums[i + k][j] + scaled[k] * weight;
                }
            }
        }
    }
    let mut product = [[Row::ZERO; 2]; 7];
    for (i, [Row(a), Row(b), Row(c), Row(d)]) in sums.iter().enumerate() {
        let last = d[3];
        let low = Row([a[0], a[1] + b[0], (a[2] + b[1]) + c[0], (a[3] + b[2]) + (c[1] + d[0])]);
        let high = Row([(b[3] + c[2]) + d[1], c[3] + d[2], last, last]);
        let [s0, s1, s2, s3, s4, s5, s6] = SEXTIC;
        product[i] = [low * (Row([s0, s1, s2, s3]) * SEXTIC[i]), high * (Row([s4, s5, s6, s6]) * SEXTIC[i])];
    }
    product
}

/// Bounds, by the ordinates, of a polynomial on the square: the interval of its values, and the greatest absolute
/// derivatives by s and by t.
#[inline(always)]
fn bounds_of(values: &Sextic) -> (Interval, [f64; 2]) {
    let mut all = [Row::ZERO; 14];
    let mut differences_s = [Row::ZERO; 12];
    let mut differences_t = [Row::ZERO; 14];
    for (i, [low, high]) in values.iter().enumerate() {
        let (Row([_, b, c, d]), Row([e, f, g, h])) = (*low, *high);
        [all[2 * i], all[2 * i + 1]] = [*low, *high];
        [differences_t[2 * i], differences_t[2 * i + 1]] = [Row([b, c, d, e]) - *low, Row([f, g, h, h]) - *high];
        if i > 0 {
            [differences_s[2 * i - 2], differences_s[2 * i - 1]] = [*low - values[i - 1][0], *high - values[i - 1][1]];
        }
    }
    // The ordinates of a derivative are the differences times half the degree.
    (
        Interval::of(&all),
        [3.0 * Interval::of(&differences_s).magnitude(), 3.0 * Interval::of(&differences_t).magnitude()],
    )
}
