//! Photons that only mirrors and glass have touched, from the light to the first surface that scatters them: caustics.
//!
//! Where the camera sees that surface directly and caustics are sharp, the photon is added to the film at once (light tracing);
//! the density estimate is left to what is smooth, or seen in mirrors and through glass.

use super::bsdf;
use super::counters::Counters;
use super::emission::{self, Emission};
use super::medium::Media;
use super::photon::Photon;
use super::photon_pass::MAX_SHADING_FACTOR;
use super::plan::{CausticPlan, Plan};
use super::{Cancel, blocks};
use crate::math::{Ray, Rgb, Sampler, Stream};
use crate::world::{Lobe, Scattering, Surface, SurfacePoint, World};
use glam::DVec3;
use rayon::prelude::*;

/// Branches weaker than this part of the emitted light are continued at random.
const WEAK_BRANCH: f32 = 0.03;

/// A photon's light added to a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Splat {
    /// Row by row from the top.
    pub pixel: u32,
    /// Radiance averaged over the pixel.
    pub radiance: Rgb,
}

/// What one iteration's caustic photons leave.
#[derive(Clone, Debug, Default)]
pub struct CausticBatch {
    /// Photons for the map; none where nothing gathers them.
    pub photons: Vec<Photon>,
    /// Light for the film; none for pixels that gather what is seen directly, too.
    pub splats: Vec<Splat>,
    /// What was done.
    pub counters: Counters,
}

/// The caustic photons of one iteration, in the order of their paths; `None` when cancelled.
pub fn caustic_photon_pass(
    world: &World,
    plan: &Plan,
    seed: u64,
    iteration: u64,
    cancel: Cancel,
) -> Option<CausticBatch> {
    let Some(caustics) = &plan.caustics else { return Some(CausticBatch::default()) };
    let paths = |&count: &u64| plan.paths(count, iteration);
    let to_map = plan.needs_caustic_map(iteration);
    let blocks: Vec<CausticBatch> = blocks::of_photons(caustics.paths.iter().map(paths))
        .into_par_iter()
        .map(|block| {
            let mut walk = Walk::new(world, plan, caustics, iteration, to_map);
            let paths = paths(&caustics.paths[block.light]);
            let count = paths.end - paths.start;
            // One sequence over all iterations: its points keep filling each other's gaps.
            for index in block.paths.clone() {
                let sampler = Sampler::new(seed, plan.stream(Stream::CausticPhoton), block.light as u64, index);
                walk.trace_path(block.light, count, sampler);
            }
            (!cancel.is_cancelled()).then_some(walk.batch)
        })
        .collect::<Option<_>>()?;
    Some(CausticBatch {
        photons: blocks::join(&blocks, |block| &block.photons),
        splats: blocks::join(&blocks, |block| &block.splats),
        counters: blocks.iter().map(|block| block.counters).sum(),
    })
}

struct Walk<'a> {
    world: &'a World,
    plan: &'a Plan,
    caustics: &'a CausticPlan,
    iteration: u64,
    to_map: bool,
    batch: CausticBatch,
    branches: Vec<Branch>,
}

/// One way that the light of a path goes on.
struct Branch {
    ray: Ray,
    flux: Rgb,
    media: Media,
    /// Mirrors and interfaces met so far.
    bounces: u32,
}

impl<'a> Walk<'a> {
    fn new(world: &'a World, plan: &'a Plan, caustics: &'a CausticPlan, iteration: u64, to_map: bool) -> Self {
        Self { world, plan, caustics, iteration, to_map, batch: CausticBatch::default(), branches: Vec::new() }
    }

    fn trace_path(&mut self, light: usize, path_count: u64, mut sampler: Sampler) {
        self.batch.counters.caustic_paths += 1;
        let guide = &self.caustics.guides[light];
        let emitted = emission::emit_guided(&self.world.lights[light], guide, &mut sampler);
        let Some(Emission { origin, direction, flux }) = emitted else { return };
        let flux = flux / path_count as f32;
        let weak = WEAK_BRANCH * flux.max_element();
        let ray = Ray { t_min: 1e-9 * self.world.radius, ..Ray::new(origin, direction) };
        self.branches.push(Branch { ray, flux, media: Media::default(), bounces: 0 });
        while let Some(branch) = self.branches.pop() {
            self.follow(branch, weak, &mut sampler);
        }
    }

    /// To the next surface: leaves a photon on one that scatters, goes on off one that mirrors or refracts.
    fn follow(&mut self, mut branch: Branch, weak: f32, sampler: &mut Sampler) {
        self.batch.counters.rays += 1;
        let Some(hit) = self.world.aggregate.closest_hit(&branch.ray) else { return };
        let Surface::Object { object, material, .. } = self.world.surfaces[hit.primitive as usize] else { return };
        if branch.bounces == 0 && !self.world.materials[material as usize].is_specular() {
            return;
        }
        let point = self.world.surface_point(&branch.ray, hit);
        branch.flux *= branch.media.transmittance(self.world, hit.t);
        let (scattering, n_shade) = self.world.scattering(&point, material);
        self.batch.counters.texture_lookups += u64::from(self.world.materials[material as usize].lookups());
        let scatters = scattering.albedo != Rgb::ZERO || matches!(scattering.lobe, Lobe::Phong { .. });
        if scatters && branch.bounces > 0 && branch.bounces < self.world.max_bounces {
            self.arrive(&branch, &point, &scattering, n_shade, object);
        }
        if branch.bounces + 1 < self.world.max_bounces {
            self.branch_off(&branch, &point, &scattering, material, n_shade, weak, sampler);
        }
    }

    /// Continues along the mirrored and the refracted ray, both.
    #[expect(clippy::too_many_arguments, reason = "the vertex's parts are computed once, by the caller")]
    fn branch_off(
        &mut self,
        branch: &Branch,
        point: &SurfacePoint,
        scattering: &Scattering,
        material: u32,
        n_shade: DVec3,
        weak: f32,
        sampler: &mut Sampler,
    ) {
        let wi = -branch.ray.direction;
        let mirrored = bsdf::reflect_above(wi, n_shade, point.n_side());
        match scattering.lobe {
            Lobe::None | Lobe::Phong { .. } => {}
            Lobe::Mirror { reflectance } => {
                self.push(branch, point, mirrored, branch.flux * reflectance, branch.media.clone(), weak, sampler);
            }
            Lobe::Glass { tint, .. } => {
                let eta = branch.media.eta(self.world, material, point.front);
                let fresnel = bsdf::fresnel(wi.dot(n_shade), eta);
                let reflected = branch.flux * fresnel.reflectance as f32;
                self.push(branch, point, mirrored, reflected, branch.media.clone(), weak, sampler);
                if fresnel.reflectance < 1.0 {
                    let direction = bsdf::refract(wi, n_shade, eta, fresnel.cos_transmitted);
                    let transmitted = branch.flux * tint * (1.0 - fresnel.reflectance) as f32;
                    let media = branch.media.crossed(material, point.front);
                    self.push(branch, point, direction, transmitted, media, weak, sampler);
                }
            }
        }
    }

    #[expect(clippy::too_many_arguments, reason = "a branch is all of these")]
    fn push(
        &mut self,
        from: &Branch,
        point: &SurfacePoint,
        direction: DVec3,
        flux: Rgb,
        media: Media,
        weak: f32,
        sampler: &mut Sampler,
    ) {
        let strength = flux.max_element();
        let mut flux = flux;
        if strength < weak {
            let survival = strength / weak;
            if sampler.next_1d() >= f64::from(survival) {
                return;
            }
            flux /= survival;
        }
        let ray = Ray::new(self.world.leave(point, direction), direction);
        self.branches.push(Branch { ray, flux, media, bounces: from.bounces + 1 });
    }

    /// Leaves the photon on the film, in the map, or both.
    fn arrive(&mut self, branch: &Branch, point: &SurfacePoint, scattering: &Scattering, n_shade: DVec3, object: u32) {
        if !branch.flux.is_finite() {
            self.batch.counters.dropped_samples += 1;
            return;
        }
        let wi = -branch.ray.direction;
        if self.to_map {
            let photon = Photon::arrived(self.world, point, object, wi, branch.flux, branch.bounces);
            self.batch.photons.push(photon);
            self.batch.counters.photons_stored += 1;
        }
        self.splat(branch.flux, wi, point, scattering, n_shade);
    }

    /// Adds the light that the surface sends on to the camera to its pixel: a photon of flux `phi` adds
    /// `phi f |cos| / (d^2 solid angle of the pixel)` to the pixel's mean radiance. Not where the pixel gathers it.
    fn splat(&mut self, flux: Rgb, wi: DVec3, point: &SurfacePoint, scattering: &Scattering, n_shade: DVec3) {
        let Some(seen) = self.plan.camera.project(point.position) else { return };
        let primitive = &self.world.aggregate.primitives()[point.hit.primitive as usize];
        if self.plan.gathers_visible_caustics(primitive, seen.pixel, self.iteration) {
            return;
        }
        let wo = seen.to_camera;
        let n_side = point.n_side();
        let (cos_camera, cos_photon) = (wo.dot(n_side), wi.dot(n_side));
        let cos_shade = wi.dot(n_shade);
        if cos_camera <= 0.0 || cos_photon <= 0.0 || cos_shade <= 0.0 {
            return;
        }
        let reflected = bsdf::eval_diffuse(scattering) + bsdf::eval_glossy(scattering, n_shade, wo, wi);
        let shading = (cos_shade / cos_photon).min(MAX_SHADING_FACTOR);
        let geometry = cos_camera * seen.pixels_per_steradian / (seen.distance * seen.distance);
        let radiance = flux * reflected * (shading * geometry) as f32;
        if radiance == Rgb::ZERO {
            return;
        }
        self.batch.counters.shadow_rays += 1;
        let sight = Ray::between(self.world.leave(point, wo), self.plan.camera.position);
        if self.world.aggregate.occluded(&sight) {
            return;
        }
        if radiance.is_finite() {
            self.batch.splats.push(Splat { pixel: seen.pixel, radiance });
            self.batch.counters.splats += 1;
        } else {
            self.batch.counters.dropped_samples += 1;
        }
    }
}
