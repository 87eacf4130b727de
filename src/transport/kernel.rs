//! The kernel of the density estimate and its integral over the part of the disc that the surface fills.

use glam::DVec2;
use std::f64::consts::FRAC_PI_2;

/// Integral of the Epanechnikov kernel `1 - d^2 / r^2` over the whole disc of radius r.
pub(super) fn full_integral(radius: f64) -> f64 {
    FRAC_PI_2 * radius * radius
}

/// A straight piece of a surface's rim in the tangent plane, the query point at the origin.
type Edge = (DVec2, DVec2);

/// Integral of `1 - d^2 / r^2` over the part of the disc of radius r about the origin inside a parallelogram with the
/// corners `a, a + u, a + u + v, a + v`, which holds the origin or nearly so. Sides marked in `open` (in the order v = 0,
/// u = 1, v = 1, u = 0) are no rim: there the surface goes on.
///
/// The integral over a polygon is the sum over its sides of the signed integral over the triangle from the origin to
/// the side. In polar coordinates the kernel integrates to `R^2 / 2 - R^4 / 4 r^2` along a radius of length R, and R is
/// `h / cos` along a side at distance h, which has a closed form in the tangent.
pub(super) fn clipped_integral(a: DVec2, u: DVec2, v: DVec2, open: [bool; 4], radius: f64) -> f64 {
    let turn = u.perp_dot(v).signum();
    let far = 2.0 * radius;
    let sides: [Edge; 4] = [(a, u), (a + u, v), (a + u + v, -u), (a + v, -v)];
    let inner_distance = |(start, along): Edge| turn * along.perp_dot(-start) / along.length();
    let clips = |side: usize| !open[side] && inner_distance(sides[side]) < radius;
    if !(0..4).any(clips) {
        return full_integral(radius);
    }
    // Sides that do not clip move out to where they are not felt, which keeps the sum over a closed polygon.
    let distance = |side: usize| if clips(side) { inner_distance(sides[side]) } else { far };
    let outward = |side: usize| -turn * sides[side].1.perp().normalize_or_zero();
    let corner =
        |first: usize, second: usize| intersection(outward(first), distance(first), outward(second), distance(second));
    let corners = [corner(3, 0), corner(0, 1), corner(1, 2), corner(2, 3)];
    let sum: f64 = (0..4).map(|k| sector_integral(corners[k], corners[(k + 1) % 4], radius)).sum();
    // Never less than what a corner keeps, so that a query a rounding outside the surface divides by no zero.
    (turn * sum).clamp(0.02 * full_integral(radius), full_integral(radius))
}

/// The point at these distances from the origin along two unit vectors.
fn intersection(n0: DVec2, d0: f64, n1: DVec2, d1: f64) -> DVec2 {
    (d1 * n0.perp() - d0 * n1.perp()) / n0.perp_dot(n1)
}

/// Signed integral of the kernel over the disc's part of the triangle (origin, p, q).
fn sector_integral(p: DVec2, q: DVec2, radius: f64) -> f64 {
    let along = (q - p).normalize_or_zero();
    let h = p.perp_dot(along).abs();
    let (s0, s1) = (p.dot(along), q.dot(along));
    let sign = p.perp_dot(q).signum();
    // Of the side, [s0, s1] in its own coordinate, the part within +-half lies in the disc; the rest is arc.
    let half = (radius * radius - h * h).max(0.0).sqrt();
    let (c0, c1) = (s0.clamp(-half, half), s1.clamp(-half, half));
    let angle = |s: f64| s.atan2(h);
    let arc = (angle(s1) - angle(s0)) - (angle(c1) - angle(c0));
    let r2 = radius * radius;
    // h^2/2 tan - h^4/(4 r^2) (tan + tan^3 / 3), with tan = s / h.
    let chord = |s: f64| 0.5 * h * s - (h * h * h * s + h * s * s * s / 3.0) / (4.0 * r2);
    sign * (arc * 0.25 * r2 + chord(c1) - chord(c0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn by_summation(a: DVec2, u: DVec2, v: DVec2, radius: f64) -> f64 {
        let n = 1000;
        let cell = 2.0 * radius / f64::from(n);
        let mut sum = 0.0;
        for k in 0..n * n {
            let p = DVec2::new(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5) * cell - radius;
            let (x, y) = ((p - a).perp_dot(v) / u.perp_dot(v), (p - a).perp_dot(u) / v.perp_dot(u));
            if (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y) {
                sum += (1.0 - p.length_squared() / (radius * radius)).max(0.0) * cell * cell;
            }
        }
        sum
    }

    #[test]
    fn matches_summation_on_rims_and_corners() {
        let cases = [
            (DVec2::new(-0.1, -5.0), DVec2::new(9.0, 0.0), DVec2::new(0.0, 9.0)),
            (DVec2::new(-0.1, -0.3), DVec2::new(9.0, 0.0), DVec2::new(0.0, 9.0)),
            (DVec2::new(-0.2, -0.3), DVec2::new(0.5, 0.1), DVec2::new(0.1, 0.6)),
            (DVec2::new(-0.2, -0.3), DVec2::new(0.1, 0.6), DVec2::new(0.5, 0.1)),
            (DVec2::new(-2.2, -0.3), DVec2::new(4.0, 0.5), DVec2::new(1.5, 4.0)),
        ];
        for (a, u, v) in cases {
            let exact = clipped_integral(a, u, v, [false; 4], 1.0);
            let summed = by_summation(a, u, v, 1.0);
            // Cells of 2e-3 along a rim of length 2 with a kernel of at most 1: some 2e-3 * 2 * 0.5 at worst.
            assert!((exact - summed).abs() < 2e-3, "{exact} against {summed} at {a}");
        }
    }

    #[test]
    fn open_sides_do_not_clip() {
        let (a, u, v) = (DVec2::new(-0.1, -5.0), DVec2::new(9.0, 0.0), DVec2::new(0.0, 9.0));
        assert_eq!(clipped_integral(a, u, v, [false, false, false, true], 1.0), full_integral(1.0));
        assert!(clipped_integral(a, u, v, [true, true, true, false], 1.0) < 0.6 * full_integral(1.0));
    }
}
