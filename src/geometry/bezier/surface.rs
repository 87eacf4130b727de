//! Differential geometry of a patch: fundamental forms, curvature, the change of the normal, area.

use super::{ControlNet, Derivatives};
use crate::math::OrthonormalBasis;
use glam::DVec3;

/// The curvature of a surface at a point, with respect to the unit normal along `dS/du x dS/dv`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvature {
    /// Derivative of the unit normal by u.
    pub dndu: DVec3,
    /// Derivative of the unit normal by v.
    pub dndv: DVec3,
    /// The mean of the two principal curvatures, per scene unit; positive where the surface bends towards its normal.
    pub mean: f64,
    /// The product of the two principal curvatures, per square scene unit.
    pub gaussian: f64,
}

impl Derivatives {
    /// The curvature, by the Weingarten equations; `None` where `dS/du x dS/dv` vanishes.
    pub fn curvature(&self) -> Option<Curvature> {
        let normal = self.dpdu.cross(self.dpdv).try_normalize()?;
        // The first and the second fundamental form.
        let (e, f, g) = (self.dpdu.length_squared(), self.dpdu.dot(self.dpdv), self.dpdv.length_squared());
        let (l, m, n) = (normal.dot(self.d2pdu2), normal.dot(self.d2pdudv), normal.dot(self.d2pdv2));
        let area_squared = e * g - f * f;
        if area_squared <= 1e-20 * e * g {
            return None;
        }
        Some(Curvature {
            dndu: ((f * m - g * l) * self.dpdu + (f * l - e * m) * self.dpdv) / area_squared,
            dndv: ((f * n - g * m) * self.dpdu + (f * m - e * n) * self.dpdv) / area_squared,
            mean: 0.5 * (e * n - 2.0 * f * m + g * l) / area_squared,
            gaussian: (l * n - m * m) / area_squared,
        })
    }

    /// The orthonormal basis of a unit normal (geometric or shading) with its tangent along `dS/du`.
    pub fn frame(&self, normal: DVec3) -> OrthonormalBasis {
        OrthonormalBasis::from_derivatives(normal, self.dpdu, self.dpdv)
    }
}

/// Points and weights of the Gauss-Legendre rule with five points on [0, 1], exact up to degree 9.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

impl ControlNet {
    /// The area of the surface, in square scene units, by Gauss-Legendre quadrature with 5 x 5 points on each of 8 x 8 cells.
    /// The relative error is about 1e-6 for patches without cusps.
    pub fn area(&self) -> f64 {
        let cells = 8;
        let coordinate = |k: usize, at: f64| (k as f64 + at) / cells as f64;
        let mut area = 0.0;
        for cell in 0..cells * cells {
            for (u, weight_u) in GAUSS {
                for (v, weight_v) in GAUSS {
                    let d = self.derivatives(coordinate(cell / cells, u), coordinate(cell % cells, v));
                    area += weight_u * weight_v * d.dpdu.cross(d.dpdv).length();
                }
            }
        }
        area / (cells * cells) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::array::from_fn;

    /// The graph of `z = a x^2 / 2 + b x y + c y^2 / 2` over the unit square around the origin, which a bicubic patch
    /// represents exactly: the blossom of t^2 on [-1/2, 1/2] gives 1/4, -1/12, -1/12, 1/4.
    fn paraboloid(a: f64, b: f64, c: f64) -> ControlNet {
        let square = [0.25, -1.0 / 12.0, -1.0 / 12.0, 0.25];
        let at = |k: usize| k as f64 / 3.0 - 0.5;
        let height = |i: usize, j: usize| 0.5 * a * square[i] + b * at(i) * at(j) + 0.5 * c * square[j];
        ControlNet { points: from_fn(|i| from_fn(|j| DVec3::new(at(i), at(j), height(i, j)))) }
    }

    #[test]
    fn curvature_of_a_paraboloid() {
        let curvature = paraboloid(0.8, 0.3, -0.5).derivatives(0.5, 0.5).curvature().unwrap();
        // At the apex the second fundamental form is the Hessian. A few roundings of numbers below 1.
        assert!((curvature.mean - 0.15).abs() < 1e-13, "{curvature:?}");
        assert!((curvature.gaussian - (-0.4 - 0.09)).abs() < 1e-13, "{curvature:?}");
        assert!(curvature.dndu.distance(DVec3::new(-0.8, -0.3, 0.0)) < 1e-13, "{curvature:?}");
        assert!(curvature.dndv.distance(DVec3::new(-0.3, 0.5, 0.0)) < 1e-13, "{curvature:?}");
    }

    #[test]
    fn the_normal_changes_as_weingarten_says() {
        let net = paraboloid(1.3, -0.7, 0.9).map(|p| DVec3::new(p.x + 0.2 * p.y, p.y - 0.4 * p.z, p.z + 0.1 * p.x));
        let normal = |u: f64, v: f64| {
            let d = net.derivatives(u, v);
            d.dpdu.cross(d.dpdv).normalize()
        };
        // Central differences with step h: third derivatives below 50 make 50 h^2 / 6, rounding 1e-15 / h.
        let h = 1e-4;
        let curvature = net.derivatives(0.3, 0.8).curvature().unwrap();
        assert!(curvature.dndu.distance((normal(0.3 + h, 0.8) - normal(0.3 - h, 0.8)) / (2.0 * h)) < 1e-6);
        assert!(curvature.dndv.distance((normal(0.3, 0.8 + h) - normal(0.3, 0.8 - h)) / (2.0 * h)) < 1e-6);
    }

    #[test]
    fn areas() {
        let flat = paraboloid(0.0, 0.0, 0.0).map(|p| DVec3::new(3.0 * p.x + p.y, 2.0 * p.y, p.x));
        // The parallelogram of (3, 0, 1) and (1, 2, 0).
        assert!((flat.area() - DVec3::new(3.0, 0.0, 1.0).cross(DVec3::new(1.0, 2.0, 0.0)).length()).abs() < 1e-12);
        // z = x^2 / 2 over the unit square: the length of the parabola, the integral of sqrt(1 + x^2) from -1/2 to 1/2.
        let length = 0.5 * 1.25f64.sqrt() + 0.5f64.asinh();
        assert!((paraboloid(1.0, 0.0, 0.0).area() - length).abs() < 1e-10);
    }
}
