//! The gather pass: photons to radiance, by density estimates at visible points.

use super::camera::CameraBatch;
use super::gathered::{Gathered, GatheredBatch};
use super::input::PassInput;
use super::interleaving::Interleaving;
use super::pixel_footprint::{PixelFootprint, PointsByPixel};
use super::visible_parts::{self, VisibleParts};
use crate::math::lanes::simd_dispatch;
use crate::math::{Lanes, Rgb, Stream};
use crate::transport::counters::Counters;
use crate::transport::density::bandwidth::WIDER;
use crate::transport::density::disc::Disc;
use crate::transport::density::estimate::{self, is_diffuse, is_glossy};
use crate::transport::density::visibility_polygon::{VisibilityPolygon, VisibilityQuery};
use crate::transport::light_sheets::{LightSheets, SheetQuery};
use crate::transport::photons::photon_map::Stack;
use crate::transport::photons::{MapKind, Maps};
use crate::transport::plan::IterationRadii;
use crate::transport::points::{Facet, VisiblePoint, bsdf};
use crate::world::Scattering;
use arrayvec::ArrayVec;
use glam::DVec3;
use std::f32::consts::FRAC_1_PI;

/// Visible points between two checks whether the pass was cancelled, about a millisecond of work. Larger blocks react later to an edit and
/// take more of the stack; smaller ones enter vector code more often.
const POINTS_PER_BLOCK: usize = 1024;

/// The light that the photons of these maps bring to the visible points of a batch; `None` when cancelled.
pub fn gather(input: &PassInput, maps: &Maps, sheets: &LightSheets, seen: &CameraBatch) -> Option<GatheredBatch> {
    let points = seen.visible_points.as_slice();
    let radii = input.plan.radii_of(input.world, input.iteration);
    let by_pixel = PointsByPixel::new(if sheets.is_empty() { &[] } else { points }, &input.plan.camera);
    let gatherer = Gatherer { input: *input, maps, sheets, by_pixel, facets: &seen.facets, radii };
    let mut stack = Stack::new();
    let interleaving = gatherer.interleaving(points);
    let mut counters = Counters { global_gathers: interleaving.gathering.len() as u64, ..Counters::default() };
    let mut irradiances = Vec::with_capacity(interleaving.gathering.len());
    for gathering in interleaving.gathering.chunks(POINTS_PER_BLOCK) {
        irradiance_block(&gatherer, points, gathering, &mut stack, &mut irradiances);
        if input.cancel.is_cancelled() {
            return None;
        }
    }
    let mut gathered = Vec::with_capacity(points.len());
    for (points, source) in points.chunks(POINTS_PER_BLOCK).zip(interleaving.source.chunks(POINTS_PER_BLOCK)) {
        let interleaved = source.iter().map(|source| source.map(|source| irradiances[source as usize]));
        let interleaved: ArrayVec<Option<Rgb>, POINTS_PER_BLOCK> = interleaved.collect();
        gather_block(&gatherer, points, &interleaved, &mut stack, &mut counters, &mut gathered);
        if input.cancel.is_cancelled() {
            return None;
        }
    }
    Some(GatheredBatch { points: gathered, counters })
}

simd_dispatch! {
    /// Appends the irradiance of interreflection at the points with the indices `gathering`, whose neighbours take it, too.
    fn irradiance_block(
        l: impl Lanes,
        gatherer: &Gatherer,
        points: &[VisiblePoint],
        gathering: &[u32],
        stack: &mut Stack,
        irradiances: &mut Vec<Rgb>,
    ) {
        for &index in gathering {
            irradiances.push(gatherer.interleaved_irradiance(l, &points[index as usize], stack));
        }
    }
}

simd_dispatch! {
    /// Appends the light at some points; `interleaved` is the irradiance of interreflection that a neighbour gathered.
    fn gather_block(
        l: impl Lanes,
        gatherer: &Gatherer,
        points: &[VisiblePoint],
        interleaved: &[Option<Rgb>],
        stack: &mut Stack,
        counters: &mut Counters,
        gathered: &mut Vec<Gathered>,
    ) {
        for (point, interleaved) in points.iter().zip(interleaved) {
            gathered.push(gatherer.at(l, point, *interleaved, stack, counters));
        }
    }
}

/// Where a point asks for the light of sheets; the mean of all counts.
type SheetQueries = ArrayVec<SheetQuery, { visible_parts::MOST }>;

/// The input of density estimates.
struct Gatherer<'a> {
    input: PassInput<'a>,
    maps: &'a Maps,
    sheets: &'a LightSheets,
    by_pixel: PointsByPixel<'a>,
    facets: &'a [Facet],
    radii: IterationRadii<'a>,
}

/// One density estimate of a point.
struct Estimate {
    kind: MapKind,
    /// Whether the picture shows the light of the map at the point.
    shows: bool,
    /// Radius of the disc, scene units.
    radius: f64,
}

impl Gatherer<'_> {
    fn interleaving(&self, points: &[VisiblePoint]) -> Interleaving {
        if self.maps.global.is_empty() {
            return Interleaving::none(points.len());
        }
        Interleaving::new(self.input.plan.interleaved_grid(self.input.iteration), points, |point| {
            self.radii.at(MapKind::Global, point)
        })
    }

    /// The irradiance that a point gathers for its neighbours, too.
    #[inline(always)]
    fn interleaved_irradiance<L: Lanes>(&self, l: L, point: &VisiblePoint, stack: &mut Stack) -> Rgb {
        let mut sum = Rgb::ZERO;
        for kind in MapKind::ALL {
            if self.is_interleaved(kind) && self.needs(kind, point) {
                let radius = self.radii.at(kind, point);
                // No closure: it would not be compiled with the vector instructions.
                let Some(mut disc) = self.disc(point, None, radius) else { continue };
                // Neighbours have another relief.
                disc.correction.normal = point.n_side;
                sum += estimate::irradiance(l, &self.maps[kind], stack, point, &disc);
            }
        }
        if sum.is_finite() { sum } else { Rgb::ZERO }
    }

    /// The light at a point; `interleaved` is the irradiance that a neighbour gathered.
    #[inline(always)]
    fn at<L: Lanes>(
        &self,
        l: L,
        point: &VisiblePoint,
        interleaved: Option<Rgb>,
        stack: &mut Stack,
        counters: &mut Counters,
    ) -> Gathered {
        let mut found = Gathered::default();
        let compares = self.input.plan.compares_bandwidths(point.pixel, self.input.iteration);
        let estimates = self.estimates(point, compares);
        let largest = estimates.iter().fold(0.0, |largest, estimate| estimate.radius.max(largest));
        let polygon = self.visibility_polygon(point, largest * if compares { WIDER } else { 1.0 }, counters);
        for Estimate { kind, shows, radius } in estimates {
            let light = match interleaved {
                Some(irradiance) if kind == MapKind::Global => {
                    point.throughput * irradiance * estimate::diffuse_scattering(point, radius)
                }
                Some(_) if self.is_interleaved(kind) => continue,
                _ => {
                    let is_caustic = kind == MapKind::Caustic;
                    *(if is_caustic { &mut counters.caustic_gathers } else { &mut counters.global_gathers }) += 1;
                    self.radiance(l, kind, stack, point, polygon.as_ref(), radius)
                }
            };
            if shows {
                found.radiance += light;
                found.interreflection += if kind == MapKind::Caustic { Rgb::ZERO } else { light };
            }
            if compares {
                let wider = self.radiance(l, kind, stack, point, polygon.as_ref(), WIDER * radius);
                let difference = (wider - light).element_sum();
                found.difference.maps[kind] = difference;
                found.difference.picture += if shows { difference } else { 0.0 };
                if kind == MapKind::Caustic
                    && let Some(disc) = self.disc(point, polygon.as_ref(), radius)
                {
                    found.difference.caustic_noise = estimate::shot_noise(l, &self.maps[kind], stack, light, &disc);
                }
            }
        }
        if !self.sheets.is_empty() {
            found.radiance += self.light_of_sheets(l, point);
        }
        if found.radiance.is_finite() && found.difference.is_finite() {
            found
        } else {
            counters.dropped_samples += 1;
            Gathered::default()
        }
    }

    /// The density estimates that a point needs; with `compares` also density estimates whose light the picture does not show.
    #[inline]
    fn estimates(&self, point: &VisiblePoint, compares: bool) -> ArrayVec<Estimate, 4> {
        MapKind::ALL
            .into_iter()
            .filter(|kind| self.needs(*kind, point))
            .map(|kind| (kind, self.shows(kind, point)))
            .filter(|(_, shows)| compares || *shows)
            .map(|(kind, shows)| Estimate { kind, shows, radius: self.radii.at(kind, point) })
            .collect()
    }

    /// Whether points gather the photons of a map for their neighbours, too: interreflection, in a draft also indirect caustics.
    fn is_interleaved(&self, kind: MapKind) -> bool {
        kind == MapKind::Global || (kind == MapKind::IndirectCaustic && self.input.plan.is_draft())
    }

    /// Whether a point reflects light of a map that holds photons.
    fn needs(&self, kind: MapKind, point: &VisiblePoint) -> bool {
        !self.maps[kind].is_empty()
            && match kind {
                MapKind::Caustic => true,
                MapKind::Global | MapKind::IndirectCaustic => is_diffuse(point),
                MapKind::Glossy => is_glossy(point),
            }
    }

    /// Whether the picture shows the light of a map at a point: not where caustic photons are splatted.
    fn shows(&self, kind: MapKind, point: &VisiblePoint) -> bool {
        let primitive = || &self.input.world.aggregate.primitives()[point.primitive as usize];
        kind != MapKind::Caustic
            || !point.seen_directly
            || self.input.plan.gathers_visible_caustics(primitive(), point.pixel, self.input.iteration)
    }

    /// The region of its surface that a point sees within `max_distance` (scene units); `None` where no object stands on the surface so near.
    fn visibility_polygon(
        &self,
        point: &VisiblePoint,
        max_distance: f64,
        counters: &mut Counters,
    ) -> Option<VisibilityPolygon> {
        if point.clearance.standing >= max_distance {
            return None;
        }
        let mut sampler = self.input.sampler(Stream::VisibilityPolygon, u64::from(point.pixel), self.input.iteration);
        let (polygon, rays) = VisibilityQuery {
            world: self.input.world,
            primitive: &self.input.world.aggregate.primitives()[point.primitive as usize],
            uv: point.uv,
            normal: point.n_side.as_dvec3(),
            max_distance,
            turn: 4.0 * sampler.next_1d(),
        }
        .polygon();
        counters.rays += rays;
        polygon
    }

    /// Where a point asks for the light of sheets: over the parts of the pixel that show one piece of a surface, otherwise close around the
    /// point.
    #[inline]
    fn sheet_queries(&self, point: &VisiblePoint, parts_of_pixel: u32) -> SheetQueries {
        let PassInput { world, plan, iteration, .. } = self.input;
        let tags = [point.tag, point.photon_bounces + 1];
        let over = |PixelFootprint { middle, sides, .. }| SheetQuery::parallelogram(middle, point.n_side, sides, tags);
        match self.by_pixel.footprint(world, point) {
            Some(whole) if whole.is_whole || parts_of_pixel > 1 => {
                SheetQueries::from_iter([over(whole.part(parts_of_pixel, point.in_pixel))])
            }
            Some(whole) if !plan.is_draft() => {
                let parts = VisibleParts::of_point(&self.input, point, plan.parts_of_edge(iteration));
                if parts.is_whole() {
                    SheetQueries::from_iter([over(whole)])
                } else {
                    parts.middles.iter().map(|middle| over(whole.part(parts.count, *middle))).collect()
                }
            }
            _ => {
                let side = point.footprint * plan.sheet_filter(point.seen_directly, iteration) as f32;
                SheetQueries::from_iter([SheetQuery::square(point.position, point.n_side, side, tags)])
            }
        }
    }

    /// The radiance that a point adds to its pixel with the light of sheets. Where light is averaged over the pixel, so is what a texture and
    /// relief tell of the surface.
    #[inline(always)]
    fn light_of_sheets<L: Lanes>(&self, l: L, point: &VisiblePoint) -> Rgb {
        let facets = &self.facets[point.first_facet as usize..][..point.facets as usize];
        let is_even = point.seen_directly && facets.is_empty() && point.mean_albedo == point.scattering.albedo;
        let parts = if is_even { 1 } else { self.input.plan.parts_of_pixel(self.input.iteration) };
        let queries = self.sheet_queries(point, parts);
        let throughput = point.throughput / queries.len() as f32;
        let part = 1.0 / parts as f32;
        let albedo = point.scattering.albedo.lerp(point.mean_albedo, part);
        let scattering = Scattering { albedo, ..point.scattering };
        let mut reflected = Rgb::ZERO;
        if facets.is_empty() && point.n_shade == point.n_side && !is_glossy(point) {
            for query in &queries {
                self.sheets.for_each(l, query, |irradiance, _| reflected += irradiance);
            }
            return throughput * reflected * bsdf::eval_diffuse(&scattering);
        }
        let (wo, n_side, n_shade) = (point.wo.as_dvec3(), point.n_side.as_dvec3(), point.n_shade.as_dvec3());
        let factor = |wi: DVec3, n_shade: DVec3| bsdf::diffuse_shading_factor(wi, n_side, n_shade) as f32;
        let at_point = |wi: DVec3| bsdf::eval(&scattering, n_shade, wo, wi) * factor(wi, n_shade);
        let over_pixel = |wi: DVec3| {
            let of_facet = |facet: &Facet| facet.albedo * factor(wi, facet.normal.as_dvec3());
            facets.iter().map(of_facet).sum::<Rgb>() * FRAC_1_PI / facets.len() as f32
        };
        for query in &queries {
            self.sheets.for_each(l, query, |irradiance, wi| {
                let wi = wi().as_dvec3();
                let at_point = at_point(wi);
                let scattered = if facets.is_empty() { at_point } else { at_point.lerp(over_pixel(wi), part) };
                reflected += irradiance * scattered;
            });
        }
        throughput * reflected
    }

    #[inline(always)]
    fn disc<'v>(&self, point: &VisiblePoint, polygon: Option<&'v VisibilityPolygon>, radius: f64) -> Option<Disc<'v>> {
        Disc::new(self.input.world, point, polygon, radius, self.input.plan.corrects_edges())
    }

    /// The radiance that a point adds to its pixel with the photons of a map. A Phong lobe reflects photons of the caustic and the glossy
    /// map alone: camera paths find all other light in it.
    #[inline(always)]
    fn radiance<L: Lanes>(
        &self,
        l: L,
        kind: MapKind,
        stack: &mut Stack,
        point: &VisiblePoint,
        polygon: Option<&VisibilityPolygon>,
        radius: f64,
    ) -> Rgb {
        let Some(disc) = self.disc(point, polygon, radius) else { return Rgb::ZERO };
        let map = &self.maps[kind];
        let facets = &self.facets[point.first_facet as usize..][..point.facets as usize];
        let reflected = if kind == MapKind::Glossy {
            estimate::glossy_radiance(l, map, stack, point, &disc, Rgb::ZERO)
        } else if kind == MapKind::Caustic && is_glossy(point) {
            estimate::glossy_radiance(l, map, stack, point, &disc, bsdf::eval_diffuse(&point.scattering))
        } else if !facets.is_empty() && disc.visible.is_none() && estimate::covers_pixel(point, radius) {
            estimate::faceted_radiance(l, map, stack, facets, &disc)
        } else {
            estimate::irradiance(l, map, stack, point, &disc) * estimate::diffuse_scattering(point, radius)
        };
        point.throughput * reflected
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::photons::{Photon, photon};
    use crate::transport::plan::Plan;
    use crate::transport::testing::{self, quad, visible_point};
    use crate::world::{Lobe, Scattering, World};
    use glam::{DVec2, DVec3, Vec3};
    use std::f32::consts::PI;

    /// Irradiance of the floor, W per square unit.
    const IRRADIANCE: Rgb = Rgb::new(1.0, 2.0, 3.0);
    /// Photons along a side of the floor.
    const SIDE: u32 = 400;

    /// A floor of 2 x 2 about the origin.
    fn floor() -> World {
        testing::world(&quad("floor", [[-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "grey"))
    }

    /// Photons evenly over the floor, from straight above, after this many scattering events.
    fn photons(world: &World, bounces: u32) -> Vec<Photon> {
        let at = |k: u32| 2.0 * (f64::from(k) + 0.5) / f64::from(SIDE) - 1.0;
        let photon = |k: u32| Photon {
            position: (DVec3::new(at(k % SIDE), 0.0, at(k / SIDE)) - world.view.origin).as_vec3(),
            flux: IRRADIANCE * 4.0 / (SIDE * SIDE) as f32,
            wi: Vec3::Y,
            cos: 1.0,
            tag: photon::tag(1, bounces),
        };
        (0..SIDE * SIDE).map(photon).collect()
    }

    /// The floor at u, v = 0.5, of albedo 0.5, for a camera path of throughput 0.5.
    fn point(world: &World, u: f64) -> VisiblePoint {
        VisiblePoint {
            position: (DVec3::new(2.0 * u - 1.0, 0.0, 0.0) - world.view.origin).as_vec3(),
            uv: DVec2::new(u, 0.5),
            tag: photon::tag(1, 0),
            photon_bounces: 3,
            throughput: Rgb::splat(0.5),
            scattering: Scattering { albedo: Rgb::splat(0.5), lobe: Lobe::None },
            mean_albedo: Rgb::splat(0.5),
            footprint: 0.01,
            ..visible_point()
        }
    }

    fn gathered(world: &World, maps: &Maps, point: VisiblePoint) -> Rgb {
        gathered_in(4, world, maps, point)
    }

    fn gathered_in(iteration: u64, world: &World, maps: &Maps, point: VisiblePoint) -> Rgb {
        let seen = CameraBatch { visible_points: vec![point], ..CameraBatch::default() };
        let plan = Plan::new(world);
        let input = PassInput::uncancelled(world, &plan, 1, iteration);
        let found = gather(&input, maps, &LightSheets::default(), &seen);
        found.expect("never cancelled").points[0].radiance
    }

    /// Even photons give the radiance `throughput albedo / pi E`, in the middle of the floor and, where the disc is cut, at its edge.
    #[test]
    fn even_photons_give_the_irradiance() {
        let world = floor();
        let photons = photons(&world, 1);
        let expected = 0.5 * 0.5 / PI * IRRADIANCE;
        for (u, tolerance) in [(0.5, 0.005), (0.0, 0.02), (0.03, 0.01)] {
            for maps in [[&photons[..], &[], &[]], [&[], &photons[..], &[]]] {
                let maps = Maps::build(&[], maps);
                // In one iteration of four the pixel gathers for its neighbours, too.
                for iteration in 4..12 {
                    let found = gathered_in(iteration, &world, &maps, point(&world, u));
                    // Photons 1/200 apart in discs of 0.1 and more; half a row of them is uncertain at the edge.
                    let error = (found / expected - Rgb::ONE).abs().max_element();
                    assert!(error < tolerance, "{found} instead of {expected} at {u} in iteration {iteration}");
                }
            }
        }
    }

    #[test]
    fn all_maps_that_the_point_needs_add_up() {
        let world = floor();
        let photons = photons(&world, 1);
        let radiance = |maps: &Maps, point| gathered(&world, maps, point).x / (0.25 / PI);
        let diffuse = point(&world, 0.5);
        let of_all = |maps: &Maps| (radiance(maps, diffuse) * 100.0).round();
        assert_eq!(of_all(&Maps::build(&[], [&photons, &photons, &[]])), 200.0);
        assert_eq!(of_all(&Maps::build(&[], [&photons, &[], &photons])), 100.0, "no lobe, no glossy map");
        assert_eq!(of_all(&Maps::default()), 0.0);
        // No caustics are planned, so directly seen ones are splats; caustics in a mirror are gathered.
        let caustics = Maps::build(&photons, [&[], &[], &[]]);
        assert_eq!(of_all(&caustics), 0.0);
        let in_a_mirror = VisiblePoint { seen_directly: false, ..diffuse };
        assert!((radiance(&caustics, in_a_mirror) - 1.0).abs() < 0.01);
    }

    #[test]
    fn photons_of_other_surfaces_and_after_too_many_events_do_not_count() {
        let world = floor();
        let point = point(&world, 0.5);
        let radiance = |photons: &[Photon]| gathered(&world, &Maps::build(&[], [photons, &[], &[]]), point).x;
        assert!(radiance(&photons(&world, 3)) > 0.0);
        assert_eq!(radiance(&photons(&world, 4)), 0.0, "one event too many");
        let mut below = photons(&world, 1);
        below.iter_mut().for_each(|photon| photon.tag = photon::tag(0, 1));
        assert_eq!(radiance(&below), 0.0, "on the other side");
    }
}
