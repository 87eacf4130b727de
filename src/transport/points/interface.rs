//! Directions of light at a smooth interface with a shading normal.

use super::bsdf::{self, Fresnel, fresnel};
use glam::DVec3;

/// How an interface divides light.
///
/// A shading normal may send light into glass, or on in glass, at angles to the geometric surface at which the surface totally reflects. In a
/// ball such light comes back at the same angle for ever, so that relief would swallow it. Therefore light that could leave glass by the
/// geometric normal keeps an angle at which it can: where the shading normal would spoil that, the geometric normal replaces it.
pub(super) struct Interface {
    /// Fraction of the light that is reflected, 0 to 1.
    pub(super) reflectance: f64,
    /// The reflected direction, unit length.
    pub(super) reflected: DVec3,
    /// The refracted direction, unit length; `None` at total reflection.
    pub(super) refracted: Option<DVec3>,
}

impl Interface {
    /// The directions of light that comes from `wo`, for a shading and a geometric normal on that side and the ratio `eta` of the indices of
    /// refraction behind and before the surface.
    #[inline]
    pub(super) fn new(wo: DVec3, n_shade: DVec3, n_side: DVec3, eta: f64) -> Self {
        let by_shading = fresnel(wo.dot(n_shade), eta);
        if n_shade == n_side {
            return Self::by(wo, n_shade, n_side, eta, by_shading);
        }
        // Whether light in the denser medium can leave through the geometric surface.
        let sine_squared = eta.min(1.0 / eta).powi(2);
        let can_leave = |direction: DVec3| 1.0 - direction.dot(n_side).powi(2) < sine_squared;
        let by_geometry = || Self::by(wo, n_side, n_side, eta, fresnel(wo.dot(n_side), eta));
        let is_inside = eta < 1.0;
        if is_inside && !can_leave(wo) {
            return Self::by(wo, n_shade, n_side, eta, by_shading);
        }
        if is_inside && by_shading.reflectance >= 1.0 {
            return by_geometry();
        }
        let mut found = Self::by(wo, n_shade, n_side, eta, by_shading);
        if is_inside && !can_leave(found.reflected) {
            found.reflected = bsdf::reflect(wo, n_side);
        } else if !is_inside && found.refracted.is_some_and(|refracted| !can_leave(refracted)) {
            found.refracted = by_geometry().refracted;
        }
        found
    }

    #[inline]
    fn by(wo: DVec3, normal: DVec3, n_side: DVec3, eta: f64, fresnel: Fresnel) -> Self {
        let refracted = || bsdf::refract_below(wo, normal, n_side, eta, fresnel.cos_transmitted);
        Self {
            reflectance: fresnel.reflectance,
            reflected: bsdf::reflect_above(wo, normal, n_side),
            refracted: (fresnel.reflectance < 1.0).then(refracted),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, Stream, warp};

    /// Light that can leave glass by the geometric normal can still leave it after the event, in the glass and on its way into it.
    #[test]
    fn light_that_can_leave_glass_stays_so() {
        let n_side = DVec3::Z;
        for k in 0..20_000 {
            let mut sampler = Sampler::new(1, Stream::Camera, 0, k);
            let wo = warp::cosine_hemisphere(sampler.next_2d());
            let (tilt, index) = (sampler.next_2d(), 1.1 + sampler.next_1d());
            let n_shade = (n_side + 0.4 * (tilt.extend(0.5) - 0.5)).normalize();
            let can_leave = |direction: DVec3| 1.0 - direction.z * direction.z <= 1.0 / (index * index) + 1e-12;
            let into = Interface::new(wo, n_shade, n_side, index);
            assert!(into.reflected.z > 0.0 && (0.0..=1.0).contains(&into.reflectance));
            assert!(into.refracted.is_none_or(|direction| direction.z < 0.0 && can_leave(direction)), "{wo} {n_shade}");
            let out = Interface::new(wo, n_shade, n_side, 1.0 / index);
            assert!(out.reflected.z > 0.0 && out.refracted.is_none_or(|direction| direction.z < 0.0));
            assert_eq!(out.refracted.is_some(), out.reflectance < 1.0);
            if can_leave(wo) {
                assert!(out.refracted.is_some() && can_leave(out.reflected), "{wo} {n_shade}");
            }
        }
    }
}
