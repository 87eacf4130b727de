//! Paths from the camera: to what emits, to direct light, and to the visible points where photons will be gathered.

use super::bsdf;
use super::counters::Counters;
use super::direct::{self, Shown, Vertex};
use super::lobe_light::LobeView;
use super::medium::Media;
use super::photon;
use super::pixel_samples::{MOST_SAMPLES, PixelSamples};
use super::plan::Plan;
use super::{Cancel, Rows};
use crate::geometry::{Hit, Primitive};
use crate::math::{LANES, Ray, Rgb, Sampler, Stream, sobol};
use crate::world::{Lobe, Scattering, Surface, SurfacePoint, World};
use arrayvec::ArrayVec;
use glam::{DVec2, DVec3, Vec3};
use std::ops::Range;

/// Both sides of an interface are followed this often on a path; then one is chosen at random.
const FOLLOWED_SPLITS: u32 = 2;
/// Branches with less throughput than this are continued at random.
const WEAK_BRANCH: f32 = 0.02;
/// Enough for two branches at each followed split and one continuation each.
const MAX_BRANCHES: usize = 16;
/// Samples of a pixel that gather light where it shows different surfaces.
const SAMPLES_OF_EDGE: usize = 4;
/// Columns of a tile, whose rows are those of the pass.
const TILE: u32 = 16;

/// A point that the camera sees, directly or in mirrors and through glass, and that scatters light.
#[derive(Clone, Copy, Debug)]
pub struct VisiblePoint {
    /// Row by row from the top of the film.
    pub pixel: u32,
    /// Relative to the middle of the world.
    pub position: Vec3,
    /// Geometric unit normal on the seen side.
    pub n_side: Vec3,
    /// Shading unit normal on the seen side.
    pub n_shade: Vec3,
    /// Towards where it is seen from.
    pub wo: Vec3,
    /// What the camera keeps of light that leaves towards `wo`.
    pub throughput: Rgb,
    /// How it scatters.
    pub scattering: Scattering,
    /// Side of the pixel's footprint, scene units.
    pub footprint: f32,
    /// To other objects.
    pub clearance: Clearance,
    /// Where on which primitive.
    pub primitive: u32,
    /// Parameters on it.
    pub uv: DVec2,
    /// First tag of the photons on the same surface and side.
    pub tag: u32,
    /// Scattering events that a photon may have behind it to be counted here.
    pub photon_bounces: u32,
    /// Mean of the albedos that the pixel's paths found on the same surface.
    pub mean_albedo: Rgb,
    /// How far from here they met it at most, scene units.
    pub spread: f32,
    /// Where its facets begin among those of the batch, if it has any.
    pub first_facet: u32,
    /// How many it has.
    pub facets: u32,
    /// Whether nothing is between it and the camera.
    pub seen_directly: bool,
    /// Whether paths of its pixel met different surfaces first, or one and none.
    pub on_an_edge: bool,
    /// How far a Phong lobe that it is seen in scatters the places that are seen there, scene units; 0 if there is none.
    pub blur: f32,
}

/// What a path of a pixel met where others of its paths met the same surface.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// Shading unit normal on the seen side.
    pub normal: Vec3,
    /// Part reflected by Lambert's law.
    pub albedo: Rgb,
    /// First tag of the photons on the same surface and side.
    pub tag: u32,
    /// Relative to the middle of the world.
    pub position: Vec3,
}

/// How far other objects are from a point, scene units, no more than matters for density estimates.
#[derive(Clone, Copy, Debug)]
pub struct Clearance {
    /// To the next one; 0 on a patch, whose own curves are near.
    pub any: f64,
    /// To the next one that stands on a quad or a plane, not only along its edges; infinite where none matters.
    pub standing: f64,
}

impl Clearance {
    /// Where nothing is near.
    const FREE: Self = Self { any: f64::INFINITY, standing: f64::INFINITY };
}

/// What the camera pass finds out about some rows of the film.
#[derive(Clone, Debug, Default)]
pub struct CameraBatch {
    /// Where photons are to be gathered, tile by tile.
    pub visible_points: Vec<VisiblePoint>,
    /// Of visible points on surfaces with relief maps: light is gathered once for all of a point's facets.
    pub facets: Vec<Facet>,
    /// For each pixel of the rows the samples of emitted and direct light.
    pub samples: Vec<PixelSamples>,
    /// What was done.
    pub counters: Counters,
}

/// The samples of an iteration for every pixel of some rows, tile by tile: visible points that follow each other are near
/// each other, and so are their photons. `None` when cancelled.
pub fn camera_pass(
    world: &World,
    plan: &Plan,
    rows: &Rows,
    seed: u64,
    iteration: u64,
    cancel: Cancel,
) -> Option<CameraBatch> {
    let width = plan.camera.width;
    let pixels = rows.len() * width as usize;
    let batch = CameraBatch { samples: vec![PixelSamples::default(); pixels], ..CameraBatch::default() };
    let mut walk = Walk {
        world,
        plan,
        batch,
        branches: ArrayVec::new(),
        gather_weight: 0.0,
        facets: ArrayVec::new(),
        has_relief: false,
        is_textured: false,
    };
    for left in (0..width).step_by(TILE as usize) {
        if cancel.is_cancelled() {
            return None;
        }
        for row in rows.clone() {
            let columns = left..(left + TILE).min(width);
            let mut starts = walk.starts(row, columns.clone(), seed, iteration);
            let mut rest = starts.as_mut_slice();
            for column in columns {
                let pixel = row * width + column;
                let own = rest.split_off_mut(..plan.camera_samples(pixel, iteration).count()).unwrap_or_default();
                let place = ((row - rows.start) * width + column) as usize;
                walk.batch.samples[place] = walk.sample_pixel(pixel, own, iteration);
            }
        }
    }
    Some(walk.batch)
}

struct Walk<'a> {
    world: &'a World,
    plan: &'a Plan,
    batch: CameraBatch,
    branches: ArrayVec<Branch, MAX_BRANCHES>,
    /// Weight of the present path's visible points in their pixel; it leaves none if this is 0.
    gather_weight: f32,
    /// What the present pixel's paths met first.
    facets: ArrayVec<Facet, MOST_SAMPLES>,
    /// Whether a relief map tilts any of them.
    has_relief: bool,
    /// Whether any of them has a texture.
    is_textured: bool,
}

/// A path as far as the first surface.
struct Start {
    sampler: Sampler,
    ray: Ray,
    hit: Option<Hit>,
}

/// One way that a path from the camera goes on.
#[derive(Clone, Debug)]
struct Branch {
    ray: Ray,
    throughput: Rgb,
    media: Media,
    /// Scattering events so far.
    bounces: u32,
    splits: u32,
    /// Length of the path so far.
    distance: f64,
    last: Last,
    /// The last lobe behind it, if there is any.
    seen_in: Option<LobeView>,
}

/// The last event before a branch.
#[derive(Clone, Copy, Debug)]
enum Last {
    /// The camera, mirrors and glass: nothing else finds what emits here, unless a lobe is behind them.
    Specular,
    /// A Phong lobe at this point with this density of the direction; perhaps itself shown in another one.
    Glossy { from: DVec3, pdf: f64, shown: Option<Shown> },
}

impl Walk<'_> {
    /// All samples of an iteration for some pixels of a row, pixel by pixel, as far as the first surface: rays side by side
    /// go down the trees together.
    fn starts(&mut self, row: u32, columns: Range<u32>, seed: u64, iteration: u64) -> Vec<Start> {
        let camera = &self.plan.camera;
        let samples = |column| self.plan.camera_samples(row * camera.width + column, iteration);
        let mut starts: Vec<Start> = columns
            .flat_map(|column| samples(column).map(move |index| (column, index)))
            .map(|(column, index)| {
                let pixel = u64::from(row * camera.width + column);
                let mut sampler = Sampler::new(seed, self.plan.stream(Stream::Camera), pixel, index);
                let ray = camera.ray(DVec2::new(f64::from(column), f64::from(row)) + sampler.next_2d());
                Start { hit: None, sampler, ray }
            })
            .collect();
        self.batch.counters.rays += starts.len() as u64;
        let mut bundles = starts.chunks_exact_mut(LANES);
        for bundle in &mut bundles {
            let hits = self.world.aggregate.closest_hits(&std::array::from_fn(|k| bundle[k].ray));
            for (start, hit) in bundle.iter_mut().zip(hits) {
                start.hit = hit;
            }
        }
        for start in bundles.into_remainder() {
            start.hit = self.world.aggregate.closest_hit(&start.ray);
        }
        starts
    }

    /// All samples of an iteration for one pixel, from their starts on. Visible points, which are most of the
    /// work, are left by some of them where they meet different surfaces, else by one of them for all.
    fn sample_pixel(&mut self, pixel: u32, starts: &mut [Start], iteration: u64) -> PixelSamples {
        let count = starts.len();
        let surface = |start: &Start| start.hit.map_or(0, |hit| hit.primitive + 1);
        let on_an_edge = starts.iter().any(|start| surface(start) != surface(&starts[0]));
        let weight = self.plan.samples_weight(pixel, iteration);
        let mut samples = PixelSamples { surface: surface(&starts[0]), weight, ..PixelSamples::default() };
        let gathering = match (self.plan.gathers(), on_an_edge) {
            (false, _) => 0,
            (true, true) => count.min(SAMPLES_OF_EDGE),
            (true, false) => 1,
        };
        // Another place in the sequence each time: every n-th point of it would keep to a part of the pixel.
        let random = sobol::mix64(u64::from(pixel) ^ sobol::mix64(iteration)) as usize;
        let first = random % (count / gathering.max(1)) * gathering;
        let first_point = self.batch.visible_points.len();
        self.facets.clear();
        (self.has_relief, self.is_textured) = (false, false);
        for (index, start) in starts.iter_mut().enumerate() {
            let gathers = (first..first + gathering).contains(&index);
            self.gather_weight = if gathers { 1.0 / gathering as f32 } else { 0.0 };
            let radiance = self.trace_path(pixel, start);
            samples.include(radiance);
        }
        samples.is_varied = on_an_edge || self.is_textured;
        self.end_points(first_point, on_an_edge);
        if !self.plan.finds_direct_light {
            PixelSamples::default()
        } else if samples.is_finite() {
            samples
        } else {
            self.batch.counters.dropped_samples += 1;
            PixelSamples::default()
        }
    }

    /// Completes the visible points of a pixel. Where its paths all met one surface first, what each of them saw of its texture
    /// and its relief may count: one place in the pixel alone is noise.
    fn end_points(&mut self, first_point: usize, on_an_edge: bool) {
        for k in (first_point..self.batch.visible_points.len()).rev() {
            let point = &mut self.batch.visible_points[k];
            point.on_an_edge = on_an_edge;
            if point.seen_directly && !on_an_edge {
                let alike = self.facets.iter().filter(|facet| facet.tag == point.tag);
                let (count, sum) =
                    alike.clone().fold((0.0, Rgb::ZERO), |(n, sum), facet| (n + 1.0, sum + facet.albedo));
                point.mean_albedo = sum / f32::max(count, 1.0);
                let distances = alike.clone().map(|facet| facet.position.distance(point.position));
                point.spread = distances.fold(0.0, f32::max);
                if self.has_relief && sum != Rgb::ZERO {
                    point.first_facet = self.batch.facets.len() as u32;
                    self.batch.facets.extend(alike);
                    point.facets = self.batch.facets.len() as u32 - point.first_facet;
                }
            }
            if point.mean_albedo == Rgb::ZERO && !scatters(&point.scattering) {
                self.batch.visible_points.swap_remove(k);
            }
        }
    }

    fn closest_hit(&mut self, ray: &Ray) -> Option<Hit> {
        self.batch.counters.rays += 1;
        self.world.aggregate.closest_hit(ray)
    }

    fn trace_path(&mut self, pixel: u32, start: &mut Start) -> Rgb {
        let sampler = &mut start.sampler;
        let first = Branch {
            ray: start.ray,
            throughput: Rgb::ONE,
            media: Media::default(),
            bounces: 0,
            splits: 0,
            distance: 0.0,
            last: Last::Specular,
            seen_in: None,
        };
        let mut radiance = self.follow(first, start.hit, pixel, sampler);
        while let Some(branch) = self.branches.pop() {
            let hit = self.closest_hit(&branch.ray);
            radiance += self.follow(branch, hit, pixel, sampler);
        }
        radiance
    }

    /// At what the branch's ray hits; returns the light that the camera gets from it without photons.
    fn follow(&mut self, mut branch: Branch, hit: Option<Hit>, pixel: u32, sampler: &mut Sampler) -> Rgb {
        let Some(hit) = hit else {
            return branch.throughput * self.world.background;
        };
        let point = self.world.surface_point(&branch.ray, hit);
        branch.throughput *= branch.media.transmittance(self.world, hit.t);
        branch.distance += hit.t;
        let (object, material) = match self.world.surfaces[hit.primitive as usize] {
            Surface::Light(light) => return self.emitted(light as usize, &branch, &point),
            Surface::Object { object, material, .. } => (object, material),
        };
        if branch.bounces >= self.world.max_bounces {
            return Rgb::ZERO;
        }
        let (scattering, n_shade) = self.world.scattering(&point, material);
        let lookups = self.world.materials[material as usize].lookups();
        self.batch.counters.texture_lookups += u64::from(lookups);
        let wo = -branch.ray.direction;
        let vertex = Vertex { point, scattering, n_side: point.n_side(), n_shade, wo, seen_in: branch.seen_in };
        let is_first = branch.bounces == 0;
        self.is_textured |= is_first && lookups > 0;
        if is_first && self.plan.gathers() {
            let tag = photon::tag(object, point.front, 0);
            let position = (vertex.point.position - self.world.center).as_vec3();
            self.facets.push(Facet { normal: n_shade.as_vec3(), albedo: scattering.albedo, tag, position });
            self.has_relief |= n_shade != vertex.n_side;
        }
        let mut radiance = Rgb::ZERO;
        if scatters(&scattering) && self.plan.finds_direct_light {
            let direct = direct::direct_light(self.world, self.plan, &vertex, sampler, &mut self.batch.counters);
            radiance = branch.throughput * direct;
        }
        // Where a texture is black, the rest of it in the pixel may not be.
        if self.gather_weight > 0.0 && (scatters(&scattering) || (is_first && lookups > 0)) {
            self.batch.visible_points.push(self.visible_point(&branch, &vertex, pixel, object));
        }
        self.branch_off(&branch, &vertex, material, sampler);
        radiance
    }

    fn visible_point(&self, branch: &Branch, vertex: &Vertex, pixel: u32, object: u32) -> VisiblePoint {
        let footprint = self.plan.camera.footprint(branch.distance);
        let wanted = self.plan.wanted_clearance(footprint);
        VisiblePoint {
            pixel,
            clearance: wanted.map_or(Clearance::FREE, |limits| self.clearance(&vertex.point, object, limits)),
            position: (vertex.point.position - self.world.center).as_vec3(),
            n_side: vertex.n_side.as_vec3(),
            n_shade: vertex.n_shade.as_vec3(),
            wo: vertex.wo.as_vec3(),
            throughput: branch.throughput * self.gather_weight,
            scattering: vertex.scattering,
            footprint: footprint as f32,
            primitive: vertex.point.hit.primitive,
            uv: DVec2::new(vertex.point.hit.u, vertex.point.hit.v),
            tag: photon::tag(object, vertex.point.front, 0),
            photon_bounces: (self.world.max_bounces - branch.bounces - 1).min(photon::MAX_TAG_BOUNCES),
            mean_albedo: vertex.scattering.albedo,
            spread: 0.0,
            first_facet: 0,
            facets: 0,
            seen_directly: branch.bounces == 0,
            on_an_edge: false,
            blur: branch.seen_in.map_or(0.0, |lobe| lobe.blur(branch.distance) as f32),
        }
    }

    /// How far other objects are, up to these limits.
    fn clearance(&self, point: &SurfacePoint, object: u32, limits: Clearance) -> Clearance {
        let primitives = self.world.aggregate.primitives();
        let primitive = &primitives[point.hit.primitive as usize];
        if matches!(primitive, Primitive::Patch(_)) {
            return Clearance { any: 0.0, standing: f64::INFINITY };
        }
        let is_own = |p: u32| matches!(self.world.surfaces[p as usize], Surface::Object { object: other, .. } if other == object);
        let any = self.world.aggregate.distance(point.position, limits.any, |p| !is_own(p));
        let stands = |p: u32| match primitive {
            Primitive::Quad(quad) => !is_own(p) && !primitives[p as usize].is_beside(quad),
            Primitive::Plane(_) => !is_own(p),
            Primitive::Sphere(_) | Primitive::Patch(_) => false,
        };
        let standing = (any < limits.standing)
            .then(|| self.world.aggregate.distance(point.position, limits.standing, stands))
            .filter(|standing| *standing < limits.standing);
        Clearance { any, standing: standing.unwrap_or(f64::INFINITY) }
    }

    /// Light that the camera gets from a light's own surface.
    fn emitted(&self, index: usize, branch: &Branch, point: &SurfacePoint) -> Rgb {
        let light = &self.world.lights[index];
        let direction = branch.ray.direction;
        let radiance = branch.throughput * light.emitted(point.n_geom, -direction);
        match branch.last {
            // Caustic photons find the same.
            Last::Specular if branch.seen_in.is_some() => Rgb::ZERO,
            Last::Specular => radiance,
            Last::Glossy { from, pdf, shown } => {
                let pdf_direct = direct::pdf_light(light, from, direction, from.distance(point.position), point.n_geom);
                let part = direct::camera_part(self.world, self.plan, index, point.position, shown);
                radiance * (part * pdf / (pdf + pdf_direct)) as f32
            }
        }
    }

    /// Continues along mirrors, glass and Phong lobes.
    fn branch_off(&mut self, branch: &Branch, vertex: &Vertex, material: u32, sampler: &mut Sampler) {
        let mirrored = || bsdf::reflect_above(vertex.wo, vertex.n_shade, vertex.n_side);
        match vertex.scattering.lobe {
            Lobe::None => {}
            Lobe::Mirror { reflectance } => {
                self.push(branch.specular(vertex, self.world, mirrored(), reflectance), sampler)
            }
            Lobe::Glass { tint, .. } => self.branch_at_interface(branch, vertex, material, tint, sampler),
            Lobe::Phong { .. } => {
                let u = sampler.next_2d();
                let sampled = bsdf::sample_glossy(&vertex.scattering, vertex.n_shade, vertex.n_side, vertex.wo, u);
                if let Some((wi, weight)) = sampled {
                    let pdf = bsdf::pdf_glossy(&vertex.scattering, vertex.n_shade, vertex.wo, wi);
                    let mut next = branch.specular(vertex, self.world, wi, weight);
                    next.last = Last::Glossy { from: vertex.point.position, pdf, shown: vertex.shown(wi) };
                    next.seen_in = self.plan.lobe_light.view(
                        &vertex.point,
                        &self.world.materials[material as usize],
                        &vertex.scattering,
                        wi,
                        branch.distance,
                    );
                    self.push(next, sampler);
                }
            }
        }
    }

    fn branch_at_interface(
        &mut self,
        branch: &Branch,
        vertex: &Vertex,
        material: u32,
        tint: Rgb,
        sampler: &mut Sampler,
    ) {
        let entering = vertex.point.front;
        let eta = branch.media.eta(self.world, material, entering);
        let fresnel = bsdf::fresnel(vertex.wo.dot(vertex.n_shade), eta);
        let mirrored = bsdf::reflect_above(vertex.wo, vertex.n_shade, vertex.n_side);
        let mut reflected = branch.specular(vertex, self.world, mirrored, Rgb::ONE);
        if fresnel.reflectance >= 1.0 {
            return self.push(reflected, sampler);
        }
        // Radiance is squeezed into a smaller solid angle in the denser medium: by eta^2, which light that travels
        // from the lights does not feel.
        let direction = bsdf::refract(vertex.wo, vertex.n_shade, eta, fresnel.cos_transmitted);
        let mut refracted = branch.specular(vertex, self.world, direction, tint / (eta * eta) as f32);
        refracted.media = branch.media.crossed(material, entering);
        if branch.splits < FOLLOWED_SPLITS {
            reflected.throughput *= fresnel.reflectance as f32;
            refracted.throughput *= (1.0 - fresnel.reflectance) as f32;
            (reflected.splits, refracted.splits) = (branch.splits + 1, branch.splits + 1);
            self.push(reflected, sampler);
            self.push(refracted, sampler);
        } else {
            let is_reflected = sampler.next_1d() < fresnel.reflectance;
            self.push(if is_reflected { reflected } else { refracted }, sampler);
        }
    }

    fn push(&mut self, mut branch: Branch, sampler: &mut Sampler) {
        let strength = branch.throughput.max_element();
        if strength < WEAK_BRANCH {
            let survival = strength / WEAK_BRANCH;
            if sampler.next_1d() >= f64::from(survival) {
                return;
            }
            branch.throughput /= survival;
        }
        if self.branches.try_push(branch).is_err() {
            self.batch.counters.dropped_samples += 1;
        }
    }
}

impl Branch {
    /// The branch after a mirror-like event with this weight.
    fn specular(&self, vertex: &Vertex, world: &World, direction: DVec3, weight: Rgb) -> Self {
        Self {
            ray: Ray::new(world.leave(&vertex.point, direction), direction),
            throughput: self.throughput * weight,
            media: self.media.clone(),
            bounces: self.bounces + 1,
            splits: self.splits,
            distance: self.distance,
            last: Last::Specular,
            seen_in: self.seen_in,
        }
    }
}

/// Whether a surface sends light to where no mirror would.
fn scatters(scattering: &Scattering) -> bool {
    scattering.albedo != Rgb::ZERO || matches!(scattering.lobe, Lobe::Phong { .. })
}
