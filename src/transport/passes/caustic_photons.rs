//! The caustic photon pass: photons that only mirrors and glass have touched, from the light to the first surface that scatters them.
//!
//! Where the camera sees that surface directly and the caustic is sharp, the photon is splatted to the film (light tracing). Density
//! estimates serve caustics that are smooth, or seen in mirrors and through glass.

use super::input::PassInput;
use crate::math::{Ray, Rgb, Sampler, Stream};
use crate::transport::energy::{self, power};
use crate::transport::lights::emission::{self, Emission};
use crate::transport::photons::path_blocks::{concat, path_blocks};
use crate::transport::photons::{CausticPhotons, Photon, Splat};
use crate::transport::plan::CausticPlan;
use crate::transport::points::bsdf::MAX_SHADING_FACTOR;
use crate::transport::points::{SpecularEvent, Vertex, bsdf, roulette};
use crate::world::{Lobe, Media, Scattering, Surface, World};
use glam::DVec3;
use rayon::prelude::*;

/// Fraction of the emitted flux below which a branch ends at random: weak photons cost as much as strong ones. Just below the 4 % that
/// glass reflects at normal incidence.
const WEAK_BRANCH: f32 = 0.03;

/// The caustic photons of an iteration, in the order of their paths; `None` when cancelled. Empty for a plan without
/// caustics.
pub fn caustic_photon_pass(input: &PassInput) -> Option<CausticPhotons> {
    let PassInput { plan, iteration, .. } = *input;
    let Some(caustics) = &plan.caustics else { return Some(CausticPhotons::default()) };
    let paths = |&count: &u64| plan.paths(count, iteration);
    let to_map = plan.needs_caustic_map(iteration);
    let blocks: Vec<CausticPhotons> = path_blocks(caustics.paths.iter().map(paths))
        .into_par_iter()
        .map(|block| {
            let mut tracer = CausticTracer::new(input, caustics, to_map);
            let paths = paths(&caustics.paths[block.light]);
            let count = paths.end - paths.start;
            // One sequence over all iterations: its points keep filling each other's gaps.
            for index in block.paths.clone() {
                tracer.trace(block.light, count, input.sampler(Stream::CausticPhoton, block.light as u64, index));
            }
            (!input.cancel.is_cancelled()).then_some(tracer.found)
        })
        .collect::<Option<_>>()?;
    Some(CausticPhotons {
        photons: concat(&blocks, |block| &block.photons),
        splats: concat(&blocks, |block| &block.splats),
        counters: blocks.iter().map(|block| block.counters).sum(),
        energy: blocks.iter().map(|block| block.energy).sum(),
    })
}

/// Traces caustic photon paths, which branch at glass.
struct CausticTracer<'a> {
    input: &'a PassInput<'a>,
    world: &'a World,
    caustics: &'a CausticPlan,
    to_map: bool,
    found: CausticPhotons,
    /// Branches of the present path still to follow.
    branches: Vec<Branch>,
}

/// One branch of a path.
struct Branch {
    ray: Ray,
    flux: Rgb,
    media: Media,
    /// Mirrors and interfaces so far.
    bounces: u32,
}

impl<'a> CausticTracer<'a> {
    fn new(input: &'a PassInput<'a>, caustics: &'a CausticPlan, to_map: bool) -> Self {
        Self { input, world: input.world, caustics, to_map, found: CausticPhotons::default(), branches: Vec::new() }
    }

    /// Traces one of `path_count` paths of a light.
    fn trace(&mut self, light: usize, path_count: u64, mut sampler: Sampler) {
        self.found.counters.caustic_paths += 1;
        let emitted = self.caustics.projection_maps[light].emit(&self.world.lights[light], &mut sampler);
        let Some(Emission { origin, direction, flux }) = emitted else { return };
        let flux = flux / path_count as f32;
        self.found.energy.emitted += power(flux);
        let weak = WEAK_BRANCH * flux.max_element();
        let ray = emission::ray_from_light(self.world, light, origin, direction);
        let media = self.world.media_at_light(light, ray.at(ray.t_min));
        self.branches.push(Branch { ray, flux, media, bounces: 0 });
        while let Some(branch) = self.branches.pop() {
            self.follow(branch, weak, &mut sampler);
        }
    }

    /// Follows a branch to the next surface: leaves a photon where the surface scatters, branches off where it mirrors or refracts.
    fn follow(&mut self, mut branch: Branch, weak: f32, sampler: &mut Sampler) {
        self.found.counters.rays += 1;
        let energy = &mut self.found.energy;
        let Some(hit) = self.world.closest_hit(&branch.ray) else {
            energy.escaped += power(branch.flux);
            return;
        };
        let Surface::Object { front_side, material, .. } = self.world.surfaces[hit.primitive as usize] else {
            energy.met_light += power(branch.flux);
            return;
        };
        if branch.bounces == 0 && !self.world.materials[material as usize].is_specular() {
            energy.other_components += power(branch.flux);
            return;
        }
        let transmittance = self.world.transmittance(&branch.media, hit.t);
        energy.absorb_in_media(branch.flux, transmittance);
        branch.flux *= transmittance;
        let vertex = Vertex::at_hit(self.world, &branch.ray, hit, [front_side, material], &mut self.found.counters);
        let goes_on = branch.bounces + 1 < self.world.max_bounces;
        self.divide_energy(&branch, &vertex, goes_on);
        if vertex.scatters() && branch.bounces > 0 && branch.bounces < self.world.max_bounces {
            self.leave_photon(&branch, &vertex);
        }
        if goes_on {
            self.branch_off(&branch, &vertex, weak, sampler);
        }
    }

    /// Divides the flux that arrives at a vertex into absorbed, scattered and specular flux; only the specular flux may go on.
    fn divide_energy(&mut self, branch: &Branch, vertex: &Vertex, goes_on: bool) {
        let (energy, Scattering { albedo, lobe }) = (&mut self.found.energy, vertex.scattering);
        if goes_on && matches!(lobe, Lobe::Glass { .. }) {
            return;
        }
        let [arrived, of_diffuse, of_lobe] =
            [Rgb::ONE, albedo, energy::lobe_albedo(&lobe)].map(|weight| power(branch.flux * weight));
        let is_specular = matches!(lobe, Lobe::Mirror { .. } | Lobe::Glass { .. });
        let (scattered, specular) = if is_specular { (of_diffuse, of_lobe) } else { (of_diffuse + of_lobe, 0.0) };
        energy.absorbed += arrived - scattered - specular;
        if branch.bounces == 0 {
            energy.other_components += scattered;
        } else if vertex.scatters() {
            energy.scattered += scattered;
            energy.arrived += arrived;
        }
        energy.cut_off += if goes_on { 0.0 } else { specular };
    }

    /// Goes on along the mirrored and the refracted ray, both; weak branches end at random.
    fn branch_off(&mut self, branch: &Branch, vertex: &Vertex, weak: f32, sampler: &mut Sampler) {
        let Some(event) = SpecularEvent::at(self.world, vertex, &branch.media) else { return };
        for next in [Some(event.reflected), event.refracted].into_iter().flatten() {
            let flux = branch.flux * next.tint * next.fraction as f32;
            let survival = roulette(flux.max_element(), weak, sampler);
            self.found.energy.branch(branch.flux, &next, &vertex.scattering.lobe, survival);
            if let Some(survival) = survival {
                self.branches.push(Branch {
                    ray: vertex.ray(self.world, next.direction),
                    flux: flux / survival,
                    bounces: next.bounces_after(branch.bounces),
                    media: next.media,
                });
            }
        }
    }

    /// Leaves a photon in the map, on the film, or both.
    fn leave_photon(&mut self, branch: &Branch, vertex: &Vertex) {
        if !branch.flux.is_finite() {
            self.found.counters.dropped_samples += 1;
            return;
        }
        if self.to_map {
            self.found.photons.push(Photon::arrived(self.world, vertex, branch.flux, branch.bounces));
            self.found.counters.photons_stored += 1;
        }
        self.found.energy.stored += power(branch.flux);
        self.splat(branch, vertex);
    }

    /// Adds a photon to the pixel that sees it: the flux `phi` adds `phi f |cos| / (d^2 solid angle of the pixel)` to the pixel's mean
    /// radiance. Adds nothing where the pixel gathers directly seen caustics.
    fn splat(&mut self, branch: &Branch, vertex: &Vertex) {
        let Vertex { point, scattering, n_side, n_shade, wo: wi, .. } = vertex;
        let PassInput { plan, iteration, .. } = *self.input;
        let Some(seen) = plan.camera.project(point.position) else { return };
        let primitive = &self.world.aggregate.primitives()[point.hit.primitive as usize];
        if plan.gathers_visible_caustics(primitive, seen.pixel, iteration) {
            return;
        }
        let wo = seen.to_camera;
        let (cos_camera, cos_photon, cos_shade) = (wo.dot(*n_side), wi.dot(*n_side), wi.dot(*n_shade));
        if cos_camera <= 0.0 || cos_photon <= 0.0 || cos_shade <= 0.0 {
            return;
        }
        let reflected = bsdf::eval(scattering, *n_shade, wo, *wi);
        let shading = (cos_shade / cos_photon).min(MAX_SHADING_FACTOR);
        let geometry = cos_camera * seen.pixels_per_steradian / (seen.distance * seen.distance);
        let seen_through = self.world.transmittance(&branch.media, seen.distance);
        let radiance = branch.flux * seen_through * reflected * (shading * geometry) as f32;
        if radiance == Rgb::ZERO || self.is_hidden(vertex, wo) {
            return;
        }
        if radiance.is_finite() {
            self.found.splats.push(Splat { pixel: seen.pixel, radiance });
            self.found.counters.splats += 1;
        } else {
            self.found.counters.dropped_samples += 1;
        }
    }

    /// Whether something stands between a vertex and the camera, in this direction.
    fn is_hidden(&mut self, vertex: &Vertex, to_camera: DVec3) -> bool {
        self.found.counters.shadow_rays += 1;
        let sight = Ray::between(self.world.leave(&vertex.point, to_camera), self.input.plan.camera.position);
        self.world.aggregate.occluded(&sight)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::counters::Counters;
    use crate::transport::pass::Cancel;
    use crate::transport::plan::Plan;
    use crate::transport::testing::{self, lamp, quad};
    use glam::DVec2;
    use std::f64::consts::PI;

    /// Distance from the lamp to the square mirror, and half a side of the mirror.
    const TO_MIRROR: f64 = 0.5;
    const HALF: f64 = 0.25;

    /// A screen in the plane z = 0, which the camera sees from (0, 0, 4), and behind the camera a lamp before a mirror (reflectance 0.8).
    fn lit_by_a_mirror(max_bounces: u32) -> World {
        let mirror = [[-HALF, -HALF, 4.5 + TO_MIRROR], [0.0, 2.0 * HALF, 0.0], [2.0 * HALF, 0.0, 0.0]];
        let screen = "[[object]]\nname = \"screen\"\ntype = \"plane\"\nmaterial = \"grey\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n";
        let rest = format!("[film]\nwidth = 16\nheight = 16\n[render]\nmax_bounces = {max_bounces}\n");
        testing::world(&[&quad("mirror", mirror, "mirror"), screen, &lamp([0.0, 0.0, 4.5]), &rest].concat())
    }

    fn found(world: &World, iterations: u64) -> Vec<CausticPhotons> {
        let plan = Plan::new(world);
        let pass = |k| caustic_photon_pass(&PassInput::uncancelled(world, &plan, 1, 4 + k)).expect("never cancelled");
        (0..iterations).map(pass).collect()
    }

    /// A square of half side a at distance h has the solid angle `4 asin(a^2 / (a^2 + h^2))`.
    #[test]
    fn photons_carry_the_light_that_meets_the_mirror() {
        let passes = found(&lit_by_a_mirror(16), 2);
        let photons = passes.iter().flat_map(|pass| &pass.photons);
        let flux = photons.map(|photon| f64::from(photon.flux.x)).sum::<f64>() / passes.len() as f64;
        let a2 = HALF * HALF;
        let expected = 0.8 * 4.0 * (a2 / (a2 + TO_MIRROR * TO_MIRROR)).asin();
        // Stratified in cells of the projection map: about 0.3 % of the 16384 paths of an iteration are at the rim.
        assert!((flux / expected - 1.0).abs() < 0.01, "{flux} instead of {expected}");
        assert!(passes[0].photons.iter().all(|photon| photon.tag & 0xff == 1), "the mirror is one event");
    }

    /// The mirror shows the lamp at distance `d = 5.5` behind the screen: the irradiance is `0.8 d / (d^2 + rho^2)^(3/2)`.
    #[test]
    fn splats_are_the_radiance_of_the_caustic() {
        let iterations = 4;
        let mut film = vec![0.0; 16 * 16];
        for splat in found(&lit_by_a_mirror(16), iterations).iter().flat_map(|pass| &pass.splats) {
            film[splat.pixel as usize] += f64::from(splat.radiance.y) / iterations as f64;
        }
        let expected = |pixel: usize| {
            let pixel = DVec2::new((pixel % 16) as f64 + 0.5, (pixel / 16) as f64 + 0.5) / 8.0 - 1.0;
            let rho = 4.0 * 20f64.to_radians().tan() * pixel.length();
            let d = 4.5 + 2.0 * TO_MIRROR;
            0.5 / PI * 0.8 * d / (d * d + rho * rho).powf(1.5)
        };
        let middle = |pixel: &usize| (4..12).contains(&(pixel % 16)) && (4..12).contains(&(pixel / 16));
        let over_expected = |pixels: &[usize]| {
            pixels.iter().map(|&k| film[k]).sum::<f64>() / pixels.iter().map(|&k| expected(k)).sum::<f64>()
        };
        let (inner, outer): (Vec<_>, Vec<_>) = (0..256).partition(middle);
        // Some 5,000 and 15,000 photons: independent ones would leave errors of 1.4 and 0.8 %.
        assert!((over_expected(&inner) - 1.0).abs() < 0.03, "{} in the middle", over_expected(&inner));
        assert!((over_expected(&outer) - 1.0).abs() < 0.02, "{} around it", over_expected(&outer));
    }

    #[test]
    fn without_a_second_event_there_are_no_caustics() {
        let passes = found(&lit_by_a_mirror(1), 1);
        assert!(passes[0].photons.is_empty() && passes[0].splats.is_empty());
        assert_eq!(passes[0].counters, Counters::default());
        let world = lit_by_a_mirror(2);
        assert!(!found(&world, 1)[0].photons.is_empty(), "a mirror and the screen");
        let plan = Plan::new(&world);
        let cancelled = PassInput { cancel: Cancel::when(&|| true), ..PassInput::uncancelled(&world, &plan, 1, 4) };
        assert!(caustic_photon_pass(&cancelled).is_none());
    }
}
