//! Paths as they leave a light.

use crate::math::{OrthonormalBasis, Rgb, Sampler, octahedral, warp};
use crate::world::Light;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// The first ray of a light path.
#[derive(Clone, Copy, Debug)]
pub(in crate::transport) struct Emission {
    /// Point on the light.
    pub(in crate::transport) origin: DVec3,
    /// Unit length.
    pub(in crate::transport) direction: DVec3,
    /// Radiance (intensity of a point light) times the cosine over the density of the sample: the flux, W, if this were the only path.
    pub(in crate::transport) flux: Rgb,
}

/// A sampled point of a light.
pub(super) struct Origin {
    pub(super) position: DVec3,
    /// Unit normal of the light's surface; `None` for a point light.
    pub(super) normal: Option<DVec3>,
    /// Intensity of a point light; radiance of an area light over the density of the point.
    pub(super) strength: Rgb,
}

/// Samples a point of a light, evenly over its area. Only area lights draw numbers.
#[inline]
pub(super) fn sample_origin(light: &Light, sampler: &mut Sampler) -> Origin {
    match light {
        Light::Point { position, intensity } => Origin { position: *position, normal: None, strength: *intensity },
        Light::Sphere { sphere, radiance } => {
            let normal = octahedral::direction_from_square(sampler.next_2d());
            let area = 4.0 * PI * sphere.radius * sphere.radius;
            let position = sphere.center + sphere.radius * normal;
            Origin { position, normal: Some(normal), strength: *radiance * area as f32 }
        }
        Light::Quad { quad, radiance } => {
            let DVec2 { x, y } = sampler.next_2d();
            Origin {
                position: quad.position(x, y),
                normal: Some(quad.normal()),
                strength: *radiance * quad.area() as f32,
            }
        }
    }
}

/// Samples the first ray of a path in proportion to the light's emission.
#[inline]
pub(in crate::transport) fn emit(light: &Light, sampler: &mut Sampler) -> Emission {
    let Origin { position, normal, strength } = sample_origin(light, sampler);
    let u = sampler.next_2d();
    match normal {
        None => {
            let direction = octahedral::direction_from_square(u);
            Emission { origin: position, direction, flux: strength * (4.0 * PI) as f32 }
        }
        Some(normal) => {
            let direction = OrthonormalBasis::from_normal(normal).world_from_local(warp::cosine_hemisphere(u));
            Emission { origin: position, direction, flux: strength * PI as f32 }
        }
    }
}

/// Density of the paths of [`emit`] that leave this point of a light, per area across them at `point`, scene units.
#[inline]
pub(in crate::transport) fn density(light: &Light, light_point: DVec3, point: DVec3) -> f64 {
    let offset = point - light_point;
    let distance_squared = offset.length_squared();
    let along = |normal: DVec3| normal.dot(offset).max(0.0) / distance_squared.sqrt();
    let per_steradian = match light {
        Light::Point { .. } => 0.25 / PI,
        Light::Sphere { sphere, .. } => along((light_point - sphere.center) / sphere.radius) / PI,
        Light::Quad { quad, .. } => along(quad.normal()) / PI,
    };
    per_steradian / distance_squared
}
