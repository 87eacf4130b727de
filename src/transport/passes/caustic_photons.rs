//! The caustic photon pass: photons that only mirrors and glass have touched, from the light to the first surface that scatters them.
//!
//! Light sheets bring the light of small lamps and suns where it is smooth; photons bring the rest.
//!
//! Where the camera sees that surface directly and the caustic is sharp, the photon is splatted to the film (light tracing). Density
//! estimates serve caustics that are smooth, or seen in mirrors and through glass.

use super::input::PassInput;
use super::light_sheets::light_sheet_pass;
use crate::math::{Ray, Rgb, Sampler, Stream};
use crate::transport::counters::{Counted, Counters};
use crate::transport::energy::{self, PathEnergy, power};
use crate::transport::light_sheets::{LightSheets, SheetsOfLight};
use crate::transport::lights::emission::Emission;
use crate::transport::photons::path_blocks::{concat, path_blocks};
use crate::transport::photons::{CausticBranch, Photon, Signature, Splat};
use crate::transport::plan::CausticPlan;
use crate::transport::points::bsdf::MAX_SHADING_FACTOR;
use crate::transport::points::{Vertex, bsdf, roulette};
use crate::world::{Lobe, Scattering, Surface, World};
use glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;

/// Fraction of the emitted flux below which a branch ends at random: weak photons cost as much as strong ones. Just below the 4 % that
/// glass reflects at normal incidence.
const WEAK_BRANCH: f32 = 0.03;

/// The photons, splats and light sheets of a caustic photon pass.
#[derive(Clone, Debug, Default)]
pub struct CausticPhotons {
    /// Photons for the map; empty where no density estimate needs them.
    pub photons: Vec<Photon>,
    /// Light for the film. Pixels that gather directly seen caustics get none.
    pub splats: Vec<Splat>,
    /// The caustics that no photons bring.
    pub sheets: LightSheets,
    /// Work done.
    pub counters: Counters,
    /// What became of the flux of the paths.
    pub energy: PathEnergy,
}

impl Counted for CausticPhotons {
    fn counters(&self) -> Counters {
        self.counters
    }
}

/// The caustic photons of an iteration, in the order of their paths; `None` when cancelled. Empty for a plan without
/// caustics.
pub fn caustic_photon_pass(input: &PassInput) -> Option<CausticPhotons> {
    let PassInput { plan, iteration, .. } = *input;
    let Some(caustics) = &plan.caustics else { return Some(CausticPhotons::default()) };
    let to_map = plan.needs_caustic_map(iteration);
    let sheets = light_sheet_pass(input, caustics)?;
    let sources = sources(input, caustics, &sheets.of_lights);
    let blocks: Vec<CausticPhotons> = path_blocks(sources.iter().map(|source| source.paths.clone()))
        .into_par_iter()
        .map(|block| {
            let mut tracer = CausticTracer::new(input, caustics, &sources[block.source], to_map);
            for index in block.paths {
                tracer.trace(index);
            }
            (!input.cancel.is_cancelled()).then_some(tracer.found)
        })
        .collect::<Option<_>>()?;
    Some(CausticPhotons {
        photons: concat(&blocks, |block| &block.photons),
        splats: concat(&blocks, |block| &block.splats),
        counters: blocks.iter().map(|block| block.counters).chain([sheets.counters]).sum(),
        energy: blocks.iter().map(|block| block.energy).sum(),
        sheets: sheets.all,
    })
}

/// Where caustic photons come from: a light, or one of its points that has sheets.
struct Source<'a> {
    light: usize,
    /// The sheets, and what they leave to photons.
    sheets: Option<&'a SheetsOfLight>,
    /// Indices of the paths in the light's sequence.
    paths: Range<u64>,
}

/// The sources of an iteration, each with as many paths as its sheets, if any, leave to photons.
fn sources<'a>(input: &PassInput, caustics: &CausticPlan, of_lights: &'a [Vec<SheetsOfLight>]) -> Vec<Source<'a>> {
    let of_light = |(light, points): (usize, &'a Vec<SheetsOfLight>)| {
        let paths = input.plan.paths(caustics.paths[light], input.iteration);
        let count = (paths.end - paths.start) / points.len().max(1) as u64;
        let of_point = move |(k, sheets): (u64, &'a SheetsOfLight)| {
            let start = paths.start + k * count;
            let left = (count as f64 * sheets.regions.photon_fraction()).ceil() as u64;
            Source { light, sheets: Some(sheets), paths: start..start + left }
        };
        let alone = points.is_empty().then(|| Source { light, sheets: None, paths: paths.clone() });
        alone.into_iter().chain((0..).zip(points).map(of_point))
    };
    of_lights.iter().enumerate().flat_map(of_light).collect()
}

/// Traces caustic photon paths, which branch at glass.
struct CausticTracer<'a> {
    input: &'a PassInput<'a>,
    world: &'a World,
    caustics: &'a CausticPlan,
    source: &'a Source<'a>,
    to_map: bool,
    found: CausticPhotons,
    /// Branches of the present path still to follow.
    branches: Vec<CausticBranch>,
    /// The ways on which sheets bring the light of the present path.
    claims: &'a [Signature],
}

impl<'a> CausticTracer<'a> {
    fn new(input: &'a PassInput<'a>, caustics: &'a CausticPlan, source: &'a Source<'a>, to_map: bool) -> Self {
        let found = CausticPhotons::default();
        Self { input, world: input.world, caustics, source, to_map, found, branches: Vec::new(), claims: &[] }
    }

    /// Traces the path of this index of the source.
    fn trace(&mut self, index: u64) {
        self.found.counters.caustic_paths += 1;
        let Source { light, paths, .. } = self.source;
        // One sequence over all iterations: its points keep filling each other's gaps.
        let mut sampler = self.input.sampler(Stream::CausticPhoton, *light as u64, index);
        let Some(emission) = self.emit(&mut sampler) else { return };
        let flux = emission.flux / (paths.end - paths.start) as f32;
        self.found.energy.emitted += power(flux);
        let weak = WEAK_BRANCH * flux.max_element();
        self.branches.push(CausticBranch::from_light(self.world, *light, Emission { flux, ..emission }));
        while let Some(branch) = self.branches.pop() {
            self.follow(branch, weak, &mut sampler);
        }
    }

    /// The first ray of a path, towards mirrors and glass; where the light has sheets, towards what they leave to photons.
    fn emit(&mut self, sampler: &mut Sampler) -> Option<Emission> {
        self.claims = &[];
        let light = self.source.light;
        let Some(SheetsOfLight { pencil, regions }) = self.source.sheets else {
            return self.caustics.projection_maps[light].emit(&self.world.lights[light], sampler);
        };
        let (square, density, claims) = regions.sample(sampler.next_2d());
        self.claims = claims;
        let emission = pencil.ray(square)?;
        Some(Emission { flux: emission.flux / density as f32, ..emission })
    }

    /// Follows a branch to the next surface: leaves a photon where the surface scatters, branches off where it mirrors or refracts.
    fn follow(&mut self, mut branch: CausticBranch, weak: f32, sampler: &mut Sampler) {
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
    fn divide_energy(&mut self, branch: &CausticBranch, vertex: &Vertex, goes_on: bool) {
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
    fn branch_off(&mut self, branch: &CausticBranch, vertex: &Vertex, weak: f32, sampler: &mut Sampler) {
        for way in branch.ways_on(self.world, vertex) {
            let flux = branch.flux * way.0.tint * way.0.fraction as f32;
            let survival = roulette(flux.max_element(), weak, sampler);
            self.found.energy.branch(branch.flux, &way.0, &vertex.scattering.lobe, survival);
            if let Some(survival) = survival {
                self.branches.push(branch.along(self.world, vertex, way, flux / survival));
            }
        }
    }

    /// Leaves a photon in the map, on the film, or both; neither where a sheet brings the light.
    fn leave_photon(&mut self, branch: &CausticBranch, vertex: &Vertex) {
        if !branch.flux.is_finite() {
            self.found.counters.dropped_samples += 1;
            return;
        }
        if self.claims.contains(&branch.signature.arrived(vertex.side)) {
            self.found.energy.stored += power(branch.flux);
            self.found.energy.sheets += power(branch.flux);
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
    fn splat(&mut self, branch: &CausticBranch, vertex: &Vertex) {
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
    use crate::transport::pass::Cancel;
    use crate::transport::plan::Plan;
    use crate::transport::testing::{self, lamp, quad, sphere};
    use glam::DVec2;
    use std::collections::BTreeMap;
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

    /// What photons alone bring.
    fn found(world: &World, iterations: u64) -> Vec<CausticPhotons> {
        let mut plan = Plan::new(world);
        if let Some(caustics) = &mut plan.caustics {
            caustics.sheets = vec![false; world.lights.len()];
        }
        passes(world, &plan, iterations)
    }

    fn passes(world: &World, plan: &Plan, iterations: u64) -> Vec<CausticPhotons> {
        let pass = |k| caustic_photon_pass(&PassInput::uncancelled(world, plan, 1, 4 + k)).expect("never cancelled");
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

    /// The flux that a map of photons and the sheets of an iteration bring to each side of a surface, after each number of events.
    fn flux_by_tag(pass: &CausticPhotons) -> BTreeMap<u32, f64> {
        let mut by_tag = BTreeMap::new();
        let of_photons = pass.photons.iter().map(|photon| (photon.tag, photon.flux));
        for (tag, flux) in of_photons.chain(pass.sheets.fluxes()) {
            *by_tag.entry(tag).or_insert(0.0) += power(flux);
        }
        by_tag
    }

    /// By [`photons_carry_the_light_that_meets_the_mirror`].
    #[test]
    fn sheets_and_photons_share_the_light_of_a_mirror() {
        let world = lit_by_a_mirror(16);
        let pass = &passes(&world, &Plan::new(&world), 1)[0];
        let of_photons: f64 = pass.photons.iter().map(|photon| power(photon.flux)).sum();
        let all: f64 = flux_by_tag(pass).values().sum();
        let a2 = HALF * HALF;
        let expected = 3.0 * 0.8 * 4.0 * (a2 / (a2 + TO_MIRROR * TO_MIRROR)).asin();
        assert!((all / expected - 1.0).abs() < 0.003, "{all} instead of {expected}");
        assert!(of_photons < 0.05 * all, "photons bring the rim of the mirror: {of_photons} of {all}");
        let left = &pass.counters.caustic_paths;
        assert!(*left < 16_384 / 3, "{left} paths");
    }

    /// A mirror that lies between the rays of the coarse lattice is found by the finer one: no photon has to bring the light of many.
    #[test]
    fn thin_mirrors_leave_no_bright_photons() {
        let thin = [[-HALF, 0.0, 4.5 + TO_MIRROR], [0.0, 0.012, 0.0], [2.0 * HALF, 0.0, 0.0]];
        let screen = "[[object]]\nname = \"screen\"\ntype = \"plane\"\nmaterial = \"grey\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n";
        let world = testing::world(&[&quad("mirror", thin, "mirror"), screen, &lamp([0.0, 0.0, 4.5])].concat());
        let plan = Plan::new(&world);
        for iteration in 4..12 {
            let input = PassInput::uncancelled(&world, &plan, 1, iteration);
            let pass = caustic_photon_pass(&input).expect("never cancelled");
            let all: f64 = flux_by_tag(&pass).values().sum();
            let brightest = pass.photons.iter().map(|photon| power(photon.flux)).fold(0.0, f64::max);
            assert!(brightest < 2e-3 * all, "a photon of {brightest} of {all} in iteration {iteration}");
        }
    }

    /// Light that glass divides in the glass, with a mirror and a tinted pane behind it: every sheet of it holds the flux of its photons.
    #[test]
    fn sheets_and_photons_share_the_light_of_glass() {
        let glass = "[[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5\ntint = [0.9, 0.8, 0.7]\nabsorption = [0.5, 0.2, 0.1]\n";
        let objects = [
            quad("floor", [[-3.0, -1.0, 3.0], [6.0, 0.0, 0.0], [0.0, 0.0, -6.0]], "grey"),
            quad("mirror", [[-2.0, -1.0, -1.5], [4.0, 0.0, 0.0], [0.0, 3.0, 0.0]], "mirror"),
            sphere("ball", [0.0, -0.3, 0.0], 0.6, "glass"),
            lamp([0.5, 2.5, 0.8]),
        ];
        let world = testing::world(&[glass, &objects.concat()].concat());
        let mut plan = Plan::new(&world);
        // Not chosen by the plan, because it takes long; right nevertheless.
        plan.caustics.iter_mut().for_each(|caustics| caustics.sheets.fill(true));
        let [sheets, photons] = [passes(&world, &plan, 4), found(&world, 4)].map(|passes| {
            let mut sum = BTreeMap::new();
            for (tag, flux) in passes.iter().flat_map(flux_by_tag) {
                *sum.entry(tag).or_insert(0.0) += flux / 4.0;
            }
            sum
        });
        let all: f64 = photons.values().sum();
        assert!(photons.len() > 4, "several ways: {photons:?}");
        let by_sheets = passes(&world, &plan, 1)[0].sheets.fluxes().map(|(_, flux)| power(flux)).sum::<f64>();
        assert!(by_sheets > 0.7 * all, "{by_sheets} of {all}");
        for (tag, expected) in photons {
            let found = sheets.get(&tag).copied().unwrap_or(0.0);
            assert!((found - expected).abs() < 0.004 * all + 0.02 * expected, "{found} instead of {expected} of {all}");
        }
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
