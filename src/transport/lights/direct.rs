//! Direct light: next event estimation, with multiple importance sampling against the Phong lobe.

use super::PhotonEmission;
use super::light_sampler::LightSampler;
use super::spherical_quad::SphericalQuad;
use crate::geometry::{Quad, Sphere};
use crate::math::{OrthonormalBasis, Ray, Rgb, Sampler, warp};
use crate::transport::counters::Counters;
use crate::transport::points::{GlossyMis, MisVertex, Vertex, ViewingLobe, bsdf};
use crate::world::{Light, Media, ParallelRays, World};
use glam::DVec3;

/// The input of next event estimation.
#[derive(Clone, Copy)]
pub(in crate::transport) struct DirectLight<'a> {
    /// The scene with its lights.
    pub(in crate::transport) world: &'a World,
    /// Draws lights where there are many.
    pub(in crate::transport) light_sampler: &'a LightSampler,
    /// How photons leave each light.
    pub(in crate::transport) photon_emissions: &'a [PhotonEmission],
    /// MIS weights of light in Phong lobes.
    pub(in crate::transport) glossy_mis: &'a GlossyMis,
}

/// A sampled point of a light, seen from a surface point.
struct LightSample {
    /// The point; of a sun, any point on the way to it.
    position: DVec3,
    /// Distance of the light, scene units; [`SUN_DISTANCE`] for a sun.
    distance: f64,
    /// Unit direction towards the light.
    wi: DVec3,
    /// Radiance over the density of the direction; intensity over the squared distance for a point light; irradiance of parallel rays.
    weight: Rgb,
    /// Density of the direction per steradian; `None` for a light that no ray can hit.
    pdf: Option<f64>,
}

/// Least distance at which point lights shine, in pixel footprints: so the light of one on a surface stays finite. Of the samples of a pixel
/// with a nearer light, one in some thousand would find most of its light.
const NEAREST: f64 = 0.01;
/// Rounding of a shadow ray's end over its length: some roundings of `f64`.
const END_ROUNDING: f64 = 1e-14;

/// Distance that stands for that of a sun, scene units: beyond every scene, and a common factor of it is still finite in `f32`.
const SUN_DISTANCE: f64 = 1e30;

/// The camera path that ends at a vertex.
#[derive(Clone, Copy)]
pub(in crate::transport) struct SeenBy<'a> {
    /// The media at the vertex, on the side that the path came from.
    pub(in crate::transport) media: &'a Media,
    /// The last Phong lobe of the path.
    pub(in crate::transport) viewing_lobe: Option<ViewingLobe>,
    /// Length of the path, scene units.
    pub(in crate::transport) length: f64,
}

impl LightSample {
    /// The ray from the surface point, moved off its surface, to the light with this index: it ends short of the light's own surface.
    #[inline]
    fn shadow_ray(&self, from: DVec3, world: &World, light: usize) -> Ray {
        if self.distance >= SUN_DISTANCE {
            return Ray::new(from, self.wi);
        }
        let short = world.clearance_of_light(light, self.position, self.wi) / self.distance;
        Ray { t_max: 1.0 - short.max(END_ROUNDING), ..Ray::between(from, self.position) }
    }
}

impl DirectLight<'_> {
    /// Radiance from a vertex towards the camera path that sees it, of light that comes straight from the lights, times the MIS weight of
    /// camera paths.
    #[inline]
    pub(in crate::transport) fn radiance(
        &self,
        vertex: &Vertex,
        seen_by: SeenBy,
        sampler: &mut Sampler,
        counters: &mut Counters,
    ) -> Rgb {
        let mut radiance = Rgb::ZERO;
        // A number is drawn only where lights are drawn.
        let u = if self.light_sampler.draws() { sampler.next_1d() } else { 0.0 };
        self.light_sampler.sample(vertex, u, |light, weight| {
            radiance += weight * self.of_light(light, vertex, seen_by, sampler, counters);
        });
        radiance
    }

    fn of_light(
        &self,
        light: usize,
        vertex: &Vertex,
        seen_by: SeenBy,
        sampler: &mut Sampler,
        counters: &mut Counters,
    ) -> Rgb {
        let nearest = NEAREST * self.world.camera.footprint(seen_by.length);
        let sample = sample_light(&self.world.lights[light], vertex.point.position, nearest, sampler);
        let Some(sample) = sample else { return Rgb::ZERO };
        let (cos_side, cos) = (sample.wi.dot(vertex.n_side), sample.wi.dot(vertex.n_shade));
        if cos_side <= 0.0 || cos <= 0.0 {
            return Rgb::ZERO;
        }
        let glossy = bsdf::eval_glossy(&vertex.scattering, vertex.n_shade, vertex.wo, sample.wi);
        let balance = sample.pdf.map_or(1.0, |pdf| {
            pdf / (pdf + bsdf::pdf_glossy(&vertex.scattering, vertex.n_shade, vertex.wo, sample.wi))
        });
        let reflected = bsdf::eval_diffuse(&vertex.scattering) + glossy * balance as f32;
        let seen = seen_by.viewing_lobe.map(|lobe| MisVertex::new(lobe, vertex, sample.wi));
        let weight = self.camera_weight(light, sample.position, seen);
        let radiance = reflected * sample.weight * (weight * cos) as f32;
        if radiance == Rgb::ZERO {
            return Rgb::ZERO;
        }
        counters.shadow_rays += 1;
        let shadow_ray = sample.shadow_ray(self.world.leave(&vertex.point, sample.wi), self.world, light);
        if self.world.aggregate.occluded(&shadow_ray) {
            return Rgb::ZERO;
        }
        radiance * self.world.transmittance(seen_by.media, sample.distance)
    }

    /// The MIS weight of camera paths, 0 to 1, for light that a vertex scatters from a point of a light to the lobe that shows the vertex;
    /// 1 without a lobe.
    #[inline]
    pub(in crate::transport) fn camera_weight(&self, light: usize, light_point: DVec3, seen: Option<MisVertex>) -> f64 {
        let Some(MisVertex { lobe, position, scattered }) = seen else { return 1.0 };
        let emission = &self.photon_emissions[light];
        let density = scattered * emission.density(&self.world.lights[light], light_point, position);
        self.glossy_mis.camera_weight(light, density, lobe)
    }
}

/// Samples a point of a light that shines at a point `from`, a point light as if it were at least the distance `nearest` away; `None` where
/// the light does not shine.
fn sample_light(light: &Light, from: DVec3, nearest: f64, sampler: &mut Sampler) -> Option<LightSample> {
    match light {
        Light::Point { position, intensity } => {
            let offset = *position - from;
            let distance = offset.length();
            let weight = *intensity / distance.max(nearest).powi(2) as f32;
            let wi = offset / distance;
            (distance > 0.0).then_some(LightSample { position: *position, distance, wi, weight, pdf: None })
        }
        Light::Sphere { sphere, radiance } => {
            let one_minus_cos = subtended(sphere, from)?;
            let axis = (sphere.center - from).try_normalize()?;
            let wi = OrthonormalBasis::from_normal(axis)
                .world_from_local(warp::uniform_cone(sampler.next_2d(), one_minus_cos));
            let distance = sphere.intersect(&Ray::new(from, wi)).unwrap_or_else(|| (sphere.center - from).dot(wi));
            let pdf = warp::pdf_uniform_cone(one_minus_cos);
            let (position, weight) = (from + distance * wi, *radiance / pdf as f32);
            Some(LightSample { position, distance, wi, weight, pdf: Some(pdf) })
        }
        Light::Quad { quad, radiance } => {
            let u = sampler.next_2d();
            let (offset, pdf) = if is_near(quad, from) {
                let seen = SphericalQuad::new(quad, from)?;
                let wi = seen.sample(u);
                (quad.distance_along(from, wi) * wi, 1.0 / seen.solid_angle())
            } else {
                let offset = quad.position(u.x, u.y) - from;
                (offset, pdf_area(quad, offset.normalize(), offset.length()))
            };
            let (distance, wi) = (offset.length(), offset.try_normalize()?);
            let shines = wi.dot(quad.normal()) < 0.0 && distance.is_finite();
            let weight = *radiance / pdf as f32;
            shines.then_some(LightSample { position: from + offset, distance, wi, weight, pdf: Some(pdf) })
        }
        Light::Parallel(rays) => sample_parallel(rays, from, sampler),
    }
}

/// Samples the direction to a sun; the point of a beam's disc from which light comes to a point, `None` beside the beam and behind it.
fn sample_parallel(rays: &ParallelRays, from: DVec3, sampler: &mut Sampler) -> Option<LightSample> {
    let (direction, irradiance) = rays.sample_direction(sampler);
    // An irradiance of the plane across the axis: across the direction it is greater by the cosine.
    let weight = irradiance / direction.dot(rays.direction) as f32;
    if rays.from_outside {
        let wi = -direction;
        return Some(LightSample { position: from + wi, distance: SUN_DISTANCE, wi, weight, pdf: None });
    }
    let distance = (from - rays.center).dot(direction);
    let shines = distance > 0.0 && rays.crossing(from, direction).length_squared() <= 1.0;
    let (position, wi) = (from - distance * direction, -direction);
    shines.then_some(LightSample { position, distance, wi, weight, pdf: None })
}

/// `1 - cos` of the half angle under which a sphere appears; `None` from inside.
fn subtended(sphere: &Sphere, from: DVec3) -> Option<f64> {
    let sin2 = sphere.radius * sphere.radius / sphere.center.distance_squared(from);
    // 1 - sqrt(1 - x) without cancellation for small x.
    (sin2 < 1.0).then(|| sin2 / (1.0 + (1.0 - sin2).sqrt()))
}

/// Density per steradian with which [`DirectLight`] at `from` samples the point of a light that a ray with unit direction `wi` met at
/// this distance. The probability that the light is drawn is left out on both sides of the balance
/// heuristic, whose weights still add up to 1.
pub(in crate::transport) fn pdf_light(light: &Light, from: DVec3, wi: DVec3, distance: f64) -> f64 {
    match light {
        Light::Point { .. } | Light::Parallel(_) => 0.0,
        Light::Sphere { sphere, .. } => subtended(sphere, from).map_or(0.0, warp::pdf_uniform_cone),
        Light::Quad { quad, .. } if is_near(quad, from) => {
            SphericalQuad::new(quad, from).map_or(0.0, |seen| 1.0 / seen.solid_angle())
        }
        Light::Quad { quad, .. } => pdf_area(quad, wi, distance),
    }
}

/// Whether points of a quad differ so much in their distance to a point that directions are drawn evenly in the solid angle: drawn by area,
/// few would find most of the light.
fn is_near(quad: &Quad, from: DVec3) -> bool {
    let (u, v) = quad.edges();
    quad.position(0.5, 0.5).distance_squared(from) < u.length_squared() + v.length_squared()
}

/// Density per steradian of points drawn by area on a quad, of one in this unit direction at this distance.
fn pdf_area(quad: &Quad, wi: DVec3, distance: f64) -> f64 {
    distance * distance / (wi.dot(quad.normal()).abs() * quad.area())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::chi_square::assert_has_density;
    use crate::math::{Stream, octahedral};
    use std::f64::consts::PI;

    /// Directions over the sphere towards a light that fills much of it, against [`pdf_light`] where a ray in that direction meets it.
    fn assert_samples(light: &Light, meet: impl Fn(&Ray) -> Option<f64>) {
        let from = DVec3::new(0.1, 0.2, -0.1);
        let pdf = |wi: DVec3| meet(&Ray::new(from, wi)).map_or(0.0, |t| pdf_light(light, from, wi, t));
        let sample = |sampler: &mut Sampler| {
            let LightSample { position, wi, weight, pdf: sampled, .. } = sample_light(light, from, 0.0, sampler)?;
            let t = meet(&Ray::new(from, wi)).unwrap_or((position - from).length());
            assert!(position.distance(from + t * wi) < 1e-6, "the position is where the ray arrives");
            let sampled = sampled.expect("an area light");
            assert!((sampled / pdf_light(light, from, wi, t) - 1.0).abs() < 1e-6, "the density of the sample");
            assert!((f64::from(weight.x) * sampled - 2.0).abs() < 1e-5, "radiance over density");
            Some(octahedral::square_from_direction(wi))
        };
        let density = |square| 4.0 * PI * pdf(octahedral::direction_from_square(square));
        assert_has_density(&format!("{light:?}"), sample, density);
    }

    #[test]
    fn samples_of_area_lights_have_their_density() {
        let radiance = Rgb::new(2.0, 1.0, 0.5);
        let sphere = Sphere { center: DVec3::new(0.5, 1.0, -0.2), radius: 0.6 };
        assert_samples(&Light::Sphere { sphere, radiance }, |ray| sphere.intersect(ray));
        // edge_u x edge_v points down, towards the point.
        let near = Quad::new(DVec3::new(-0.8, 0.9, -1.0), DVec3::new(2.0, 0.3, 0.0), DVec3::new(0.0, 0.1, 1.8));
        let far = Quad::new(DVec3::new(-0.8, 3.9, -1.0), DVec3::new(2.0, 0.3, 0.0), DVec3::new(0.0, 0.1, 1.8));
        for quad in [near, far] {
            assert_samples(&Light::Quad { quad, radiance }, |ray| Some(quad.intersect(ray)?.0));
        }
    }

    #[test]
    fn lamps_shine_as_if_from_the_least_distance() {
        let light = Light::Point { position: DVec3::new(0.0, 1e-9, 0.0), intensity: Rgb::ONE };
        let weight = |nearest: f64| {
            let mut sampler = Sampler::new(1, Stream::Camera, 0, 0);
            sample_light(&light, DVec3::ZERO, nearest, &mut sampler).expect("it shines").weight.x
        };
        assert!((weight(1e-3) / 1e6 - 1.0).abs() < 1e-5 && (weight(0.0) / 1e18 - 1.0).abs() < 1e-5);
    }

    #[test]
    fn a_quad_does_not_shine_backwards() {
        let quad = Quad::new(DVec3::new(-0.5, 1.0, -0.5), DVec3::Z, DVec3::X);
        let light = Light::Quad { quad, radiance: Rgb::ONE };
        let mut sampler = Sampler::new(1, Stream::Camera, 0, 0);
        assert!(quad.normal().y > 0.0 && sample_light(&light, DVec3::ZERO, 0.0, &mut sampler).is_none());
    }
}
