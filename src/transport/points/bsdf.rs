//! Scattering functions at one point. All directions point away from the surface.

use crate::math::{OrthonormalBasis, Rgb, warp};
use crate::world::{Lobe, Scattering};
use glam::{DVec2, DVec3, Vec3};
use std::f64::consts::{PI, TAU};

/// How a smooth dielectric interface divides unpolarised light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fresnel {
    /// Fraction of the light that is reflected, 0 to 1.
    pub reflectance: f64,
    /// Cosine between the refracted direction and the normal behind the interface; 0 at total reflection.
    pub cos_transmitted: f64,
}

/// Fresnel's equations for light that arrives at the angle with this cosine (0 to 1); `eta` is the index of refraction behind the
/// interface over the index in front of it.
#[inline]
pub fn fresnel(cos: f64, eta: f64) -> Fresnel {
    let cos = cos.clamp(0.0, 1.0);
    if eta == 1.0 {
        return Fresnel { reflectance: 0.0, cos_transmitted: cos };
    }
    let sin2_transmitted = (1.0 - cos * cos) / (eta * eta);
    if sin2_transmitted >= 1.0 {
        return Fresnel { reflectance: 1.0, cos_transmitted: 0.0 };
    }
    let cos_transmitted = (1.0 - sin2_transmitted).sqrt();
    let parallel = (eta * cos - cos_transmitted) / (eta * cos + cos_transmitted);
    let perpendicular = (cos - eta * cos_transmitted) / (cos + eta * cos_transmitted);
    Fresnel { reflectance: 0.5 * (parallel * parallel + perpendicular * perpendicular), cos_transmitted }
}

/// The mirror image of `wo` about a unit normal, of unit length.
#[inline]
pub(in crate::transport) fn reflect(wo: DVec3, normal: DVec3) -> DVec3 {
    2.0 * wo.dot(normal) * normal - wo
}

/// The refracted direction, of unit length, for `wo` on the side of the normal.
#[inline]
pub(in crate::transport) fn refract(wo: DVec3, normal: DVec3, eta: f64, cos_transmitted: f64) -> DVec3 {
    let cos = wo.dot(normal);
    ((cos / eta - cos_transmitted) * normal - wo / eta).normalize()
}

/// Cosine to the surface's normal that a direction bent back above the surface gains, so that a tangential direction leaves the surface.
const LEAST_COS: f64 = 1e-6;

/// The mirror image of `wo` about a shading normal, bent back to the side of `n_side` where the shading normal would send it into
/// the surface.
#[inline]
pub(in crate::transport) fn reflect_above(wo: DVec3, n_shade: DVec3, n_side: DVec3) -> DVec3 {
    bent_to(n_side, reflect(wo, n_shade))
}

/// The refracted direction for a shading normal, bent behind the surface where the shading normal would send it before it.
#[inline]
pub(in crate::transport) fn refract_below(
    wo: DVec3,
    n_shade: DVec3,
    n_side: DVec3,
    eta: f64,
    cos_transmitted: f64,
) -> DVec3 {
    bent_to(-n_side, refract(wo, n_shade, eta, cos_transmitted))
}

/// A unit direction, mirrored at the surface where it is not on the side of this geometric normal.
#[inline]
fn bent_to(n_side: DVec3, direction: DVec3) -> DVec3 {
    let height = direction.dot(n_side);
    if height > 0.0 { direction } else { (direction - (2.0 * height - LEAST_COS) * n_side).normalize() }
}

/// The diffuse term of the scattering function, `albedo / pi`, per steradian.
#[inline]
pub(in crate::transport) fn eval_diffuse(scattering: &Scattering) -> Rgb {
    scattering.albedo * (1.0 / PI) as f32
}

/// The Phong lobe of the scattering function for two directions, per steradian:
/// `specular (n + 2) / 2 pi cos^n` of the angle to the mirror direction \[LafortuneWillems94\].
#[inline]
pub(in crate::transport) fn eval_glossy(scattering: &Scattering, n_shade: DVec3, wo: DVec3, wi: DVec3) -> Rgb {
    let Lobe::Phong { specular, exponent } = scattering.lobe else { return Rgb::ZERO };
    let cos = reflect(wo, n_shade).dot(wi);
    if cos > 0.0 { specular * ((exponent + 2.0) / TAU * cos.powf(exponent)) as f32 } else { Rgb::ZERO }
}

/// The Phong lobe for one `wo` and many `wi`, in single precision: the relative error is 1e-7 times the exponent.
#[derive(Clone, Copy)]
pub(in crate::transport) struct GlossyLobe {
    /// Value in the mirror direction, per steradian.
    peak: Rgb,
    exponent: f32,
    mirrored: Vec3,
}

impl GlossyLobe {
    /// The lobe for `wo`; `None` where the surface has none.
    pub(in crate::transport) fn new(scattering: &Scattering, n_shade: Vec3, wo: Vec3) -> Option<Self> {
        let Lobe::Phong { specular, exponent } = scattering.lobe else { return None };
        let mirrored = reflect(wo.as_dvec3(), n_shade.as_dvec3()).as_vec3();
        let peak = specular * ((exponent + 2.0) / TAU) as f32;
        Some(Self { peak, exponent: exponent as f32, mirrored })
    }

    /// The value for `wi`, per steradian: see [`eval_glossy`].
    #[inline]
    pub(in crate::transport) fn eval(&self, wi: Vec3) -> Rgb {
        let cos = self.mirrored.dot(wi).min(1.0);
        if cos > 0.0 { self.peak * cos.powf(self.exponent) } else { Rgb::ZERO }
    }
}

/// The scattering function for two directions, per steradian, without mirrors and glass.
pub(in crate::transport) fn eval(scattering: &Scattering, n_shade: DVec3, wo: DVec3, wi: DVec3) -> Rgb {
    eval_diffuse(scattering) + eval_glossy(scattering, n_shade, wo, wi)
}

/// Density with which [`sample_glossy`] chooses `wi`, per steradian.
#[inline]
pub(in crate::transport) fn pdf_glossy(scattering: &Scattering, n_shade: DVec3, wo: DVec3, wi: DVec3) -> f64 {
    let Lobe::Phong { exponent, .. } = scattering.lobe else { return 0.0 };
    warp::pdf_cosine_power(reflect(wo, n_shade).dot(wi), exponent)
}

/// Samples a direction `wi` of the Phong lobe; returns it with the weight `f cos / pdf`. `None` where the surface has no lobe, and
/// for samples below the surface.
#[inline]
pub(in crate::transport) fn sample_glossy(
    scattering: &Scattering,
    n_shade: DVec3,
    n_side: DVec3,
    wo: DVec3,
    u: DVec2,
) -> Option<(DVec3, Rgb)> {
    let Lobe::Phong { specular, exponent } = scattering.lobe else { return None };
    let axis = OrthonormalBasis::from_normal(reflect(wo, n_shade));
    let wi = axis.world_from_local(warp::cosine_power(u, exponent));
    let cos = wi.dot(n_shade);
    let weight = specular * ((exponent + 2.0) / (exponent + 1.0) * cos) as f32;
    (cos > 0.0 && wi.dot(n_side) > 0.0 && weight.max_element() > 0.0).then_some((wi, weight))
}

/// The albedo of the Phong lobe in a direction that [`sample_glossy`] samples, over the lobe's greatest albedo: `f cos / pdf` over `specular`.
#[inline]
pub(in crate::transport) fn glossy_fraction(scattering: &Scattering, n_shade: DVec3, wi: DVec3) -> f64 {
    let Lobe::Phong { exponent, .. } = scattering.lobe else { return 0.0 };
    (exponent + 2.0) / (exponent + 1.0) * wi.dot(n_shade)
}

/// Greatest correction for shading normals: only grazing directions exceed it, and would make single photons too bright.
pub(in crate::transport) const MAX_SHADING_FACTOR: f64 = 8.0;

/// The correction for shading normals of light that travels from a light: `|cos_i'| |cos_o| / (|cos_i| |cos_o'|)`,
/// shading cosines primed \[Veach97, 5.3.2\]; 0 where a direction is on different sides of the two normals.
#[inline]
pub(in crate::transport) fn shading_factor(wi: DVec3, wo: DVec3, n_side: DVec3, n_shade: DVec3) -> f64 {
    if n_side == n_shade {
        return 1.0;
    }
    let (i_geom, o_geom, i_shade, o_shade) = (wi.dot(n_side), wo.dot(n_side), wi.dot(n_shade), wo.dot(n_shade));
    if i_geom <= 0.0 || o_geom <= 0.0 || i_shade <= 0.0 || o_shade <= 0.0 {
        return 0.0;
    }
    (i_shade * o_geom / (i_geom * o_shade)).min(MAX_SHADING_FACTOR)
}

/// [`shading_factor`] for diffuse reflection into a direction that is sampled by its cosine to the geometric normal: `|cos_i'| / |cos_i|`,
/// for all directions on the geometric side, because camera paths see diffuse light from all of them.
#[inline]
pub(in crate::transport) fn diffuse_shading_factor(wi: DVec3, n_side: DVec3, n_shade: DVec3) -> f64 {
    if n_side == n_shade {
        return 1.0;
    }
    let (i_geom, i_shade) = (wi.dot(n_side), wi.dot(n_shade));
    if i_geom > 0.0 && i_shade > 0.0 { (i_shade / i_geom).min(MAX_SHADING_FACTOR) } else { 0.0 }
}

/// Whether a surface scatters light diffusely or in a Phong lobe, besides mirrors and glass.
#[inline]
pub(in crate::transport) fn scatters(scattering: &Scattering) -> bool {
    scattering.albedo != Rgb::ZERO || matches!(scattering.lobe, Lobe::Phong { .. })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::chi_square::assert_has_density;
    use crate::math::{Sampler, octahedral};

    #[test]
    fn fresnel_known_angles() {
        assert!((fresnel(1.0, 1.5).reflectance - 0.04).abs() < 1e-15, "normal incidence");
        let brewster = fresnel(1.5f64.atan().cos(), 1.5);
        let perpendicular_only = 0.5 * ((1.5f64 * 1.5 - 1.0) / (1.5 * 1.5 + 1.0)).powi(2);
        assert!((brewster.reflectance - perpendicular_only).abs() < 1e-15, "no parallel part at Brewster's angle");
        let critical = (1.0f64 / 1.5).asin();
        assert_eq!(fresnel((critical + 1e-7).cos(), 1.0 / 1.5).reflectance, 1.0, "beyond the critical angle");
        assert!(fresnel((critical - 1e-7).cos(), 1.0 / 1.5).reflectance < 1.0, "before the critical angle");
        assert_eq!(fresnel(0.3, 1.0).reflectance, 0.0, "equal media are invisible");
        assert_eq!(fresnel(0.0, 1.5).reflectance, 1.0, "a grazing ray is reflected");
    }

    #[test]
    fn refraction_obeys_snell_and_reverses() {
        let normal = DVec3::Z;
        for degrees in [0.0f64, 10.0, 40.0, 80.0, 89.99] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let wo = DVec3::new(sin, 0.0, cos);
            let there = fresnel(cos, 1.33);
            let wi = refract(wo, normal, 1.33, there.cos_transmitted);
            assert!((1.33 * wi.x + sin).abs() < 1e-12, "Snell's law at {degrees} degrees");
            let back = fresnel(-wi.z, 1.0 / 1.33);
            // At a grazing angle the cosine of 1.7e-4 keeps 12 of 16 digits.
            assert!((back.reflectance - there.reflectance).abs() < 1e-10, "the same from both sides");
            assert!(refract(wi, -normal, 1.0 / 1.33, back.cos_transmitted).distance(wo) < 1e-7, "reversible");
        }
    }

    #[test]
    fn a_phong_lobe_reflects_its_albedo() {
        // Straight down the lobe is symmetric: its albedo is (n + 2) / (n + 1) * E[cos] = 1.
        let lobe = Lobe::Phong { specular: Rgb::ONE, exponent: 20.0 };
        let scattering = Scattering { albedo: Rgb::ZERO, lobe };
        let mean: f64 = (0..64 * 64)
            .map(|k| DVec2::new(f64::from(k % 64) + 0.5, f64::from(k / 64) + 0.5) / 64.0)
            .filter_map(|u| sample_glossy(&scattering, DVec3::Z, DVec3::Z, DVec3::Z, u))
            .map(|(wi, weight)| {
                let ratio = eval_glossy(&scattering, DVec3::Z, DVec3::Z, wi).x as f64 * wi.z
                    / pdf_glossy(&scattering, DVec3::Z, DVec3::Z, wi);
                assert!((ratio - f64::from(weight.x)).abs() < 1e-6, "weight is f cos / pdf");
                f64::from(weight.x) / (64.0 * 64.0)
            })
            .sum();
        assert!((mean - 1.0).abs() < 1e-3, "{mean}");
    }

    /// The Phong lobe about an axis off the normal, on a surface with relief: samples below the surface are left out.
    #[test]
    fn samples_of_the_lobe_have_their_density() {
        let (n_side, n_shade) = (DVec3::Z, DVec3::new(0.2, -0.1, 1.0).normalize());
        for (exponent, wo, n_shade) in [
            (4.0, DVec3::Z, n_side),
            (4.0, DVec3::new(0.9, 0.1, 0.3).normalize(), n_side),
            (30.0, DVec3::new(-0.5, 0.8, 0.25).normalize(), n_shade),
            (0.0, DVec3::new(0.3, 0.8, 0.5).normalize(), n_shade),
        ] {
            let lobe = Lobe::Phong { specular: Rgb::new(0.2, 0.6, 0.4), exponent };
            let scattering = Scattering { albedo: Rgb::ZERO, lobe };
            let pdf = |wi| pdf_glossy(&scattering, n_shade, wo, wi);
            let sample = |sampler: &mut Sampler| {
                let (wi, weight) = sample_glossy(&scattering, n_shade, n_side, wo, sampler.next_2d())?;
                let expected = eval_glossy(&scattering, n_shade, wo, wi) * (wi.dot(n_shade) / pdf(wi)) as f32;
                assert!((weight - expected).length() < 1e-5, "the weight is f cos / pdf");
                Some(octahedral::square_from_direction(wi))
            };
            let density = |square| {
                let wi = octahedral::direction_from_square(square);
                let is_above = wi.dot(n_side) > 0.0 && wi.dot(n_shade) > 0.0;
                if is_above { 4.0 * PI * pdf(wi) } else { 0.0 }
            };
            assert_has_density(&format!("exponent {exponent}"), sample, density);
        }
    }

    #[test]
    fn the_lobe_for_many_directions_is_the_same() {
        let (n_shade, wo) = (Vec3::Z, Vec3::new(0.6, 0.0, 0.8));
        for exponent in [0.0, 1.0, 7.5, 300.0] {
            let lobe = Lobe::Phong { specular: Rgb::new(1.0, 0.5, 0.0), exponent };
            let scattering = Scattering { albedo: Rgb::ONE, lobe };
            let many = GlossyLobe::new(&scattering, n_shade, wo).expect("there is a lobe");
            for k in 0..1000 {
                let wi = DVec3::new(-0.6, 0.0, 0.8) + 1e-6 * f64::from(k).powi(2) * DVec3::new(0.3, -0.2, -0.7);
                let wi = wi.normalize();
                let one = eval_glossy(&scattering, n_shade.as_dvec3(), wo.as_dvec3(), wi);
                let least = 1e-4 * many.peak.max_element();
                assert!((many.eval(wi.as_vec3()) - one).abs().max_element() < least, "{exponent} {wi}");
            }
        }
        let none = Scattering { albedo: Rgb::ONE, lobe: Lobe::None };
        assert!(GlossyLobe::new(&none, n_shade, wo).is_none());
    }
}
