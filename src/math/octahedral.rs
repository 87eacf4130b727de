//! The equal-area octahedral map between the unit square and the sphere of directions \[Clarberg08\]: equal areas in the
//! square are equal solid angles, and the map is continuous and without poles.

use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_4;

/// The unit direction of a point in the unit square.
pub fn direction_from_square(p: DVec2) -> DVec3 {
    let p = 2.0 * p - 1.0;
    let a = p.abs();
    let signed_distance = 1.0 - (a.x + a.y);
    let d = signed_distance.abs();
    let r = 1.0 - d;
    let phi = if r == 0.0 { FRAC_PI_4 } else { ((a.y - a.x) / r + 1.0) * FRAC_PI_4 };
    let z = (1.0 - r * r).copysign(signed_distance);
    let (sin, cos) = phi.sin_cos();
    let in_plane = r * (2.0 - r * r).max(0.0).sqrt();
    DVec3::new((cos * in_plane).copysign(p.x), (sin * in_plane).copysign(p.y), z)
}

/// The point in the unit square of a unit direction: the inverse of [`direction_from_square`].
pub fn square_from_direction(d: DVec3) -> DVec2 {
    let a = d.abs();
    let r = (1.0 - a.z).max(0.0).sqrt();
    let phi = if a.x == 0.0 && a.y == 0.0 { 0.0 } else { a.y.atan2(a.x) / (2.0 * FRAC_PI_4) };
    let mut v = phi * r;
    let mut u = r - v;
    if d.z < 0.0 {
        (u, v) = (1.0 - v, 1.0 - u);
    }
    0.5 * (DVec2::new(u.copysign(d.x), v.copysign(d.y)) + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_maps_are_inverse_and_equal_area() {
        let n = 64;
        let mut mean = DVec3::ZERO;
        let mut second = 0.0;
        for k in 0..n * n {
            let p = DVec2::new(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5) / f64::from(n);
            let d = direction_from_square(p);
            assert!((d.length() - 1.0).abs() < 1e-12, "unit length at {p}");
            assert!(square_from_direction(d).distance(p) < 1e-9, "inverse at {p}");
            mean += d / f64::from(n * n);
            second += d.z * d.z / f64::from(n * n);
        }
        assert!(mean.length() < 1e-12 && (second - 1.0 / 3.0).abs() < 1e-3, "uniform: {mean} {second}");
    }
}
