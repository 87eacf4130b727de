//! Light that leaves a light.

use super::guide::Guide;
use crate::math::{OrthonormalBasis, Rgb, Sampler, octahedral, warp};
use crate::world::Light;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// A path's start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Emission {
    pub(super) origin: DVec3,
    /// Unit length.
    pub(super) direction: DVec3,
    /// All light that paths like this one stand for, W: radiance or intensity over the density of its choice.
    pub(super) flux: Rgb,
}

/// A point on a light's surface; for a point light, the point.
pub(super) struct Origin {
    pub(super) position: DVec3,
    /// `None` for a point light.
    pub(super) normal: Option<DVec3>,
    /// Intensity, or radiance over the density of the point.
    strength: Rgb,
}

/// The surface point of a light for two numbers in the unit square. Only area lights draw them.
pub(super) fn origin(light: &Light, sampler: &mut Sampler) -> Origin {
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

/// A path that leaves a light in any direction it shines to.
pub(super) fn emit(light: &Light, sampler: &mut Sampler) -> Emission {
    let Origin { position, normal, strength } = origin(light, sampler);
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

/// Density, per area across them, of the paths from a place on a light that [`emit`] sends through a point.
pub(super) fn density(light: &Light, place: DVec3, point: DVec3) -> f64 {
    let offset = point - place;
    let distance_squared = offset.length_squared();
    let along = |normal: DVec3| normal.dot(offset).max(0.0) / distance_squared.sqrt();
    let per_steradian = match light {
        Light::Point { .. } => 0.25 / PI,
        Light::Sphere { sphere, .. } => along((place - sphere.center) / sphere.radius) / PI,
        Light::Quad { quad, .. } => along(quad.normal()) / PI,
    };
    per_steradian / distance_squared
}

/// A path that leaves a light in a direction from the guide; `None` where the light does not shine there.
pub(super) fn emit_guided(light: &Light, guide: &Guide, sampler: &mut Sampler) -> Option<Emission> {
    let Origin { position, normal, strength } = origin(light, sampler);
    let (direction, pdf) = guide.sample(sampler.next_2d());
    let cos = normal.map_or(1.0, |n| n.dot(direction));
    (cos > 0.0).then(|| Emission { origin: position, direction, flux: strength * (cos / pdf) as f32 })
}
