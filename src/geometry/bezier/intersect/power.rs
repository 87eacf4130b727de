use crate::geometry::bezier::ControlNet;
use crate::geometry::bezier::unit::{Row, Slack};
use crate::math::lanes::Lanes;
use glam::DVec3;
use std::array::from_fn;

/// A patch in power form: the polynomial in `x = 2 u - 1`, `y = 2 v - 1`, which is the fastest form to evaluate. Centered on
/// the domain it is as accurate as the Bernstein form: its coefficients are at most 2.25 times the largest control point.
#[derive(Clone, Debug)]
pub(crate) struct PowerForm {
    /// `coefficients[i][j]` of `x^i y^j`: three coordinates and a zero.
    coefficients: [[Row; 4]; 4],
    /// The coefficients in single precision, `[axis][i][j]`.
    single: [[[f32; 4]; 4]; 3],
    /// The distance outside of a subpatch's domain up to which a root is a hit.
    pub(crate) slack: Slack,
}

/// One coordinate of eight points of a patch, with its derivatives by x and by y.
#[derive(Clone, Copy)]
pub(crate) struct LaneTangents<L: Lanes> {
    pub(crate) position: L::Vector,
    pub(crate) dx: L::Vector,
    pub(crate) dy: L::Vector,
}

/// A point of a patch with the derivatives by x and by y, in unit space.
#[derive(Clone, Copy)]
pub(crate) struct Tangents {
    pub(crate) position: DVec3,
    pub(crate) dx: DVec3,
    pub(crate) dy: DVec3,
}

impl From<Row> for DVec3 {
    #[inline(always)]
    fn from(v: Row) -> Self {
        Self::new(v.0[0], v.0[1], v.0[2])
    }
}

/// A cubic and its derivative at t, by Horner's scheme.
#[inline(always)]
fn horner(l: impl Lanes, c: &[Row; 4], t: f64) -> (Row, Row) {
    let b2 = c[3].mul_add(l, t, c[2]);
    let b1 = b2.mul_add(l, t, c[1]);
    let slope = c[3].mul_add(l, t, b2).mul_add(l, t, b1);
    (b1.mul_add(l, t, c[0]), slope)
}

/// A cubic and its derivative at eight parameters t.
#[inline(always)]
fn horner_lanes<L: Lanes>(l: L, c: &[f32; 4], t: L::Vector) -> (L::Vector, L::Vector) {
    let c3 = l.splat(c[3]);
    let b2 = l.mul_add(c3, t, l.splat(c[2]));
    let b1 = l.mul_add(b2, t, l.splat(c[1]));
    (l.mul_add(b1, t, l.splat(c[0])), l.mul_add(l.mul_add(c3, t, b2), t, b1))
}

impl PowerForm {
    /// The power form of a net in unit space.
    pub(crate) fn new(net: &ControlNet) -> Self {
        let along_v = net.points.map(power_from_bernstein);
        let along_u: [[DVec3; 4]; 4] = from_fn(|j| power_from_bernstein(from_fn(|i| along_v[i][j])));
        Self {
            coefficients: from_fn(|i| from_fn(|j| Row([along_u[j][i].x, along_u[j][i].y, along_u[j][i].z, 0.0]))),
            single: from_fn(|axis| from_fn(|i| from_fn(|j| along_u[j][i][axis] as f32))),
            slack: Slack::new(net),
        }
    }

    /// Evaluates one coordinate at eight (x, y), in single precision.
    #[inline(always)]
    pub(crate) fn lane_tangents<L: Lanes>(&self, l: L, axis: usize, x: L::Vector, y: L::Vector) -> LaneTangents<L> {
        let [r0, r1, r2, r3] = &self.single[axis];
        let (r0, r1, r2, r3) =
            (horner_lanes(l, r0, y), horner_lanes(l, r1, y), horner_lanes(l, r2, y), horner_lanes(l, r3, y));
        let b2 = l.mul_add(r3.0, x, r2.0);
        let b1 = l.mul_add(b2, x, r1.0);
        LaneTangents {
            position: l.mul_add(b1, x, r0.0),
            dx: l.mul_add(l.mul_add(r3.0, x, b2), x, b1),
            dy: l.mul_add(l.mul_add(l.mul_add(r3.1, x, r2.1), x, r1.1), x, r0.1),
        }
    }

    /// Evaluates at (x, y).
    #[inline(always)]
    pub(crate) fn tangents(&self, l: impl Lanes, x: f64, y: f64) -> Tangents {
        let [r0, r1, r2, r3] = &self.coefficients;
        let (r0, r1, r2, r3) = (horner(l, r0, y), horner(l, r1, y), horner(l, r2, y), horner(l, r3, y));
        let (position, dx) = horner(l, &[r0.0, r1.0, r2.0, r3.0], x);
        let dy = r3.1.mul_add(l, x, r2.1).mul_add(l, x, r1.1).mul_add(l, x, r0.1);
        Tangents { position: position.into(), dx: dx.into(), dy: dy.into() }
    }
}

/// The coefficients in `x = 2 t - 1` of a cubic given by its control points.
fn power_from_bernstein(p: [DVec3; 4]) -> [DVec3; 4] {
    let [a, b, c, d] = p;
    [
        (a + 3.0 * b + 3.0 * c + d) / 8.0,
        3.0 * (d + c - b - a) / 8.0,
        3.0 * (a - b - c + d) / 8.0,
        (d - 3.0 * c + 3.0 * b - a) / 8.0,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::lanes::Portable;

    #[test]
    fn agrees_with_de_casteljau() {
        let net = ControlNet {
            points: from_fn(|i| {
                from_fn(|j| {
                    0.5 * DVec3::new(
                        (3.1 * i as f64).sin(),
                        (2.3 * j as f64).cos(),
                        (i as f64 * 1.7 + j as f64 * 5.3).sin(),
                    )
                })
            }),
        };
        let power = PowerForm::new(&net);
        for k in 0..=100 {
            let (u, v) = (f64::from(k % 11) / 10.0, f64::from(k / 10) / 10.0);
            let (a, b) = (power.tangents(Portable, 2.0 * u - 1.0, 2.0 * v - 1.0), net.derivatives(u, v));
            // Twenty roundings of terms below 4.
            assert!(a.position.distance(b.position) < 1e-14, "position at {u} {v}");
            assert!((2.0 * a.dx).distance(b.dpdu) < 1e-13, "d/du at {u} {v}");
            assert!((2.0 * a.dy).distance(b.dpdv) < 1e-13, "d/dv at {u} {v}");
        }
    }
}
