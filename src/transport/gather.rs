//! Photons to radiance: density estimates at visible points.

use super::Cancel;
use super::bandwidth::{Contrast, WIDER};
use super::bsdf;
use super::camera_pass::{CameraBatch, Facet, VisiblePoint};
use super::counters::Counters;
use super::kernel::{self, Clipped};
use super::maps::{MapKind, Maps};
use super::photon::Photon;
use super::photon_map::{PhotonMap, Query, Stack};
use super::photon_pass::MAX_SHADING_FACTOR;
use super::plan::{MAX_PART_OF_SPHERE, Plan};
use super::sharing::Sharing;
use super::tilt::Tilt;
use super::visibility_polygon::{Lookout, VisibilityPolygon};
use crate::geometry::Primitive;
#[cfg(target_arch = "x86_64")]
use crate::math::lanes::Avx2;
use crate::math::lanes::Portable;
use crate::math::{Lanes, Rgb, sobol};
use crate::world::{Lobe, Scattering, SharedEdges, Surface, World};
use arrayvec::ArrayVec;
use glam::{DVec2, DVec3};
use multiversion::multiversion;

/// Visible points between two questions whether the pass is still wanted.
const POINTS_PER_BLOCK: usize = 1024;
/// Where a pixel's paths meet a surface nearer to each other than this part of a disc's radius, they find the same light there:
/// what changes between them is less than the disc blurs anyway, and shrinks with it.
const PIXEL_PART_OF_RADIUS: f64 = 0.5;

/// What is found at a visible point.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gathered {
    /// Radiance that the point adds to its pixel.
    pub radiance: Rgb,
    /// How much brighter it is in wider discs; 0 where that is not measured.
    pub contrast: Contrast,
}

/// What is found at each visible point, in their order; `None` when cancelled.
pub fn gather(
    world: &World,
    plan: &Plan,
    maps: &Maps,
    seen: &CameraBatch,
    iteration: u64,
    cancel: Cancel,
) -> Option<(Vec<Gathered>, Counters)> {
    let points = seen.visible_points.as_slice();
    let gatherer = Gatherer { world, plan, maps, facets: &seen.facets, iteration, shrink: plan.shrink(iteration) };
    let mut stack = Stack::new();
    let sharing = gatherer.sharing(points);
    let mut counters = Counters { global_gathers: sharing.leading.len() as u64, ..Counters::default() };
    let mut irradiances = Vec::with_capacity(sharing.leading.len());
    for leading in sharing.leading.chunks(POINTS_PER_BLOCK) {
        irradiance_block(&gatherer, points, leading, &mut stack, &mut irradiances);
        if cancel.is_cancelled() {
            return None;
        }
    }
    let mut gathered = Vec::with_capacity(points.len());
    for (points, leader) in points.chunks(POINTS_PER_BLOCK).zip(sharing.leader.chunks(POINTS_PER_BLOCK)) {
        let shared = leader.iter().map(|place| place.map(|place| irradiances[place as usize]));
        let shared: ArrayVec<Option<Rgb>, POINTS_PER_BLOCK> = shared.collect();
        gather_block(&gatherer, points, &shared, &mut stack, &mut counters, &mut gathered);
        if cancel.is_cancelled() {
            return None;
        }
    }
    Some((gathered, counters))
}

struct Gatherer<'a> {
    world: &'a World,
    plan: &'a Plan,
    maps: &'a Maps,
    facets: &'a [Facet],
    iteration: u64,
    /// The factor of all radii, where none was measured.
    shrink: f64,
}

/// Adds the irradiance of interreflection at those points that gather it for others too.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn irradiance_block(
    gatherer: &Gatherer,
    points: &[VisiblePoint],
    leading: &[u32],
    stack: &mut Stack,
    irradiances: &mut Vec<Rgb>,
) {
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = Avx2::try_new() {
        for &index in leading {
            irradiances.push(gatherer.shared_irradiance(avx2, &points[index as usize], stack));
        }
        return;
    }
    for &index in leading {
        irradiances.push(gatherer.shared_irradiance(Portable, &points[index as usize], stack));
    }
}

/// Adds what is found at some points; `shared` is the irradiance of interreflection where another one found it.
#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn gather_block(
    gatherer: &Gatherer,
    points: &[VisiblePoint],
    shared: &[Option<Rgb>],
    stack: &mut Stack,
    counters: &mut Counters,
    gathered: &mut Vec<Gathered>,
) {
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = Avx2::try_new() {
        for (point, shared) in points.iter().zip(shared) {
            gathered.push(gatherer.at(avx2, point, *shared, stack, counters));
        }
        return;
    }
    for (point, shared) in points.iter().zip(shared) {
        gathered.push(gatherer.at(Portable, point, *shared, stack, counters));
    }
}

impl Gatherer<'_> {
    /// Which points gather interreflection for others.
    fn sharing(&self, points: &[VisiblePoint]) -> Sharing {
        if self.maps.global.is_empty() {
            return Sharing::none(points.len());
        }
        Sharing::new(self.plan.lattice(self.iteration), points, |point| self.radius(MapKind::Global, point))
    }

    /// The light that a point gathers for others too.
    #[inline(always)]
    fn shared_irradiance<L: Lanes>(&self, l: L, point: &VisiblePoint, stack: &mut Stack) -> Rgb {
        let mut sum = Rgb::ZERO;
        for kind in MapKind::ALL {
            if self.shares(kind) && self.is_wanted(kind, point) {
                let radius = self.radius(kind, point);
                // No closure: it would not get the vector instructions.
                let Some(mut disc) = self.disc(point, None, radius) else { continue };
                // For neighbours, whose relief is another one.
                disc.tilt.normal = point.n_side;
                sum += irradiance(l, &self.maps[kind], stack, point, &disc);
            }
        }
        if sum.is_finite() { sum } else { Rgb::ZERO }
    }

    /// What is found at a point; `shared` is the irradiance that another one found.
    #[inline(always)]
    fn at<L: Lanes>(
        &self,
        l: L,
        point: &VisiblePoint,
        shared: Option<Rgb>,
        stack: &mut Stack,
        counters: &mut Counters,
    ) -> Gathered {
        let mut found = Gathered::default();
        let compares = self.plan.compares_discs(point.pixel, self.iteration);
        // With whether the picture shows what is in the map.
        let radii: ArrayVec<(MapKind, bool, f64), 4> = MapKind::ALL
            .into_iter()
            .filter(|kind| self.is_wanted(*kind, point))
            .map(|kind| (kind, self.shows(kind, point)))
            .filter(|(_, shows)| compares || *shows)
            .map(|(kind, shows)| (kind, shows, self.radius(kind, point)))
            .collect();
        let largest = radii.iter().fold(0.0, |largest, (_, _, radius)| radius.max(largest));
        let view = self.view(point, largest * if compares { WIDER } else { 1.0 }, counters);
        for (kind, shows, radius) in radii {
            let light = match shared {
                Some(irradiance) if kind == MapKind::Global => {
                    point.throughput * irradiance * diffuse_reflection(point, radius)
                }
                Some(_) if self.shares(kind) => continue,
                _ => {
                    let is_caustic = kind == MapKind::Caustic;
                    *(if is_caustic { &mut counters.caustic_gathers } else { &mut counters.global_gathers }) += 1;
                    self.estimate(l, kind, stack, point, view.as_ref(), radius)
                }
            };
            if shows {
                found.radiance += light;
            }
            if compares {
                let wider = self.estimate(l, kind, stack, point, view.as_ref(), WIDER * radius);
                let contrast = (wider - light).element_sum();
                found.contrast.maps[kind] = contrast;
                found.contrast.picture += if shows { contrast } else { 0.0 };
                if kind == MapKind::Caustic {
                    found.contrast.caustic_noise = self.caustic_noise(l, stack, point, light, view.as_ref(), radius);
                }
            }
        }
        if found.radiance.is_finite() && found.contrast.is_finite() {
            found
        } else {
            counters.dropped_samples += 1;
            Gathered::default()
        }
    }

    /// Whether points gather what is in a map for others: interreflection, in a draft also what of it was focused.
    fn shares(&self, kind: MapKind) -> bool {
        kind == MapKind::Global || (kind == MapKind::Focused && self.plan.is_draft())
    }

    /// Whether what is in a map is worth a look from a point.
    fn is_wanted(&self, kind: MapKind, point: &VisiblePoint) -> bool {
        !self.maps[kind].is_empty()
            && match kind {
                MapKind::Caustic => true,
                MapKind::Global | MapKind::Focused => scatters_diffusely(point),
                MapKind::Glossy => is_glossy(point),
            }
    }

    /// Whether the picture shows what is in a map here: not where the photons themselves are added to the film.
    fn shows(&self, kind: MapKind, point: &VisiblePoint) -> bool {
        let primitive = || &self.world.aggregate.primitives()[point.primitive as usize];
        kind != MapKind::Caustic
            || !point.seen_directly
            || self.plan.gathers_visible_caustics(primitive(), point.pixel, self.iteration)
    }

    /// The radius of a point's disc, scene units.
    fn radius(&self, kind: MapKind, point: &VisiblePoint) -> f64 {
        let (plan, footprint) = (self.plan, f64::from(point.footprint));
        let unshrunk = match kind {
            MapKind::Caustic => plan.caustic_radius * footprint,
            MapKind::Global => plan.radius_in_lobe(plan.global_radius_at(footprint, point.clearance), point.blur),
            MapKind::Focused => plan.focused_radius * footprint,
            MapKind::Glossy => plan.radius_in_lobe(plan.glossy_radius * footprint, point.blur),
        };
        let is_patch = matches!(self.world.aggregate.primitives()[point.primitive as usize], Primitive::Patch(_));
        let factor = match plan.measured_shrink(kind, point.pixel) {
            None => self.shrink,
            // Patches curve, and a disc on one sees others of its object.
            Some(measured) if is_patch => measured.min(1.0),
            Some(measured) => measured,
        };
        let radius = self.limited(point, unshrunk * factor.max(1.0)) * factor.min(1.0);
        match kind {
            MapKind::Caustic => plan.limited_caustic_radius(radius, footprint, point.clearance),
            MapKind::Global | MapKind::Focused | MapKind::Glossy => radius,
        }
    }

    /// What a point sees of its surface within the reach, if an object that stands there hides some of it.
    fn view(&self, point: &VisiblePoint, reach: f64, counters: &mut Counters) -> Option<VisibilityPolygon> {
        if point.clearance.standing >= reach {
            return None;
        }
        let random = sobol::mix64(u64::from(point.pixel) ^ sobol::mix64(self.iteration)) as f64 / u64::MAX as f64;
        let (view, rays) = Lookout {
            world: self.world,
            primitive: &self.world.aggregate.primitives()[point.primitive as usize],
            uv: point.uv,
            normal: point.n_side.as_dvec3(),
            reach,
            turn: 4.0 * random,
        }
        .look();
        counters.rays += rays;
        view
    }

    /// A radius as large as the surface and the world allow. Limited before it shrinks, so that it shrinks everywhere:
    /// else bias would stay.
    fn limited(&self, point: &VisiblePoint, radius: f64) -> f64 {
        let primitive = &self.world.aggregate.primitives()[point.primitive as usize];
        let limit =
            if let Primitive::Sphere(sphere) = primitive { MAX_PART_OF_SPHERE * sphere.radius } else { f64::MAX };
        radius.min(self.plan.largest_radius * self.world.radius).min(limit)
    }

    /// How much a disc bends away from its tangent plane: see [`Tilt::bend`].
    fn bend(&self, primitive: &Primitive, point: &VisiblePoint, radius: f64) -> f32 {
        match primitive {
            Primitive::Sphere(sphere) => {
                let outward = point.position.as_dvec3() + self.world.center - sphere.center;
                let is_outside = outward.dot(point.n_side.as_dvec3()) > 0.0;
                if is_outside { (radius / sphere.radius) as f32 } else { 0.0 }
            }
            _ => 0.0,
        }
    }

    /// The density estimate of reflected radiance. Of light in Phong lobes the camera's own paths find what is neither a caustic
    /// nor in the map for it.
    #[inline(always)]
    fn estimate<L: Lanes>(
        &self,
        l: L,
        kind: MapKind,
        stack: &mut Stack,
        point: &VisiblePoint,
        view: Option<&VisibilityPolygon>,
        radius: f64,
    ) -> Rgb {
        let Some(disc) = self.disc(point, view, radius) else { return Rgb::ZERO };
        let map = &self.maps[kind];
        let facets = &self.facets[point.first_facet as usize..][..point.facets as usize];
        let reflected = if kind == MapKind::Glossy {
            glossy_reflection(l, map, stack, point, &disc, Rgb::ZERO)
        } else if kind == MapKind::Caustic && is_glossy(point) {
            glossy_reflection(l, map, stack, point, &disc, bsdf::eval_diffuse(&point.scattering))
        } else if !facets.is_empty() && disc.view.is_none() && holds_pixel(point, radius) {
            faceted_reflection(l, map, stack, facets, &disc)
        } else {
            irradiance(l, map, stack, point, &disc) * diffuse_reflection(point, radius)
        };
        point.throughput * reflected
    }

    /// Variance of the contrast of caustics if their photons are independent, for what they bring, summed over channels.
    #[inline(always)]
    fn caustic_noise<L: Lanes>(
        &self,
        l: L,
        stack: &mut Stack,
        point: &VisiblePoint,
        light: Rgb,
        view: Option<&VisibilityPolygon>,
        radius: f64,
    ) -> f32 {
        let Some(disc) = self.disc(point, view, radius) else { return 0.0 };
        let map = &self.maps[MapKind::Caustic];
        let sum = map.sum_flux(l, &disc.query, stack).element_sum();
        // All channels have the same photons.
        let squares = map.sum_squares(l, &disc.query, stack);
        let deviation: f32 = squares.to_array().map(f32::sqrt).iter().sum();
        let relative = if sum > 0.0 { deviation / sum } else { 0.0 };
        ((1.0 - 1.0 / WIDER.powi(2)) as f32 * relative * light.element_sum()).powi(2)
    }

    /// The disc of this radius round a point; none on a light's surface.
    #[inline(always)]
    fn disc<'v>(&self, point: &VisiblePoint, view: Option<&'v VisibilityPolygon>, radius: f64) -> Option<Disc<'v>> {
        let primitive = &self.world.aggregate.primitives()[point.primitive as usize];
        let Surface::Object { shared, .. } = self.world.surfaces[point.primitive as usize] else { return None };
        let linear = self.plan.corrects_edges();
        let radius = radius.max(1e-6 * self.world.radius);
        let view = view.filter(|view| view.hides_within(radius));
        let (slope, integral) = match view {
            None => edge_kernel(primitive, point, shared, radius, linear),
            Some(view) => {
                let moments = view.moments(radius);
                let (slope, integral) = moments.slope_and_integral(linear);
                (view.in_space(slope), integral)
            }
        };
        let query = Query {
            position: point.position,
            normal: point.n_side,
            radius: radius as f32,
            slope: slope.as_vec3(),
            tag_start: point.tag,
            tag_span: point.photon_bounces + 1,
        };
        let limit = MAX_SHADING_FACTOR as f32;
        let tilt = Tilt { normal: point.n_shade, limit, bend: self.bend(primitive, point, radius) };
        Some(Disc { query, tilt, view, integral })
    }
}

/// Whether all that a pixel sees of a surface lies so near to a point that it finds the same light in a disc of this radius.
fn holds_pixel(point: &VisiblePoint, radius: f64) -> bool {
    f64::from(point.spread) <= PIXEL_PART_OF_RADIUS * radius
}

/// The diffuse part of the scattering function, per steradian, for the irradiance at a point: the mean over the pixel where
/// that finds the same light. With facets it does not: each looks another way.
fn diffuse_reflection(point: &VisiblePoint, radius: f64) -> Rgb {
    let mean = Scattering { albedo: point.mean_albedo, ..point.scattering };
    let is_alike = point.facets == 0 && holds_pixel(point, radius);
    bsdf::eval_diffuse(if is_alike { &mean } else { &point.scattering })
}

/// Whether any place that stands for the pixel reflects light by Lambert's law.
fn scatters_diffusely(point: &VisiblePoint) -> bool {
    point.scattering.albedo != Rgb::ZERO || point.mean_albedo != Rgb::ZERO
}

/// Whether it has a Phong lobe.
fn is_glossy(point: &VisiblePoint) -> bool {
    matches!(point.scattering.lobe, Lobe::Phong { .. })
}

/// Where photons are gathered for a point, and how they count.
struct Disc<'v> {
    query: Query,
    tilt: Tilt,
    /// Where something stands on the disc.
    view: Option<&'v VisibilityPolygon>,
    /// Of the kernel over the part of the disc that the surface fills and the point sees.
    integral: f64,
}

/// The density estimate of irradiance, W per square scene unit: `sum flux K / integral of K` over the disc on the surface.
#[inline(always)]
fn irradiance<L: Lanes>(l: L, map: &PhotonMap, stack: &mut Stack, point: &VisiblePoint, disc: &Disc) -> Rgb {
    let Disc { query, tilt, view, integral } = disc;
    let sum = if view.is_some() {
        let mut sum = Rgb::ZERO;
        map.for_each(l, query, tilt, stack, |weight, photon| {
            sum += if is_in_view(point, *view, &photon) { weight * photon.flux } else { Rgb::ZERO };
        });
        sum
    } else if tilt.bend > 0.0 || tilt.normal != point.n_side {
        map.sum_tilted_flux(l, query, tilt, stack)
    } else {
        map.sum_flux(l, query, stack)
    };
    sum / *integral as f32
}

/// The density estimate of what the facets of a point reflect by Lambert's law, in the mean.
#[inline(always)]
fn faceted_reflection<L: Lanes>(l: L, map: &PhotonMap, stack: &mut Stack, facets: &[Facet], disc: &Disc) -> Rgb {
    let sum = map.sum_faceted_flux(l, &disc.query, &disc.tilt, facets, stack);
    sum * std::f32::consts::FRAC_1_PI / (facets.len() as f32 * disc.integral as f32)
}

/// The density estimate of what a point reflects in a Phong lobe and, with this scattering function, in all directions.
#[inline(always)]
fn glossy_reflection<L: Lanes>(
    l: L,
    map: &PhotonMap,
    stack: &mut Stack,
    point: &VisiblePoint,
    disc: &Disc,
    diffuse: Rgb,
) -> Rgb {
    let Disc { query, tilt, view, integral } = disc;
    let Some(lobe) = bsdf::GlossyLobe::new(&point.scattering, point.n_shade, point.wo) else { return Rgb::ZERO };
    let mut sum = Rgb::ZERO;
    map.for_each(l, query, tilt, stack, |weight, photon| {
        if is_in_view(point, *view, &photon) {
            sum += weight * photon.flux * (diffuse + lobe.eval(photon.wi));
        }
    });
    sum / *integral as f32
}

/// Whether nothing stands between a point and a photon.
fn is_in_view(point: &VisiblePoint, view: Option<&VisibilityPolygon>, photon: &Photon) -> bool {
    view.is_none_or(|view| view.holds((photon.position - point.position).as_dvec3()))
}

/// The kernel's slope in space and its integral over the part of the disc that the surface fills: without it, edges
/// would be dark. Without `linear` the slope is 0, which is less noisy.
fn edge_kernel(
    primitive: &Primitive,
    point: &VisiblePoint,
    shared: SharedEdges,
    radius: f64,
    linear: bool,
) -> (DVec3, f64) {
    let whole = (DVec3::ZERO, kernel::full_integral(radius));
    let (dpdu, dpdv) = match primitive {
        Primitive::Sphere(_) | Primitive::Plane(_) => return whole,
        Primitive::Quad(quad) => quad.edges(),
        Primitive::Patch(patch) => {
            if shared.u == [true; 2] && shared.v == [true; 2] {
                return whole;
            }
            // To first order the patch is the parallelogram that its derivatives span.
            let d = patch.net().derivatives(point.uv.x, point.uv.y);
            (d.dpdu, d.dpdv)
        }
    };
    let open = [shared.v[0], shared.u[1], shared.v[1], shared.u[0]];
    let (e0, e1) = plane_axes(dpdu, dpdv);
    let flat = |edge: DVec3| DVec2::new(edge.dot(e0), edge.dot(e1));
    let (u, v) = (flat(dpdu), flat(dpdv));
    if u.perp_dot(v).abs() <= 1e-9 * u.length() * v.length() {
        return whole;
    }
    let Some(clipped) = Clipped::new(-(point.uv.x * u) - point.uv.y * v, u, v, open, radius) else {
        return whole;
    };
    if !linear {
        return (DVec3::ZERO, clipped.integral());
    }
    let (slope, integral) = clipped.moments().slope_and_integral(true);
    (slope.x * e0 + slope.y * e1, integral)
}

/// Orthonormal axes of the plane of two vectors.
fn plane_axes(a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let e0 = a.normalize_or_zero();
    (e0, (b - e0 * e0.dot(b)).normalize_or_zero())
}
