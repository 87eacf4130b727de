//! Warps from the unit square to discs and unit directions, with their densities.

use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// A point in the unit disc, uniform by area, by the concentric map \[ShirleyChiu97\].
pub fn concentric_disc(u: DVec2) -> DVec2 {
    let offset = 2.0 * u - 1.0;
    if offset == DVec2::ZERO {
        return DVec2::ZERO;
    }
    let (radius, angle) = if offset.x.abs() > offset.y.abs() {
        (offset.x, FRAC_PI_4 * (offset.y / offset.x))
    } else {
        (offset.y, FRAC_PI_2 - FRAC_PI_4 * (offset.x / offset.y))
    };
    radius * DVec2::from_angle(angle)
}

/// A direction around +z with density `cos / pi` per steradian.
pub fn cosine_hemisphere(u: DVec2) -> DVec3 {
    let disc = concentric_disc(u);
    disc.extend((1.0 - disc.length_squared()).max(0.0).sqrt())
}

/// A point in the unit ball with density `1 / (pi^2 sqrt(1 - r^2))`: along every direction its points cover the ball's disc evenly. It is an
/// even point of the unit sphere in four dimensions \[Shoemake92\], without the fourth coordinate.
pub fn ball_of_even_discs(u: DVec2, v: f64) -> DVec3 {
    let (first, second) = ((1.0 - u.x).max(0.0).sqrt(), u.x.max(0.0).sqrt());
    (first * DVec2::from_angle(TAU * u.y)).extend(second * (TAU * v).cos())
}

/// A direction with density `1 / (4 pi)` per steradian.
pub fn uniform_sphere(u: DVec2) -> DVec3 {
    let z = 1.0 - 2.0 * u.x;
    ((1.0 - z * z).max(0.0).sqrt() * DVec2::from_angle(TAU * u.y)).extend(z)
}

/// A direction around +z with density `(exponent + 1) / (2 pi) * cos^exponent` per steradian: the Phong lobe.
pub fn cosine_power(u: DVec2, exponent: f64) -> DVec3 {
    let z = (1.0 - u.x).powf(1.0 / (exponent + 1.0));
    ((1.0 - z * z).max(0.0).sqrt() * DVec2::from_angle(TAU * u.y)).extend(z)
}

/// The density of [`cosine_power`] at an angle with this cosine, per steradian.
pub fn pdf_cosine_power(cos: f64, exponent: f64) -> f64 {
    if cos > 0.0 { (exponent + 1.0) / TAU * cos.powf(exponent) } else { 0.0 }
}

/// A direction around +z, uniform in the cone with half angle a where `1 - cos a = one_minus_cos`, which is exact for thin
/// cones too.
pub fn uniform_cone(u: DVec2, one_minus_cos: f64) -> DVec3 {
    let rise = u.x * one_minus_cos;
    let sin = (rise * (2.0 - rise)).max(0.0).sqrt();
    (sin * DVec2::from_angle(TAU * u.y)).extend(1.0 - rise)
}

/// The density of [`uniform_cone`] inside the cone, per steradian.
pub fn pdf_uniform_cone(one_minus_cos: f64) -> f64 {
    1.0 / (2.0 * PI * one_minus_cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::math::Sampler;
    use crate::math::chi_square::{assert_has_density, cap_direction, cap_solid_angle, cap_square};

    /// A warp around +z against its density per steradian, in the cap of directions with at least this z.
    fn assert_warps(what: &str, least_z: f64, warp: impl Fn(DVec2) -> DVec3, pdf: impl Fn(DVec3) -> f64) {
        let sample = |sampler: &mut Sampler| cap_square(warp(sampler.next_2d()), least_z);
        let density = |square| cap_solid_angle(least_z) * pdf(cap_direction(square, least_z));
        assert_has_density(what, sample, density);
    }

    #[test]
    fn samples_have_their_densities() {
        assert_warps("hemisphere", 0.0, cosine_hemisphere, |d| d.z / PI);
        assert_warps("sphere", -1.0, uniform_sphere, |_| 0.25 / PI);
        for (exponent, least_z) in [(0.0, 0.0), (1.0, 0.0), (5.5, 0.0), (300.0, 0.97)] {
            let warp = |u| cosine_power(u, exponent);
            assert_warps("Phong lobe", least_z, warp, |d| pdf_cosine_power(d.z, exponent));
        }
        // All of a cone, and its inner half, which leaves draws outside.
        for (one_minus_cos, shown) in [(0.4, 1.0), (1e-3, 1.0), (0.4, 0.5)] {
            let warp = |u| uniform_cone(u, one_minus_cos);
            assert_warps("cone", 1.0 - shown * one_minus_cos, warp, |_| pdf_uniform_cone(one_minus_cos));
        }
        let in_square = |sampler: &mut Sampler| Some(0.5 * (concentric_disc(sampler.next_2d()) + 1.0));
        let disc = |p: DVec2| if (2.0 * p - 1.0).length() <= 1.0 { 4.0 / PI } else { 0.0 };
        assert_has_density("disc", in_square, disc);
        let axes = [DVec3::X, DVec3::new(0.0, 0.6, 0.8)];
        let across = |sampler: &mut Sampler| {
            let point = ball_of_even_discs(sampler.next_2d(), sampler.next_1d());
            Some(0.5 * (DVec2::from(axes.map(|axis| axis.dot(point))) + 1.0))
        };
        assert_has_density("ball", across, disc);
    }

    fn grid() -> impl Iterator<Item = DVec2> {
        (0..128 * 128).map(|k| DVec2::new(f64::from(k % 128) + 0.5, f64::from(k / 128) + 0.5) / 128.0)
    }

    #[test]
    fn means_match_the_densities() {
        let mean = |f: &dyn Fn(DVec2) -> f64| grid().map(f).sum::<f64>() / (128.0 * 128.0);
        // Moments of each density whose integrand is smooth: the midpoint rule on 128 x 128 cells errs by some 1e-5.
        assert!((mean(&|u| cosine_hemisphere(u).z.powi(2)) - 0.5).abs() < 1e-4, "cosine");
        assert!(mean(&|u| uniform_sphere(u).z).abs() < 1e-9, "sphere");
        assert!((mean(&|u| cosine_power(u, 10.0).z.powi(11)) - 0.5).abs() < 1e-9, "power");
        assert!((mean(&|u| uniform_cone(u, 0.25).z) - 0.875).abs() < 1e-9, "cone");
        for u in grid() {
            for d in [cosine_hemisphere(u), uniform_sphere(u), cosine_power(u, 3.0), uniform_cone(u, 1e-12)] {
                assert!((d.length() - 1.0).abs() < 1e-12, "unit length at {u}");
            }
        }
    }
}
