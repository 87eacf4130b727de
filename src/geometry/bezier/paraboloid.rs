//! A small part of a patch as a paraboloid, with bounds of all that it leaves out.

use super::newton::Domain;
use super::row::{Range, Row, Rows};
use super::row_net::RowNet;
use crate::math::lanes::simd_dispatch;
use glam::DVec3;
use std::array::from_fn;

/// A part is described over a square larger than itself by this factor: the bounds then hold around it as well, and a
/// root next to it proves that there is none inside.
pub(super) const MARGIN: f64 = 1.25;

/// Rounding in `f32` moves points in unit space by less than this, per unit of length involved: coordinates are below 1
/// and a dot product rounds five times, each by at most 6e-8.
pub(super) const ROUNDING: f64 = 4e-6;

/// A part of a patch in unit space, in coordinates (alpha, beta, gamma) in which it is nearly the graph
/// `gamma = offset + h_aa alpha^2 / 2 + h_ab alpha beta + h_bb beta^2 / 2` over a square.
///
/// With the parameters s and t of the part running from `-1 / MARGIN` to `1 / MARGIN`, all bounds hold for -1 to 1. What
/// is stored is rounded to `f32` first and bounded then.
#[derive(Clone, Copy, Debug)]
pub(super) struct Paraboloid {
    pub(super) domain: Domain,
    /// Where alpha, beta and gamma are zero.
    pub(super) center: DVec3,
    /// The gradients of alpha, beta and gamma; the last has unit length.
    pub(super) axes: [DVec3; 3],
    /// The second derivatives `h_aa`, `h_ab`, `h_bb`.
    pub(super) hessian: [f64; 3],
    pub(super) offset: f64,
    /// Bounds of |alpha|, |beta| and |gamma| on the part itself.
    pub(super) extent: [f64; 3],
    /// Bound of the distance of gamma from the paraboloid.
    pub(super) error: f64,
    /// Bounds of the difference between the derivatives of gamma by alpha and by beta and those of the paraboloid.
    pub(super) slope_error: [f64; 2],
    /// A chord between two points of the surface with |s| and |t| below this stays over the described square.
    pub(super) convex: f64,
}

impl Paraboloid {
    /// Describes the part over `domain` with this net.
    pub(super) fn new(part: &RowNet, domain: Domain) -> Self {
        describe(part, domain)
    }

    /// A part about which nothing is known but its size.
    #[inline(always)]
    fn shapeless(net: &RowNet, domain: Domain, center: DVec3) -> Self {
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

    /// Fits the paraboloid, and bounds what it leaves out by the control points of the differences.
    #[inline(always)]
    fn fitted(mut self, net: &RowNet) -> Self {
        let radius = self.extent[0];
        let RowNet { x: alpha, y: beta, z: gamma } = net.in_coordinates(self.axes, self.center);
        let drift_a = drift(&alpha);
        let drift_b = drift(&beta.transposed());
        let drift = drift_a.max(drift_b);
        // The square of half size `1 - drift` in (alpha, beta) is covered by the map from (s, t), and holds all points
        // with |s|, |t| below `1 - 2 drift`, with the chords between them.
        self.convex = 1.0 - 2.0 * drift - 1e-5;
        self.extent = [drift_a + 1.0 / MARGIN, drift_b + 1.0 / MARGIN, gamma.range().greatest()];
        let shear = shear(&alpha, &beta);
        if shear < 0.9 && self.convex > 1.0 / MARGIN {
            self.bound_curved(&alpha, &beta, &gamma, shear, radius);
        } else if shear < 0.9 {
            self.bound_flat(&gamma, shear);
        }
        self.extent = from_fn(|k| self.extent[k] + ROUNDING * self.axes[k].length());
        self
    }

    /// Takes the part for a plane. Two points of the surface are then compared along the straight line between their
    /// parameters: if (alpha, beta) differ by D, then (s, t) differ by D up to `shear / (1 - shear)` times the larger
    /// component of D.
    #[inline(always)]
    fn bound_flat(&mut self, gamma: &Rows, shear: f64) {
        let Range { low, high } = gamma.range();
        let [by_s, by_t] = [gamma, &gamma.transposed()].map(|rows| 1.5 * Range::of(&rows.steps()).greatest());
        let mixed = shear / (1.0 - shear) * (by_s + by_t);
        self.offset = f64::from((0.5 * (low + high)) as f32);
        self.error = (high - self.offset).max(self.offset - low) + ROUNDING;
        self.slope_error = [by_s + mixed + ROUNDING, by_t + mixed + ROUNDING];
        self.convex = 1.0;
    }

    /// Takes the part for a paraboloid.
    #[inline(always)]
    fn bound_curved(&mut self, alpha: &Rows, beta: &Rows, gamma: &Rows, shear: f64, radius: f64) {
        self.hessian = mean_hessian(gamma);
        let [h_aa, h_ab, h_bb] = self.hessian;
        let (mut half_gradient_a, mut half_gradient_b) = (Rows::ZERO, Rows::ZERO);
        for i in 0..4 {
            half_gradient_a.0[i] = alpha.0[i] * (-0.5 * h_aa) + beta.0[i] * -h_ab;
            half_gradient_b.0[i] = beta.0[i] * (-0.5 * h_bb);
        }
        let one = Rows([Row::splat(1.0); 4]);
        let residual = sum_of_products([(gamma, &one), (alpha, &half_gradient_a), (beta, &half_gradient_b)]);
        let (Range { low, high }, [by_s, by_t]) = bounds_of(&residual);
        self.offset = f64::from((0.5 * (low + high)) as f32);
        // From derivatives by (s, t) to those by (alpha, beta): the inverse of a Jacobian that differs from 1 by `shear`.
        let mixed = shear / (1.0 - shear) * by_s.max(by_t);
        // Coordinates of points on rays that meet the part stay below the lengths of the axes times its radius; what
        // rounding does to them grows by the second derivatives.
        let turns = [h_aa.abs() + h_ab.abs(), h_ab.abs() + h_bb.abs()];
        let growth: f64 = (0..2).map(|k| self.axes[k].length_squared() * radius * turns[k]).sum();
        let rounding = ROUNDING * (1.0 + growth);
        self.error = (high - self.offset).max(self.offset - low) + rounding;
        self.slope_error = [by_s + mixed + rounding, by_t + mixed + rounding];
    }
}

simd_dispatch! {
    fn describe(part: &RowNet, domain: Domain) -> Paraboloid {
        let ends = (0.5 - 0.5 * MARGIN, 0.5 + 0.5 * MARGIN);
        let net = part.restricted(ends, ends);
        let center = rounded(net.middle());
        let shapeless = Paraboloid::shapeless(&net, domain, center);
        match mean_gradients(&net) {
            Some(axes) => Paraboloid { axes: axes.map(rounded), ..shapeless }.fitted(&net),
            None => shapeless,
        }
    }
}

/// The gradients of coordinates (alpha, beta, gamma) in which a part is on average `(s, t, 0)`, with s and t its parameters
/// from -1 to 1; that of gamma has unit length. None where the mean partial derivatives span no plane.
#[inline(always)]
pub(super) fn mean_gradients(net: &RowNet) -> Option<[DVec3; 3]> {
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

/// How far a coordinate is from the parameter along u, from -1 to 1: it has evenly spaced control points.
#[inline(always)]
fn drift(coordinate: &Rows) -> f64 {
    let [a, b, c, d] = coordinate.0;
    let third = Row::splat(1.0 / 3.0);
    let one = Row::splat(1.0);
    Range::of(&[a + one, b + third, c - third, d - one]).greatest()
}

/// The means of the second derivatives by ss, st and tt, as `f32` numbers. Parameters from -1 to 1 make a derivative of
/// a cubic 3/2 of a difference of control points.
#[inline(always)]
fn mean_hessian(values: &Rows) -> [f64; 3] {
    let mean = |[a, b]: [Row; 2]| 1.5 / 8.0 * (a + b).0.iter().sum::<f64>();
    // The sum of all nine mixed differences.
    let [Row([a, .., b]), _, _, Row([c, .., d])] = values.0;
    [mean(values.bends()), 2.25 / 9.0 * (d - c - b + a), mean(values.transposed().bends())].map(|h| f64::from(h as f32))
}

/// Bound of the norm of `J - 1` and of its transpose, with J the Jacobian of (alpha, beta) by (s, t).
#[inline(always)]
fn shear(alpha: &Rows, beta: &Rows) -> f64 {
    let derivative = |rows: &Rows| Range::of(&rows.steps()).scaled(1.5);
    let (ss, st) = (derivative(alpha).less(1.0).greatest(), derivative(&alpha.transposed()).greatest());
    let (ts, tt) = (derivative(beta).greatest(), derivative(&beta.transposed()).less(1.0).greatest());
    (ss + st).max(ts + tt).max(ss + ts).max(st + tt) + ROUNDING
}

/// A polynomial of degree 6 in each parameter by its control points, `[i][j]`, with column 6 once more as column 7.
type Sextic = [[Row; 2]; 7];

/// The sum of products of bicubic polynomials.
///
/// With each control point times its binomial coefficients, polynomials in Bernstein form multiply like those in power
/// form.
#[inline(always)]
fn sum_of_products(terms: [(&Rows, &Rows); 3]) -> Sextic {
    const CUBIC: [f64; 4] = [1.0, 3.0, 3.0, 1.0];
    const SEXTIC: [f64; 7] = [1.0, 1.0 / 6.0, 1.0 / 15.0, 1.0 / 20.0, 1.0 / 15.0, 1.0 / 6.0, 1.0];
    // By row of the product and by column of the first factor: with rows apart that go to different columns of the
    // product, no sum waits for another.
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

/// The least and the greatest value of a polynomial on the square, and the greatest absolute derivatives by s and by t,
/// or more: these are bounds from the control points.
#[inline(always)]
fn bounds_of(values: &Sextic) -> (Range, [f64; 2]) {
    let mut all = [Row::ZERO; 14];
    let mut steps_s = [Row::ZERO; 12];
    let mut steps_t = [Row::ZERO; 14];
    for (i, [low, high]) in values.iter().enumerate() {
        let (Row([_, b, c, d]), Row([e, f, g, h])) = (*low, *high);
        [all[2 * i], all[2 * i + 1]] = [*low, *high];
        [steps_t[2 * i], steps_t[2 * i + 1]] = [Row([b, c, d, e]) - *low, Row([f, g, h, h]) - *high];
        if i > 0 {
            [steps_s[2 * i - 2], steps_s[2 * i - 1]] = [*low - values[i - 1][0], *high - values[i - 1][1]];
        }
    }
    // Half the degree times the differences.
    (Range::of(&all), [3.0 * Range::of(&steps_s).greatest(), 3.0 * Range::of(&steps_t).greatest()])
}
