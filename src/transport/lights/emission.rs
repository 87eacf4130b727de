//! Paths as they leave a light.

use crate::math::{OrthonormalBasis, Ray, Rgb, Sampler, octahedral, warp};
use crate::world::{Light, ParallelRays, World};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// A ray that leaves a point of the light with this index; the ray of a sun begins before every surface.
#[inline]
pub(in crate::transport) fn ray_from_light(world: &World, light: usize, origin: DVec3, direction: DVec3) -> Ray {
    if let Light::Parallel(rays) = &world.lights[light] {
        return Ray::new(rays.beginning(&world.aggregate, origin, direction), direction);
    }
    Ray { t_min: world.clearance_of_light(light, origin, direction), ..Ray::new(origin, direction) }
}

/// The first ray of a light path.
#[derive(Clone, Copy, Debug)]
pub(in crate::transport) struct Emission {
    /// Point on the light; of a sun, on its disc.
    pub(in crate::transport) origin: DVec3,
    /// Unit length.
    pub(in crate::transport) direction: DVec3,
    /// Radiance (intensity of a point light) times the cosine over the density of the sample: the flux, W, if this were the only path.
    pub(in crate::transport) flux: Rgb,
}

/// A sampled point of a light.
pub(super) struct Origin {
    pub(super) position: DVec3,
    /// Unit normal of the light's surface or of its disc; `None` for a point light.
    pub(super) normal: Option<DVec3>,
    /// Intensity of a point light; radiance of an area light, irradiance of parallel rays, over the density of the point.
    pub(super) strength: Rgb,
}

/// Samples a point of a light, evenly over its area. Only area lights draw numbers.
#[inline]
pub(super) fn sample_origin(light: &Light, sampler: &mut Sampler) -> Origin {
    origin_at(light, || sampler.next_2d())
}

/// The point of a light for a point of the unit square, which only area lights ask for: even over the light's area for even points.
#[inline]
pub(super) fn origin_at(light: &Light, square: impl FnOnce() -> DVec2) -> Origin {
    match light {
        Light::Point { position, intensity } => Origin { position: *position, normal: None, strength: *intensity },
        Light::Sphere { sphere, radiance } => {
            let normal = octahedral::direction_from_square(square());
            let area = 4.0 * PI * sphere.radius * sphere.radius;
            let position = sphere.center + sphere.radius * normal;
            Origin { position, normal: Some(normal), strength: *radiance * area as f32 }
        }
        Light::Quad { quad, radiance } => {
            let DVec2 { x, y } = square();
            Origin {
                position: quad.position(x, y),
                normal: Some(quad.normal()),
                strength: *radiance * quad.area() as f32,
            }
        }
        Light::Parallel(rays) => Origin {
            position: rays.point(warp::concentric_disc(square())),
            normal: Some(rays.direction),
            strength: rays.power(),
        },
    }
}

/// Factor from a density per etendue (steradians times square scene units) to the density in which paths are counted: for an area light per
/// steradian in this direction (unit length), of paths whose first points are even over the light; for parallel rays per area across them, of
/// paths whose directions are even over the cone. 0 where the light does not shine, and for lights without etendue.
#[inline]
pub(super) fn etendue_ratio(light: &Light, light_point: DVec3, direction: DVec3) -> f64 {
    match light {
        Light::Point { .. } => 0.0,
        Light::Sphere { sphere, .. } => {
            let cos = direction.dot(light_point - sphere.center) / sphere.radius;
            4.0 * PI * sphere.radius * sphere.radius * cos.max(0.0)
        }
        Light::Quad { quad, .. } => quad.area() * direction.dot(quad.normal()).max(0.0),
        Light::Parallel(rays) => 4.0 * PI * (0.5 * rays.half_angle).sin().powi(2),
    }
}

/// Radiance of a light with etendue, W/(sr m^2); of others 0.
pub(super) fn radiance(light: &Light) -> Rgb {
    match light {
        Light::Point { .. } => Rgb::ZERO,
        Light::Sphere { radiance, .. } | Light::Quad { radiance, .. } => *radiance,
        Light::Parallel(rays) if rays.half_angle == 0.0 => Rgb::ZERO,
        Light::Parallel(rays) => rays.irradiance / (PI * rays.half_angle.sin().powi(2)) as f32,
    }
}

/// Samples the first ray of a path in proportion to the light's emission.
#[inline]
pub(in crate::transport) fn emit(light: &Light, sampler: &mut Sampler) -> Emission {
    if let Light::Parallel(rays) = light {
        return emit_parallel(rays, warp::concentric_disc(sampler.next_2d()), 1.0 / rays.area(), sampler);
    }
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

/// The first ray of a path through a point of the disc of parallel rays, in coordinates along the axes of the disc, for a sample of this
/// density (per area).
#[inline]
pub(super) fn emit_parallel(rays: &ParallelRays, at: DVec2, density: f64, sampler: &mut Sampler) -> Emission {
    let (direction, irradiance) = rays.sample_direction(sampler);
    Emission { origin: rays.point(at), direction, flux: irradiance / density as f32 }
}

/// Density of the paths of [`emit`] that leave this point of a light, per area across them at `point`, scene units.
#[inline]
pub(in crate::transport) fn density(light: &Light, light_point: DVec3, point: DVec3) -> f64 {
    let offset = point - light_point;
    if let Light::Parallel(rays) = light {
        let direction = offset.normalize_or(rays.direction);
        let is_in = rays.crossing(point, direction).length_squared() <= 1.0;
        return if is_in { 1.0 / (rays.area() * direction.dot(rays.direction)) } else { 0.0 };
    }
    let distance_squared = offset.length_squared();
    let along = |normal: DVec3| normal.dot(offset).max(0.0) / distance_squared.sqrt();
    let per_steradian = match light {
        Light::Point { .. } => 0.25 / PI,
        Light::Sphere { sphere, .. } => along((light_point - sphere.center) / sphere.radius) / PI,
        Light::Quad { quad, .. } => along(quad.normal()) / PI,
        Light::Parallel(_) => 0.0,
    };
    per_steradian / distance_squared
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Quad, Sphere};
    use crate::math::chi_square::{assert_has_density, cap_direction, cap_solid_angle, cap_square};

    fn sphere() -> Light {
        Light::Sphere { sphere: Sphere { center: DVec3::new(1.0, 2.0, 3.0), radius: 0.5 }, radiance: Rgb::splat(2.0) }
    }

    fn quad() -> Light {
        let quad = Quad::new(DVec3::new(1.0, 0.0, 0.0), DVec3::new(0.0, 2.0, 0.5), DVec3::new(0.0, 1.0, 3.0));
        Light::Quad { quad, radiance: Rgb::new(1.0, 2.0, 3.0) }
    }

    /// Over the sphere of directions the paths of a point light have the density that [`density`] gives at distance 1.
    #[test]
    fn paths_leave_a_point_light_to_all_sides() {
        let position = DVec3::new(3.0, -1.0, 2.0);
        let light = Light::Point { position, intensity: Rgb::ONE };
        let sample = |sampler: &mut Sampler| {
            let emission = emit(&light, sampler);
            assert_eq!((emission.origin, emission.flux), (position, light.power()));
            Some(octahedral::square_from_direction(emission.direction))
        };
        let from_square = octahedral::direction_from_square;
        assert_has_density("point", sample, |p| 4.0 * PI * density(&light, position, position + from_square(p)));
    }

    /// Directions about the normal at the origin, against [`density`] at distance 2, where paths are four times as far from each other.
    #[test]
    fn paths_leave_area_lights_by_the_cosine() {
        for light in [sphere(), quad()] {
            let basis_at = |origin: DVec3| match &light {
                Light::Sphere { sphere, .. } => OrthonormalBasis::from_normal((origin - sphere.center).normalize()),
                Light::Quad { quad, .. } => OrthonormalBasis::from_normal(quad.normal()),
                Light::Point { .. } | Light::Parallel(_) => unreachable!("no area light"),
            };
            let sample = |sampler: &mut Sampler| {
                let Emission { origin, direction, flux } = emit(&light, sampler);
                assert!((flux - light.power()).length() < 1e-5 * flux.length(), "every path has all the power");
                let basis = basis_at(origin);
                let local = [basis.tangent, basis.bitangent, basis.normal].map(|axis| axis.dot(direction));
                cap_square(DVec3::from_array(local), 0.0)
            };
            let origin = match &light {
                Light::Sphere { sphere, .. } => sphere.center + sphere.radius * DVec3::Y,
                light => light.center(),
            };
            let pdf = |square| {
                let direction = basis_at(origin).world_from_local(cap_direction(square, 0.0));
                4.0 * density(&light, origin, origin + 2.0 * direction)
            };
            assert_has_density("area light", sample, |square| cap_solid_angle(0.0) * pdf(square));
        }
    }

    #[test]
    fn origins_are_even_over_the_area() {
        let Light::Sphere { sphere, .. } = sphere() else { unreachable!("a sphere") };
        let on_sphere = |sampler: &mut Sampler| {
            let normal = (emit(&super::tests::sphere(), sampler).origin - sphere.center) / sphere.radius;
            cap_square(normal, -1.0)
        };
        assert_has_density("sphere", on_sphere, |_| 1.0);
        let Light::Quad { quad: shape, .. } = quad() else { unreachable!("a quad") };
        let on_quad = |sampler: &mut Sampler| {
            let offset = emit(&quad(), sampler).origin - shape.position(0.0, 0.0);
            let (u, v) = shape.edges();
            // The edges are not perpendicular: solve the normal equations.
            let (uu, uv, vv) = (u.dot(u), u.dot(v), v.dot(v));
            let (ou, ov) = (offset.dot(u), offset.dot(v));
            Some(DVec2::new(vv * ou - uv * ov, uu * ov - uv * ou) / (uu * vv - uv * uv))
        };
        assert_has_density("quad", on_quad, |_| 1.0);
    }
}
