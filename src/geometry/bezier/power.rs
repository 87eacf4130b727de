use super::ControlNet;
use glam::DVec3;
use std::array::from_fn;
use std::ops::{Add, Mul};

/// A patch as a polynomial in `x = 2 u - 1`, `y = 2 v - 1`: the quickest form to evaluate. On `[-1, 1]` it loses no
/// digits against the Bernstein form: its coefficients are no larger than the control points.
#[derive(Clone, Debug)]
pub(super) struct PowerForm {
    /// `coefficients[i][j]` belongs to `x^i y^j`.
    coefficients: [[Lanes; 4]; 4],
}

/// The point at some x, y with the derivatives by x and by y.
#[derive(Clone, Copy)]
pub(super) struct Tangents {
    pub(super) position: DVec3,
    pub(super) dx: DVec3,
    pub(super) dy: DVec3,
}

/// Three coordinates and a zero, which compilers turn into vector instructions of any width.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Lanes([f64; 4]);

impl Add for Lanes {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self([self.0[0] + b.0[0], self.0[1] + b.0[1], self.0[2] + b.0[2], self.0[3] + b.0[3]])
    }
}

impl Mul<f64> for Lanes {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: f64) -> Self {
        Self([self.0[0] * s, self.0[1] * s, self.0[2] * s, self.0[3] * s])
    }
}

impl From<Lanes> for DVec3 {
    #[inline(always)]
    fn from(v: Lanes) -> Self {
        Self::new(v.0[0], v.0[1], v.0[2])
    }
}

/// A cubic and its derivative at t, by Horner's scheme.
#[inline(always)]
fn horner(c: &[Lanes; 4], t: f64) -> (Lanes, Lanes) {
    let b2 = c[3] * t + c[2];
    let b1 = b2 * t + c[1];
    let slope = (c[3] * t + b2) * t + b1;
    (b1 * t + c[0], slope)
}

impl PowerForm {
    pub(super) fn new(net: &ControlNet) -> Self {
        let along_v = net.points.map(power_from_bernstein);
        let along_u: [[DVec3; 4]; 4] = from_fn(|j| power_from_bernstein(from_fn(|i| along_v[i][j])));
        Self { coefficients: from_fn(|i| from_fn(|j| Lanes([along_u[j][i].x, along_u[j][i].y, along_u[j][i].z, 0.0]))) }
    }

    /// Evaluates at (x, y).
    #[inline(always)]
    pub(super) fn tangents(&self, x: f64, y: f64) -> Tangents {
        let [r0, r1, r2, r3] = &self.coefficients;
        let (r0, r1, r2, r3) = (horner(r0, y), horner(r1, y), horner(r2, y), horner(r3, y));
        let (position, dx) = horner(&[r0.0, r1.0, r2.0, r3.0], x);
        let dy = ((r3.1 * x + r2.1) * x + r1.1) * x + r0.1;
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
            let (a, b) = (power.tangents(2.0 * u - 1.0, 2.0 * v - 1.0), net.derivatives(u, v));
            // Twenty roundings of terms below 4.
            assert!(a.position.distance(b.position) < 1e-14, "position at {u} {v}");
            assert!((2.0 * a.dx).distance(b.dpdu) < 1e-13, "d/du at {u} {v}");
            assert!((2.0 * a.dy).distance(b.dpdv) < 1e-13, "d/dv at {u} {v}");
        }
    }
}
