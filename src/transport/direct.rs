//! Direct light: next event estimation, with multiple importance sampling against the Phong lobe.

use super::bsdf;
use super::counters::Counters;
use super::emission;
use super::lobe_light::LobeView;
use super::plan::Plan;
use crate::geometry::Sphere;
use crate::math::{OrthonormalBasis, Ray, Rgb, Sampler, warp};
use crate::world::{Light, Scattering, SurfacePoint, World};
use glam::DVec3;

/// A surface point that light scatters at, as seen from `wo`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    pub(super) point: SurfacePoint,
    pub(super) scattering: Scattering,
    pub(super) n_side: DVec3,
    pub(super) n_shade: DVec3,
    pub(super) wo: DVec3,
    /// The lobe that shows it, if it is seen in one, perhaps over mirrors and through glass.
    pub(super) seen_in: Option<LobeView>,
}

/// A vertex that a lobe shows, as it scatters light from one direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shown {
    lobe: LobeView,
    position: DVec3,
    /// Scattering function times cosine.
    scattered: f64,
}

impl Vertex {
    /// How it scatters light from `wi` to the lobe that shows it; `None` where none does.
    pub(super) fn shown(&self, wi: DVec3) -> Option<Shown> {
        let scattered = || bsdf::eval(&self.scattering, self.n_shade, self.wo, wi).max_element();
        self.seen_in.map(|lobe| Shown {
            lobe,
            position: self.point.position,
            scattered: f64::from(scattered()) * wi.dot(self.n_side),
        })
    }
}

/// A point of a light as seen from a surface point.
struct LightSample {
    position: DVec3,
    /// Towards the light, unit length.
    wi: DVec3,
    /// Radiance over the density of the direction; intensity over the squared distance for a point light.
    weight: Rgb,
    /// Density of the direction per steradian; `None` for a point light, which no lobe can hit.
    pdf: Option<f64>,
}

/// Lights nearer than this part of the scene's radius shine as if they were at that distance, so that a light on a
/// surface stays finite.
const NEAREST: f64 = 1e-4;

/// Radiance towards `wo` of light that comes straight from the lights, as far as it is the camera's.
pub(super) fn direct_light(
    world: &World,
    plan: &Plan,
    vertex: &Vertex,
    sampler: &mut Sampler,
    counters: &mut Counters,
) -> Rgb {
    let mut radiance = Rgb::ZERO;
    // Drawn only where there is something to choose.
    let u = if plan.light_choice.is_needed() { sampler.next_1d() } else { 0.0 };
    plan.light_choice.choose(vertex, u, |light, factor| {
        radiance += factor * one_light(world, plan, light, vertex, sampler, counters);
    });
    radiance
}

fn one_light(
    world: &World,
    plan: &Plan,
    light: usize,
    vertex: &Vertex,
    sampler: &mut Sampler,
    counters: &mut Counters,
) -> Rgb {
    let sample = sample_light(world, &world.lights[light], vertex.point.position, sampler);
    let Some(sample) = sample else { return Rgb::ZERO };
    let (cos_side, cos) = (sample.wi.dot(vertex.n_side), sample.wi.dot(vertex.n_shade));
    if cos_side <= 0.0 || cos <= 0.0 {
        return Rgb::ZERO;
    }
    let glossy = bsdf::eval_glossy(&vertex.scattering, vertex.n_shade, vertex.wo, sample.wi);
    let balance = sample
        .pdf
        .map_or(1.0, |pdf| pdf / (pdf + bsdf::pdf_glossy(&vertex.scattering, vertex.n_shade, vertex.wo, sample.wi)));
    let reflected = bsdf::eval_diffuse(&vertex.scattering) + glossy * balance as f32;
    let part = camera_part(world, plan, light, sample.position, vertex.shown(sample.wi));
    let radiance = reflected * sample.weight * (part * cos) as f32;
    if radiance == Rgb::ZERO {
        return Rgb::ZERO;
    }
    counters.shadow_rays += 1;
    let shadow_ray = Ray {
        // Short of the light's own surface.
        t_max: 1.0 - 1e-9,
        ..Ray::between(world.leave(&vertex.point, sample.wi), sample.position)
    };
    if world.aggregate.occluded(&shadow_ray) { Rgb::ZERO } else { radiance }
}

/// The part of light that is the camera's where a vertex scatters what comes straight from a place on a light.
pub(super) fn camera_part(world: &World, plan: &Plan, light: usize, place: DVec3, shown: Option<Shown>) -> f64 {
    let Some(Shown { lobe, position, scattered }) = shown else { return 1.0 };
    plan.lobe_light.camera_part(light, scattered * emission::density(&world.lights[light], place, position), lobe)
}

fn sample_light(world: &World, light: &Light, from: DVec3, sampler: &mut Sampler) -> Option<LightSample> {
    match light {
        Light::Point { position, intensity } => {
            let offset = *position - from;
            let distance = offset.length();
            let nearest = NEAREST * world.radius;
            let weight = *intensity / distance.max(nearest).powi(2) as f32;
            (distance > 0.0).then(|| LightSample { position: *position, wi: offset / distance, weight, pdf: None })
        }
        Light::Sphere { sphere, radiance } => {
            let one_minus_cos = subtended(sphere, from)?;
            let axis = (sphere.center - from).try_normalize()?;
            let wi = OrthonormalBasis::from_normal(axis)
                .world_from_local(warp::uniform_cone(sampler.next_2d(), one_minus_cos));
            let t = sphere.intersect(&Ray::new(from, wi)).unwrap_or_else(|| (sphere.center - from).dot(wi));
            let pdf = warp::pdf_uniform_cone(one_minus_cos);
            Some(LightSample { position: from + t * wi, wi, weight: *radiance / pdf as f32, pdf: Some(pdf) })
        }
        Light::Quad { quad, radiance } => {
            let u = sampler.next_2d();
            let position = quad.position(u.x, u.y);
            let offset = position - from;
            let distance = offset.length();
            let wi = offset.try_normalize()?;
            let cos = -wi.dot(quad.normal());
            if cos <= 0.0 {
                return None;
            }
            let pdf = distance.max(NEAREST * world.radius).powi(2) / (cos * quad.area());
            Some(LightSample { position, wi, weight: *radiance / pdf as f32, pdf: Some(pdf) })
        }
    }
}

/// `1 - cos` of the half angle under which a sphere appears; `None` from inside.
fn subtended(sphere: &Sphere, from: DVec3) -> Option<f64> {
    let sin2 = sphere.radius * sphere.radius / sphere.center.distance_squared(from);
    // 1 - sqrt(1 - x) without cancellation for small x.
    (sin2 < 1.0).then(|| sin2 / (1.0 + (1.0 - sin2).sqrt()))
}

/// Density per steradian with which [`direct_light`] at `from` chooses the point of a light where a ray of direction
/// `wi` (unit length) met it, at this distance and with this normal there, if it asks this light: both sides of the
/// balance leave out whether it does, so that their weights still add up to 1.
pub(super) fn pdf_light(light: &Light, from: DVec3, wi: DVec3, distance: f64, n_light: DVec3) -> f64 {
    match light {
        Light::Point { .. } => 0.0,
        Light::Sphere { sphere, .. } => subtended(sphere, from).map_or(0.0, warp::pdf_uniform_cone),
        Light::Quad { quad, .. } => distance * distance / (wi.dot(n_light).abs() * quad.area()),
    }
}
