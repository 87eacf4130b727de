//! One camera path, which branches at glass.

use super::batch::CameraBatch;
use super::clearance::clearance;
use super::first_hit::facet;
use super::pixel::Pixel;
use crate::geometry::Hit;
use crate::math::{Ray, Rgb, Sampler};
use crate::transport::lights::{DirectLight, SeenBy, direct};
use crate::transport::photons::{Signature, photon};
use crate::transport::plan::Plan;
use crate::transport::points::{
    Clearance, MisVertex, SpecularEvent, Vertex, ViewingLobe, VisiblePoint, bsdf, roulette,
};
use crate::world::{Lobe, Media, Surface, World};
use arrayvec::ArrayVec;
use glam::{DVec2, DVec3};

/// Interfaces of a path at which both sides are followed; at further interfaces a random side is. Two cover the reflection and the view
/// through a glass object; more would double the work for weaker and weaker branches.
const FOLLOWED_SPLITS: u32 = 2;
/// Throughput below which a branch ends at random: it would cost as much as a bright branch.
const WEAK_BRANCH: f32 = 0.02;
/// Most open branches: two at each followed split, with one continuation each.
const MAX_BRANCHES: usize = 16;

/// Traces the camera paths of some rows.
pub(super) struct CameraTracer<'a> {
    world: &'a World,
    plan: &'a Plan,
    direct: DirectLight<'a>,
    /// Samples and visible points of the paths so far.
    pub(super) batch: CameraBatch,
    /// Branches of the present path still to follow.
    branches: ArrayVec<Branch, MAX_BRANCHES>,
}

/// One branch of a camera path.
#[derive(Clone, Debug)]
struct Branch {
    ray: Ray,
    throughput: Rgb,
    media: Media,
    /// Scattering events so far.
    bounces: u32,
    /// Interfaces so far at which both sides were followed.
    splits: u32,
    /// Length of the path so far, scene units.
    distance: f64,
    last: LastEvent,
    /// Weight in the pixel of the visible points that the path leaves; 0 for a path that leaves none.
    gather_weight: f32,
    /// The last Phong lobe of the path.
    viewing_lobe: Option<ViewingLobe>,
    /// The mirrors and glass so far.
    signature: Signature,
}

/// The last event of a branch.
#[derive(Clone, Copy, Debug)]
enum LastEvent {
    /// The camera, a mirror or glass: no other technique finds emission here, except behind a Phong lobe.
    Specular,
    /// A Phong lobe at the point `from`, with this density of the direction; `seen` if another lobe shows it.
    Glossy { from: DVec3, pdf: f64, seen: Option<MisVertex> },
}

impl<'a> CameraTracer<'a> {
    /// A tracer that found nothing yet.
    pub(super) fn new(world: &'a World, plan: &'a Plan, batch: CameraBatch) -> Self {
        let direct = DirectLight {
            world,
            light_sampler: &plan.light_sampler,
            photon_emissions: &plan.photon_emissions,
            glossy_mis: &plan.glossy_mis,
        };
        Self { world, plan, direct, batch, branches: ArrayVec::new() }
    }

    /// Traces a path whose first ray met `hit`; returns the radiance of emission and direct light. Leaves visible points with this weight
    /// in the pixel, none for 0.
    #[inline]
    pub(super) fn trace(
        &mut self,
        pixel: &mut Pixel,
        ray: Ray,
        hit: Option<Hit>,
        gather_weight: f32,
        sampler: &mut Sampler,
    ) -> Rgb {
        let first = Branch {
            ray,
            throughput: Rgb::ONE,
            media: self.world.camera_media.clone(),
            bounces: 0,
            splits: 0,
            distance: 0.0,
            last: LastEvent::Specular,
            gather_weight,
            viewing_lobe: None,
            signature: Signature::default(),
        };
        let mut radiance = self.follow(first, hit, pixel, sampler);
        while let Some(branch) = self.branches.pop() {
            self.batch.counters.rays += 1;
            let hit = self.world.aggregate.closest_hit(&branch.ray);
            radiance += self.follow(branch, hit, pixel, sampler);
        }
        radiance
    }

    /// Follows a branch whose ray met `hit`; returns the radiance of emission and direct light there.
    fn follow(&mut self, mut branch: Branch, hit: Option<Hit>, pixel: &mut Pixel, sampler: &mut Sampler) -> Rgb {
        let Some(hit) = hit else {
            return branch.throughput * self.world.background;
        };
        let hit = self.world.on_opaque(&branch.ray, hit);
        branch.throughput *= self.world.transmittance(&branch.media, hit.t);
        branch.distance += hit.t;
        let ids = match self.world.surfaces[hit.primitive as usize] {
            Surface::Light(light) => return self.emitted(light as usize, &branch, hit),
            Surface::Object { front_side, material, .. } => [front_side, material],
        };
        if branch.bounces >= self.world.max_bounces {
            return Rgb::ZERO;
        }
        let vertex = Vertex::at_hit(self.world, &branch.ray, hit, ids, &mut self.batch.counters);
        let is_textured_first = branch.bounces == 0 && vertex.material(self.world).lookups() > 0;
        if branch.bounces == 0 {
            self.add_first_vertex(&vertex, is_textured_first, pixel);
        }
        let mut radiance = Rgb::ZERO;
        if vertex.scatters() && self.plan.finds_direct_light {
            let seen_by = SeenBy { media: &branch.media, viewing_lobe: branch.viewing_lobe, length: branch.distance };
            let direct = self.direct.radiance(&vertex, seen_by, sampler, &mut self.batch.counters);
            radiance = branch.throughput * direct;
        }
        // A texture that is black here may not be black elsewhere in the pixel.
        if branch.gather_weight > 0.0 && (vertex.scatters() || is_textured_first) {
            self.batch.visible_points.push(self.visible_point(&branch, &vertex, pixel));
        }
        self.branch_off(&branch, &vertex, sampler);
        radiance
    }

    fn add_first_vertex(&self, vertex: &Vertex, is_textured: bool, pixel: &mut Pixel) {
        pixel.is_textured |= is_textured;
        if self.plan.gathers() || !self.batch.first_hits.is_empty() {
            pixel.add(facet(self.world, vertex), vertex.n_shade != vertex.n_side);
        }
    }

    fn visible_point(&self, branch: &Branch, vertex: &Vertex, pixel: &Pixel) -> VisiblePoint {
        let footprint = self.plan.camera.footprint(branch.distance);
        let wanted = self.plan.wanted_clearance(footprint);
        VisiblePoint {
            pixel: pixel.index,
            in_pixel: pixel.position,
            way: branch.viewing_lobe.is_none().then(|| branch.signature.short()),
            clearance: wanted.map_or(Clearance::FREE, |limits| clearance(self.world, vertex, limits)),
            position: (vertex.point.position - self.world.view.origin).as_vec3(),
            n_side: vertex.n_side.as_vec3(),
            n_shade: vertex.n_shade.as_vec3(),
            wo: vertex.wo.as_vec3(),
            throughput: branch.throughput * branch.gather_weight,
            scattering: vertex.scattering,
            footprint: footprint as f32,
            primitive: vertex.point.hit.primitive,
            uv: DVec2::new(vertex.point.hit.u, vertex.point.hit.v),
            tag: photon::tag(vertex.side, 0),
            photon_bounces: (self.world.max_bounces - branch.bounces - 1).min(photon::MAX_TAG_BOUNCES),
            mean_albedo: vertex.scattering.albedo,
            spread: 0.0,
            first_facet: 0,
            facets: 0,
            seen_directly: branch.bounces == 0,
            on_an_edge: false,
            blur: branch.viewing_lobe.map_or(0.0, |lobe| lobe.blur(branch.distance) as f32),
        }
    }

    /// Radiance from a light's own surface, which a branch met.
    fn emitted(&self, index: usize, branch: &Branch, hit: Hit) -> Rgb {
        let point = self.world.surface_point(&branch.ray, hit);
        let light = &self.world.lights[index];
        let direction = branch.ray.direction;
        let radiance = branch.throughput * light.emitted(point.n_geom, -direction);
        match branch.last {
            // Caustic photons find the same light.
            LastEvent::Specular if branch.viewing_lobe.is_some() => Rgb::ZERO,
            LastEvent::Specular => radiance,
            LastEvent::Glossy { from, pdf, seen } => {
                let pdf_direct = direct::pdf_light(light, from, direction, from.distance(point.position));
                let weight = self.direct.camera_weight(index, point.position, seen);
                radiance * (weight * pdf / (pdf + pdf_direct)) as f32
            }
        }
    }

    /// Goes on along mirrors, glass and Phong lobes.
    fn branch_off(&mut self, branch: &Branch, vertex: &Vertex, sampler: &mut Sampler) {
        if matches!(vertex.scattering.lobe, Lobe::Phong { .. }) {
            return self.branch_in_lobe(branch, vertex, sampler);
        }
        let Some(event) = SpecularEvent::at(self.world, vertex, &branch.media) else { return };
        let object = self.world.object_of(vertex.point.hit.primitive).unwrap_or(u32::MAX);
        if event.is_divided() && branch.splits < FOLLOWED_SPLITS {
            let refracted = event.refracted.map(|next| (next, branch.signature.refracted(object)));
            for (next, signature) in
                [Some((event.reflected, branch.signature.reflected(object))), refracted].into_iter().flatten()
            {
                let fraction = next.fraction as f32;
                let mut split = branch.after(self.world, vertex, next.direction, next.radiance_weight());
                split.throughput *= fraction;
                split.splits += 1;
                split.signature = signature;
                split.bounces = next.bounces_after(branch.bounces);
                split.media = next.media;
                self.push(split, sampler);
            }
        } else {
            // A number is drawn only where there is a choice.
            let u = if event.is_divided() { sampler.next_1d() } else { 0.0 };
            let (is_reflected, next) = event.choose(u);
            let mut single = branch.after(self.world, vertex, next.direction, next.radiance_weight());
            single.bounces = next.bounces_after(branch.bounces);
            single.signature =
                if is_reflected { branch.signature.reflected(object) } else { branch.signature.refracted(object) };
            single.media = next.media;
            self.push(single, sampler);
        }
    }

    fn branch_in_lobe(&mut self, branch: &Branch, vertex: &Vertex, sampler: &mut Sampler) {
        let u = sampler.next_2d();
        let sampled = bsdf::sample_glossy(&vertex.scattering, vertex.n_shade, vertex.n_side, vertex.wo, u);
        let Some((wi, weight)) = sampled else { return };
        let pdf = bsdf::pdf_glossy(&vertex.scattering, vertex.n_shade, vertex.wo, wi);
        let mut next = branch.after(self.world, vertex, wi, weight);
        let seen = branch.viewing_lobe.map(|lobe| MisVertex::new(lobe, vertex, wi));
        next.last = LastEvent::Glossy { from: vertex.point.position, pdf, seen };
        next.viewing_lobe = self.plan.glossy_mis.viewing_lobe(self.world, vertex, wi, branch.distance);
        self.push(next, sampler);
    }

    fn push(&mut self, mut branch: Branch, sampler: &mut Sampler) {
        let Some(survival) = roulette(branch.throughput.max_element(), WEAK_BRANCH, sampler) else { return };
        branch.throughput /= survival;
        if self.branches.try_push(branch).is_err() {
            self.batch.counters.dropped_samples += 1;
        }
    }
}

impl Branch {
    /// The branch after a scattering event with this weight.
    fn after(&self, world: &World, vertex: &Vertex, direction: DVec3, weight: Rgb) -> Self {
        Self {
            ray: vertex.ray(world, direction),
            throughput: self.throughput * weight,
            media: self.media.clone(),
            bounces: self.bounces + 1,
            splits: self.splits,
            distance: self.distance,
            last: LastEvent::Specular,
            gather_weight: self.gather_weight,
            viewing_lobe: self.viewing_lobe,
            signature: self.signature,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Stream;
    use crate::transport::testing::{self, lamp, quad};

    /// A mirror (reflectance 0.8) in the plane z = 0 that looks to +z.
    fn mirror(half: f64) -> String {
        quad("mirror", [[-half, -half, 0.0], [2.0 * half, 0.0, 0.0], [0.0, 2.0 * half, 0.0]], "mirror")
    }

    /// One path along -z from (0.1, 0, 4): its radiance, and the batch of its tracer.
    fn traced(text: &str) -> (Rgb, CameraBatch) {
        let world = testing::world(text);
        let plan = Plan::new(&world);
        let mut tracer = CameraTracer::new(&world, &plan, CameraBatch::default());
        let mut pixel = Pixel::new();
        let ray = Ray::new(DVec3::new(0.1, 0.0, 4.0), DVec3::NEG_Z);
        let hit = world.aggregate.closest_hit(&ray);
        let radiance = tracer.trace(&mut pixel, ray, hit, 0.5, &mut Sampler::new(1, Stream::Camera, 0, 0));
        (radiance, tracer.batch)
    }

    #[test]
    fn a_lamp_in_a_mirror_has_its_radiance_times_the_reflectance() {
        let light = |edge_u: &str, edge_v: &str| {
            format!(
                "[[light]]\nname = \"l\"\ntype = \"quad\"\ncorner = [-1, -1, 6]\nedge_u = {edge_u}\nedge_v = {edge_v}\nradiance = [1, 2, 3]\n"
            )
        };
        let (x, y) = ("[2, 0, 0]", "[0, 2, 0]");
        let (radiance, batch) = traced(&(mirror(2.0) + &light(y, x)));
        assert!((radiance - 0.8 * Rgb::new(1.0, 2.0, 3.0)).length() < 1e-5, "{radiance}");
        assert!(batch.visible_points.is_empty() && batch.counters.rays == 1, "the first ray is the caller's");
        assert_eq!(traced(&(mirror(2.0) + &light(x, y))).0, Rgb::ZERO, "its back is dark");
        let (radiance, _) = traced(&(mirror(2.0) + "[render]\nbackground = [1, 1, 1]\n"));
        assert!((radiance - Rgb::splat(0.8)).length() < 1e-6, "the background in the mirror: {radiance}");
    }

    /// A wall at z = 6, lit by a lamp at z = 5, is seen after 4 + 6 units: radiance `albedo / pi * I / d^2`, times 0.8 in the mirror.
    #[test]
    fn a_wall_in_a_mirror_is_a_visible_point() {
        let wall = quad("wall", [[-3.0, -3.0, 6.0], [0.0, 6.0, 0.0], [6.0, 0.0, 0.0]], "grey");
        let scene = [&mirror(2.0), &wall, &lamp([0.1, 0.0, 5.0]), "[render]\nmax_bounces = 7\n"].concat();
        let (radiance, batch) = traced(&scene);
        assert!((f64::from(radiance.x) - 0.8 * 0.5 / std::f64::consts::PI).abs() < 1e-5, "{radiance}");
        let [point] = batch.visible_points.as_slice() else { panic!("{} points", batch.visible_points.len()) };
        assert!((point.throughput - Rgb::splat(0.8 * 0.5)).length() < 1e-6, "reflectance times the gather weight");
        assert!(!point.seen_directly && point.photon_bounces == 5, "of 7 events the mirror and the wall take two");
        let expected = testing::world(&scene).camera.footprint(10.0);
        assert!((f64::from(point.footprint) / expected - 1.0).abs() < 1e-6, "over the whole path");
    }

    #[test]
    fn facing_mirrors_end_at_the_bounce_limit() {
        let facing = quad("facing", [[-2.0, -2.0, 6.0], [0.0, 4.0, 0.0], [4.0, 0.0, 0.0]], "mirror");
        let background = "[render]\nbackground = [1, 1, 1]\nmax_bounces = 6\n";
        let (radiance, batch) = traced(&[&mirror(2.0), &facing, background].concat());
        assert_eq!((radiance, batch.counters.rays), (Rgb::ZERO, 6));
    }
}
