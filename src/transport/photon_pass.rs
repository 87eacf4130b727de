//! Photons that carry interreflected light: every path of light that was scattered in many directions at least once
//! before it arrives.

use super::bsdf;
use super::counters::Counters;
use super::emission::{self, Emission};
use super::lobe_light::LobeLight;
use super::medium::Media;
use super::photon::Photon;
use super::plan::Plan;
use super::{Cancel, blocks};
use crate::math::{OrthonormalBasis, Ray, Rgb, Sampler, Stream, warp};
use crate::world::{Lobe, Scattering, Surface, SurfacePoint, World};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Shading normals change the weight of scattered light; beyond this factor only at grazing angles, where it would
/// make single photons too bright.
pub(super) const MAX_SHADING_FACTOR: f64 = 8.0;

/// A point on this side of a surface is as far from it, parts of the world's radius.
const OFF_SURFACE: f64 = 1e-5;

/// What one iteration's paths for interreflection leave.
#[derive(Clone, Debug, Default)]
pub struct GlobalBatch {
    /// Photons that came straight from a surface that scatters: their density is smooth.
    pub photons: Vec<Photon>,
    /// Photons that mirrors or glass sent on after they were scattered: these form caustics of indirect light.
    pub focused: Vec<Photon>,
    /// Photons at Phong lobes, as far as what these take from them is not the camera's: see [`LobeLight`].
    pub glossy: Vec<Photon>,
    /// What was done.
    pub counters: Counters,
}

/// The photons of one iteration, in the order of their paths; `None` when cancelled.
pub fn global_photon_pass(
    world: &World,
    plan: &Plan,
    seed: u64,
    iteration: u64,
    cancel: Cancel,
) -> Option<GlobalBatch> {
    let paths = |&count: &u64| plan.paths(count, iteration);
    let blocks: Vec<GlobalBatch> = blocks::of_photons(plan.global_paths.iter().map(paths))
        .into_par_iter()
        .map(|block| {
            let mut walk = Walk { world, lobe_light: Some(&plan.lobe_light), batch: GlobalBatch::default() };
            let paths = paths(&plan.global_paths[block.light]);
            let count = paths.end - paths.start;
            for index in block.paths.clone() {
                let mut sampler = Sampler::new(seed, plan.stream(Stream::GlobalPhoton), block.light as u64, index);
                let flight = walk.start(block.light, count, &mut sampler);
                walk.follow(flight, &mut sampler);
            }
            (!cancel.is_cancelled()).then_some(walk.batch)
        })
        .collect::<Option<_>>()?;
    let (photons, (focused, glossy)) = rayon::join(
        || blocks::join(&blocks, |block| &block.photons),
        || (blocks::join(&blocks, |block| &block.focused), blocks::join(&blocks, |block| &block.glossy)),
    );
    Some(GlobalBatch { photons, focused, glossy, counters: blocks.iter().map(|block| block.counters).sum() })
}

/// A little before where one path of a light arrives at surfaces that scatter it, from the first one on.
pub(super) fn one_path(world: &World, light: usize, mut sampler: Sampler) -> Vec<DVec3> {
    let mut walk = Walk { world, lobe_light: None, batch: GlobalBatch::default() };
    // As if it had been scattered before: then photons tell of the first arrival, too.
    let flight = Flight { was_scattered: true, ..walk.start(light, 1, &mut sampler) };
    walk.follow(flight, &mut sampler);
    let GlobalBatch { photons, focused, .. } = walk.batch;
    let before =
        |photon: &Photon| world.center + photon.position.as_dvec3() + OFF_SURFACE * world.radius * photon.wi.as_dvec3();
    photons.iter().chain(&focused).map(before).collect()
}

struct Walk<'a> {
    world: &'a World,
    lobe_light: Option<&'a LobeLight>,
    batch: GlobalBatch,
}

/// A photon in flight.
struct Flight {
    light: usize,
    origin: DVec3,
    ray: Ray,
    flux: Rgb,
    media: Media,
    /// Scattering events so far.
    bounces: u32,
    /// Whether one of them sent light in many directions.
    was_scattered: bool,
    /// Whether the last of them mirrored or refracted it.
    is_focused: bool,
    /// If it was scattered at the first surface and only there: the density, per area there and steradian, that
    /// [`LobeLight::camera_part`] asks for.
    scattered_first: Option<f64>,
}

impl Walk<'_> {
    /// A path at its light.
    fn start(&mut self, light: usize, path_count: u64, sampler: &mut Sampler) -> Flight {
        let Emission { origin, direction, flux } = emission::emit(&self.world.lights[light], sampler);
        self.batch.counters.global_paths += 1;
        let ray = Ray { t_min: 1e-9 * self.world.radius, ..Ray::new(origin, direction) };
        Flight {
            light,
            origin,
            ray,
            flux: flux / path_count as f32,
            media: Media::default(),
            bounces: 0,
            was_scattered: false,
            is_focused: false,
            scattered_first: None,
        }
    }

    fn follow(&mut self, mut flight: Flight, sampler: &mut Sampler) {
        while self.step(&mut flight, sampler).is_some() {}
    }

    /// To the next surface and off it; `None` where the path ends.
    fn step(&mut self, flight: &mut Flight, sampler: &mut Sampler) -> Option<()> {
        self.batch.counters.rays += 1;
        let hit = self.world.aggregate.closest_hit(&flight.ray)?;
        let Surface::Object { object, material, .. } = self.world.surfaces[hit.primitive as usize] else { return None };
        let point = self.world.surface_point(&flight.ray, hit);
        flight.flux *= flight.media.transmittance(self.world, hit.t);
        let (scattering, n_shade) = self.world.scattering(&point, material);
        self.batch.counters.texture_lookups += u64::from(self.world.materials[material as usize].lookups());
        let wi = -flight.ray.direction;
        if flight.was_scattered && scattering.albedo != Rgb::ZERO && flight.bounces < self.world.max_bounces {
            let photons = if flight.is_focused { &mut self.batch.focused } else { &mut self.batch.photons };
            photons.push(Photon::arrived(self.world, &point, object, wi, flight.flux, flight.bounces));
            self.batch.counters.photons_stored += 1;
        }
        if let Some(density) = flight.scattered_first {
            self.leave_at_lobe(flight, density, &point, (object, material), &scattering);
        }
        if flight.bounces + 1 >= self.world.max_bounces {
            return None;
        }
        let direction = scatter(self.world, flight, &point, &scattering, material, n_shade, sampler)?;
        flight.scattered_first = match (flight.bounces, flight.is_focused) {
            (0, false) if self.lobe_light.is_some_and(LobeLight::is_divided) => {
                let light = &self.world.lights[flight.light];
                let scattered = f64::from(bsdf::eval(&scattering, n_shade, direction, wi).max_element());
                Some(scattered * wi.dot(point.n_side()) * emission::density(light, flight.origin, point.position))
            }
            (1.., true) => flight.scattered_first,
            _ => None,
        };
        flight.bounces += 1;
        flight.ray = Ray::new(self.world.leave(&point, direction), direction);
        flight.flux.is_finite().then_some(())
    }

    /// Where there is a Phong lobe, leaves what it takes from a photon that is not the camera's.
    #[inline(never)]
    fn leave_at_lobe(
        &mut self,
        flight: &Flight,
        density: f64,
        point: &SurfacePoint,
        (object, material): (u32, u32),
        scattering: &Scattering,
    ) -> Option<()> {
        let wi = -flight.ray.direction;
        let lobe_light = self.lobe_light?;
        let lobe = lobe_light.view(point, &self.world.materials[material as usize], scattering, wi, 0.0)?;
        let part = 1.0 - lobe_light.camera_part(flight.light, density, lobe);
        if part > 0.0 {
            let flux = part as f32 * flight.flux;
            self.batch.glossy.push(Photon::arrived(self.world, point, object, wi, flux, flight.bounces));
            self.batch.counters.photons_stored += 1;
        }
        Some(())
    }
}

/// Chooses between the parts of the scattering and absorption by what each would leave of the flux (Russian roulette,
/// which keeps all photons about equally strong), and returns the new direction.
fn scatter(
    world: &World,
    flight: &mut Flight,
    point: &SurfacePoint,
    scattering: &Scattering,
    material: u32,
    n_shade: DVec3,
    sampler: &mut Sampler,
) -> Option<DVec3> {
    let n_side = point.n_side();
    let wi = -flight.ray.direction;
    let (u, choice): (DVec2, f64) = (sampler.next_2d(), sampler.next_1d());
    let before = flight.flux.max_element();
    flight.is_focused = false;
    let kept = |weight: Rgb| f64::from((flight.flux * weight).max_element() / before);
    let diffuse = kept(scattering.albedo);
    if choice < diffuse {
        flight.flux *= scattering.albedo / diffuse as f32;
        flight.was_scattered = true;
        let direction = OrthonormalBasis::from_normal(n_shade).world_from_local(warp::cosine_hemisphere(u));
        let factor = shading_factor(wi, direction, n_side, n_shade);
        flight.flux *= factor as f32;
        return (factor > 0.0).then_some(direction);
    }
    match scattering.lobe {
        Lobe::None => None,
        Lobe::Phong { specular, .. } => {
            let probability = kept(specular);
            if choice - diffuse >= probability {
                return None;
            }
            let (direction, weight) = bsdf::sample_glossy(scattering, n_shade, n_side, wi, u)?;
            flight.flux *= weight / probability as f32;
            flight.flux *= shading_factor(wi, direction, n_side, n_shade) as f32;
            flight.was_scattered = true;
            Some(direction)
        }
        Lobe::Mirror { reflectance } => {
            let probability = kept(reflectance);
            flight.is_focused = true;
            flight.flux *= reflectance / probability as f32;
            (choice - diffuse < probability).then(|| bsdf::reflect_above(wi, n_shade, n_side))
        }
        Lobe::Glass { tint, .. } => {
            flight.is_focused = true;
            let entering = point.front;
            let eta = flight.media.eta(world, material, entering);
            let fresnel = bsdf::fresnel(wi.dot(n_shade), eta);
            if choice < fresnel.reflectance {
                return Some(bsdf::reflect_above(wi, n_shade, n_side));
            }
            flight.flux *= tint;
            flight.media = flight.media.crossed(material, entering);
            Some(bsdf::refract(wi, n_shade, eta, fresnel.cos_transmitted))
        }
    }
}

/// The correction for shading normals of light that travels from a light: `|cos_i'| |cos_o| / (|cos_i| |cos_o'|)`,
/// shading cosines primed \[Veach97, 5.3.2\]; 0 where a direction is on different sides of the two normals.
pub(super) fn shading_factor(wi: DVec3, wo: DVec3, n_side: DVec3, n_shade: DVec3) -> f64 {
    if n_side == n_shade {
        return 1.0;
    }
    let (i_geom, o_geom, i_shade, o_shade) = (wi.dot(n_side), wo.dot(n_side), wi.dot(n_shade), wo.dot(n_shade));
    if i_geom <= 0.0 || o_geom <= 0.0 || i_shade <= 0.0 || o_shade <= 0.0 {
        return 0.0;
    }
    (i_shade * o_geom / (i_geom * o_shade)).min(MAX_SHADING_FACTOR)
}
