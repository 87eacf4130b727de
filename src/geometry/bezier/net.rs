use super::cubic::Cubic;
use crate::math::Aabb;
use glam::{DAffine3, DVec3};
use std::array::from_fn;

/// The 4 x 4 control points of a bicubic patch: `S(u, v) = sum B_i(u) B_j(v) points[i][j]` with the Bernstein polynomials
/// `B_i` of degree 3, for u and v from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlNet {
    /// `points[i][j]`, i along u, j along v, in scene units.
    pub points: [[DVec3; 4]; 4],
}

/// A point of a patch with its first and second partial derivatives, in scene units (per unit of u and v).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives {
    /// `S(u, v)`.
    pub position: DVec3,
    /// `dS/du`.
    pub dpdu: DVec3,
    /// `dS/dv`.
    pub dpdv: DVec3,
    /// `d2S/du2`.
    pub d2pdu2: DVec3,
    /// `d2S/dudv`.
    pub d2pdudv: DVec3,
    /// `d2S/dv2`.
    pub d2pdv2: DVec3,
}

impl ControlNet {
    /// The point `S(u, v)`. It is exact at the corners; on an edge it depends on that edge's four control points alone, so that
    /// patches that share an edge meet without a gap.
    pub fn eval(&self, u: f64, v: f64) -> DVec3 {
        let [a, b, c, d] = self.points;
        Cubic([Cubic(a).eval(v), Cubic(b).eval(v), Cubic(c).eval(v), Cubic(d).eval(v)]).eval(u)
    }

    /// The point with its derivatives, by de Casteljau's algorithm in v, then in u.
    pub fn derivatives(&self, u: f64, v: f64) -> Derivatives {
        let [a, b, c, d] = self.points;
        let [a, b, c, d] =
            [Cubic(a).derivatives(v), Cubic(b).derivatives(v), Cubic(c).derivatives(v), Cubic(d).derivatives(v)];
        let along_u = |order: usize| Cubic([a[order], b[order], c[order], d[order]]).derivatives(u);
        let [position, dpdu, d2pdu2] = along_u(0);
        let [dpdv, d2pdudv, _] = along_u(1);
        let [d2pdv2, ..] = along_u(2);
        Derivatives { position, dpdu, dpdv, d2pdu2, d2pdudv, d2pdv2 }
    }

    /// The box of the control points. It holds the patch, which lies in the convex hull of its control points.
    pub fn bounds(&self) -> Aabb {
        Aabb::around(self.points.into_iter().flatten())
    }

    /// The net of the patch under an affine map.
    pub fn transformed(&self, map: &DAffine3) -> Self {
        self.map(|p| map.transform_point3(p))
    }

    /// The net with `f` applied to every control point.
    pub fn map(&self, f: impl Fn(DVec3) -> DVec3) -> Self {
        Self { points: self.points.map(|row| row.map(&f)) }
    }

    /// The surface with u and v exchanged, which flips the normal.
    pub fn transposed(&self) -> Self {
        Self { points: from_fn(|i| from_fn(|j| self.points[j][i])) }
    }

    /// Whether every coordinate is finite.
    pub fn is_finite(&self) -> bool {
        self.points.iter().flatten().all(|p| p.is_finite())
    }

    /// The net of the subpatch over `u.0 <= u <= u.1`, `v.0 <= v <= v.1`; the ends may lie outside of 0 to 1.
    pub fn restricted(&self, u: (f64, f64), v: (f64, f64)) -> Self {
        let rows = self.points.map(|row| Cubic(row).restricted(v).0);
        let columns: [_; 4] = from_fn(|j| Cubic(from_fn(|i| rows[i][j])).restricted(u).0);
        Self { points: from_fn(|i| from_fn(|j| columns[j][i])) }
    }

    /// The subpatches over `u <= 1/2` and over `u >= 1/2`, each with parameters from 0 to 1.
    pub fn split_u(&self) -> [Self; 2] {
        let columns: [_; 4] = from_fn(|j| Cubic(from_fn(|i| self.points[i][j])).halves());
        [0, 1].map(|half| Self { points: from_fn(|i| from_fn(|j| columns[j][half].0[i])) })
    }

    /// The subpatches over `v <= 1/2` and over `v >= 1/2`, each with parameters from 0 to 1.
    pub fn split_v(&self) -> [Self; 2] {
        self.transposed().split_u().map(|half| half.transposed())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn net() -> ControlNet {
        let height = [[0.0, 0.3, -0.2, 0.1], [0.5, 0.9, 0.4, 0.0], [-0.3, 0.2, 0.8, 0.6], [0.1, -0.4, 0.3, 0.2]];
        ControlNet { points: from_fn(|i| from_fn(|j| DVec3::new(i as f64, j as f64 + 0.1 * i as f64, height[i][j]))) }
    }

    fn grid() -> impl Iterator<Item = (f64, f64)> {
        (0..=8).flat_map(|i| (0..=8).map(move |j| (f64::from(i) / 8.0, f64::from(j) / 8.0)))
    }

    #[test]
    fn corners_are_exact_and_edges_need_their_own_points_only() {
        let net = net();
        for (i, j) in [(0, 0), (0, 3), (3, 0), (3, 3)] {
            assert_eq!(net.eval(i as f64 / 3.0, j as f64 / 3.0), net.points[i][j], "corner {i} {j}");
        }
        let mut other = net.map(|p| 7.0 - 3.0 * p);
        other.points[3] = net.points[0];
        for (t, _) in grid() {
            assert_eq!(net.eval(0.0, t), other.eval(1.0, t), "shared edge at {t}");
        }
    }

    #[test]
    fn derivatives_match_differences() {
        let net = net();
        // A central difference with step h of a function with third derivatives below 50 is good to 50 h^2 / 6, plus
        // 1e-15 / h of rounding.
        let h = 1e-4;
        for (u, v) in grid() {
            let d = net.derivatives(u, v);
            let across = |du: f64, dv: f64| (net.derivatives(u + du, v + dv), net.derivatives(u - du, v - dv));
            let ((u_plus, u_minus), (v_plus, v_minus)) = (across(h, 0.0), across(0.0, h));
            let pairs = [
                (d.dpdu, u_plus.position - u_minus.position),
                (d.dpdv, v_plus.position - v_minus.position),
                (d.d2pdu2, u_plus.dpdu - u_minus.dpdu),
                (d.d2pdudv, v_plus.dpdu - v_minus.dpdu),
                (d.d2pdv2, v_plus.dpdv - v_minus.dpdv),
            ];
            for (derivative, difference) in pairs {
                assert!((derivative - difference / (2.0 * h)).length() < 1e-6, "at {u} {v}");
            }
        }
    }

    #[test]
    fn halves_are_the_patch_on_half_the_domain() {
        let net = net();
        let ([low_u, high_u], [low_v, high_v]) = (net.split_u(), net.split_v());
        for (u, v) in grid() {
            let pairs = [
                (low_u.eval(u, v), net.eval(0.5 * u, v)),
                (high_u.eval(u, v), net.eval(0.5 + 0.5 * u, v)),
                (low_v.eval(u, v), net.eval(u, 0.5 * v)),
                (high_v.eval(u, v), net.eval(u, 0.5 + 0.5 * v)),
            ];
            for (half, whole) in pairs {
                // Some ten roundings of coordinates below 4.
                assert!(half.distance(whole) < 1e-14, "at {u} {v}");
            }
        }
    }
}
