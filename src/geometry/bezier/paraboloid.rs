//! A small part of a patch as a paraboloid, with bounds of all that it leaves out.

use super::ControlNet;
use super::newton::Domain;
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

type Bernstein = [[f64; 4]; 4];

impl Paraboloid {
    /// Describes the part over `domain`; `net` is the net over the domain enlarged by [`MARGIN`].
    pub(super) fn new(net: &ControlNet, domain: Domain) -> Self {
        let [[p00, .., p03], _, _, [p30, .., p33]] = net.points;
        let center = rounded(0.25 * ((p00 + p33) + (p03 + p30)));
        let Some(axes) = mean_gradients(net) else {
            return Self::shapeless(net, domain, center);
        };
        let axes = axes.map(rounded);
        Self { axes, ..Self::shapeless(net, domain, center) }.fitted(net)
    }

    /// A part about which nothing is known but its size.
    fn shapeless(net: &ControlNet, domain: Domain, center: DVec3) -> Self {
        let radius = net.points.iter().flatten().map(|p| p.distance(center)).fold(0.0, f64::max);
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
    fn fitted(mut self, net: &ControlNet) -> Self {
        let radius = self.extent[0];
        let [alpha, beta, gamma] = self.axes.map(|axis| net.points.map(|row| row.map(|p| axis.dot(p - self.center))));
        let parameter = |i: usize| 2.0 / 3.0 * i as f64 - 1.0;
        let drift_a = largest(&from_fn(|i| from_fn(|j| alpha[i][j] - parameter(i))));
        let drift_b = largest(&from_fn(|i| from_fn(|j| beta[i][j] - parameter(j))));
        let drift = drift_a.max(drift_b);
        // The square of half size `1 - drift` in (alpha, beta) is covered by the map from (s, t), and holds all points
        // with |s|, |t| below `1 - 2 drift`, with the chords between them.
        self.convex = 1.0 - 2.0 * drift - 1e-5;
        self.extent = [drift_a + 1.0 / MARGIN, drift_b + 1.0 / MARGIN, largest(&gamma)];
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
    fn bound_flat(&mut self, gamma: &Bernstein, shear: f64) {
        let (low, high) = range(gamma);
        let [by_s, by_t] = largest_derivatives(gamma, 1.5);
        let mixed = shear / (1.0 - shear) * (by_s + by_t);
        self.offset = f64::from((0.5 * (low + high)) as f32);
        self.error = (high - self.offset).max(self.offset - low) + ROUNDING;
        self.slope_error = [by_s + mixed + ROUNDING, by_t + mixed + ROUNDING];
        self.convex = 1.0;
    }

    /// Takes the part for a paraboloid.
    fn bound_curved(&mut self, alpha: &Bernstein, beta: &Bernstein, gamma: &Bernstein, shear: f64, radius: f64) {
        self.hessian = mean_hessian(gamma);
        let [h_aa, h_ab, h_bb] = self.hessian;
        let half_gradient_a = from_fn(|i| from_fn(|j| 0.5 * h_aa * alpha[i][j] + h_ab * beta[i][j]));
        let half_gradient_b = beta.map(|row| row.map(|b| 0.5 * h_bb * b));
        let one = [[1.0; 4]; 4];
        let residual =
            sum_of_products([(gamma, &one, 1.0), (alpha, &half_gradient_a, -1.0), (beta, &half_gradient_b, -1.0)]);
        let (low, high) = range(&residual);
        self.offset = f64::from((0.5 * (low + high)) as f32);
        let [by_s, by_t] = largest_derivatives(&residual, 3.0);
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

/// The gradients of coordinates (alpha, beta, gamma) in which a part is on average `(s, t, 0)`, with s and t its parameters
/// from -1 to 1; that of gamma has unit length. None where the mean partial derivatives span no plane.
pub(super) fn mean_gradients(net: &ControlNet) -> Option<[DVec3; 3]> {
    let [[p00, .., p03], _, _, [p30, .., p33]] = net.points;
    let (a, b) = (0.25 * ((p33 - p00) + (p30 - p03)), 0.25 * ((p33 - p00) - (p30 - p03)));
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

fn largest(values: &Bernstein) -> f64 {
    values.iter().flatten().fold(0.0, |largest, x| x.abs().max(largest))
}

/// The means of the second derivatives by ss, st and tt, as `f32` numbers. Parameters from -1 to 1 make a derivative of
/// a cubic 3/2 of a difference of control points.
fn mean_hessian(values: &Bernstein) -> [f64; 3] {
    let bend = |[a, b, c, d]: [f64; 4]| 1.5 / 8.0 * ((c - 2.0 * b + a) + (d - 2.0 * c + b));
    let ss: f64 = (0..4).map(|j| bend(from_fn(|i| values[i][j]))).sum();
    let tt: f64 = (0..4).map(|i| bend(values[i])).sum();
    // The sum of all nine mixed differences.
    let st = 2.25 / 9.0 * (values[3][3] - values[3][0] - values[0][3] + values[0][0]);
    [ss, st, tt].map(|h| f64::from(h as f32))
}

/// Bound of the norm of `J - 1` and of its transpose, with J the Jacobian of (alpha, beta) by (s, t).
fn shear(alpha: &Bernstein, beta: &Bernstein) -> f64 {
    let mut bounds = [[0f64; 2]; 2];
    for i in 0..3 {
        for j in 0..4 {
            for (row, values) in [alpha, beta].into_iter().enumerate() {
                let by_s = 1.5 * (values[i + 1][j] - values[i][j]) - f64::from(row == 0);
                let by_t = 1.5 * (values[j][i + 1] - values[j][i]) - f64::from(row == 1);
                bounds[row] = [bounds[row][0].max(by_s.abs()), bounds[row][1].max(by_t.abs())];
            }
        }
    }
    let [[ss, st], [ts, tt]] = bounds;
    (ss + st).max(ts + tt).max(ss + ts).max(st + tt) + ROUNDING
}

/// The sum of products `factor * a * b` of bicubic polynomials, as a polynomial of degree 6 by its control points.
///
/// With each control point times its binomial coefficients, polynomials in Bernstein form multiply like those in power
/// form.
fn sum_of_products(terms: [(&Bernstein, &Bernstein, f64); 3]) -> [[f64; 7]; 7] {
    const CUBIC: [f64; 4] = [1.0, 3.0, 3.0, 1.0];
    const SEXTIC: [f64; 7] = [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0];
    let scaled = |values: &Bernstein| -> Bernstein { from_fn(|i| from_fn(|j| CUBIC[i] * CUBIC[j] * values[i][j])) };
    let mut sum = [[0f64; 7]; 7];
    for (a, b, factor) in terms {
        let (a, b) = (scaled(a), scaled(b));
        for i in 0..16 {
            let weight = factor * a[i / 4][i % 4];
            for (row, values) in sum[i / 4..].iter_mut().zip(&b) {
                for (entry, value) in row[i % 4..].iter_mut().zip(values) {
                    *entry += weight * value;
                }
            }
        }
    }
    from_fn(|i| from_fn(|j| sum[i][j] / (SEXTIC[i] * SEXTIC[j])))
}

/// Bounds of the absolute derivatives by s and by t of a polynomial of degree `N - 1` in each: they have the differences
/// of control points times half the degree, `half_degree`, for control points.
fn largest_derivatives<const N: usize>(values: &[[f64; N]; N], half_degree: f64) -> [f64; 2] {
    let largest = |steps: &dyn Fn(usize, usize) -> f64| {
        (0..N * (N - 1)).map(|k| half_degree * steps(k / N, k % N).abs()).fold(0.0, f64::max)
    };
    [largest(&|i, j| values[i + 1][j] - values[i][j]), largest(&|j, i| values[i][j + 1] - values[i][j])]
}

fn range<const N: usize>(values: &[[f64; N]; N]) -> (f64, f64) {
    values.iter().flatten().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| (x.min(low), x.max(high)))
}
