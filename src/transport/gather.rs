//! Photons to radiance: density estimates at visible points.

use super::Cancel;
use super::bandwidth::WIDER;
use super::bsdf;
use super::camera_pass::VisiblePoint;
use super::counters::Counters;
use super::kernel;
use super::maps::{MapKind, Maps, PerMap};
use super::photon::Photon;
use super::photon_map::{Query, Stack};
use super::photon_pass::MAX_SHADING_FACTOR;
use super::plan::Plan;
use super::tilt::Tilt;
use super::visibility_polygon::{Lookout, VisibilityPolygon};
use crate::geometry::Primitive;
#[cfg(target_arch = "x86_64")]
use crate::math::lanes::Avx2;
use crate::math::lanes::Portable;
use crate::math::{Lanes, Rgb, sobol};
use crate::world::{Lobe, SharedEdges, Surface, World};
use arrayvec::ArrayVec;
use glam::{DVec2, DVec3};
use multiversion::multiversion;
use rayon::prelude::*;

/// Visible points of one piece of the pass.
const POINTS_PER_BLOCK: usize = 1024;
/// A disc may cover this part of a sphere's radius, so that it stays nearly flat.
const MAX_PART_OF_SPHERE: f64 = 0.32;

/// What is found at a visible point.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gathered {
    /// Radiance that the point adds to its pixel.
    pub radiance: Rgb,
    /// How much brighter it is in wider discs, summed over channels; 0 where that is not measured.
    pub contrasts: PerMap<f32>,
}

/// What is found at each visible point, in their order; `None` when cancelled.
pub fn gather(
    world: &World,
    plan: &Plan,
    maps: &Maps,
    points: &[VisiblePoint],
    iteration: u64,
    cancel: Cancel,
) -> Option<(Vec<Gathered>, Counters)> {
    let blocks: Vec<(Vec<Gathered>, Counters)> = points
        .par_chunks(POINTS_PER_BLOCK)
        .map(|points| {
            let mut counters = Counters::default();
            let gatherer = Gatherer { world, plan, maps, iteration };
            let gathered = gather_block(&gatherer, points, &mut counters);
            (!cancel.is_cancelled()).then_some((gathered, counters))
        })
        .collect::<Option<_>>()?;
    Some(super::blocks::concatenate(blocks))
}

struct Gatherer<'a> {
    world: &'a World,
    plan: &'a Plan,
    maps: &'a Maps,
    iteration: u64,
}

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn gather_block(gatherer: &Gatherer, points: &[VisiblePoint], counters: &mut Counters) -> Vec<Gathered> {
    let mut stack = Stack::new();
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = Avx2::try_new() {
        return points.iter().map(|point| gatherer.at(avx2, point, &mut stack, counters)).collect();
    }
    points.iter().map(|point| gatherer.at(Portable, point, &mut stack, counters)).collect()
}

impl Gatherer<'_> {
    #[inline(always)]
    fn at<L: Lanes>(&self, l: L, point: &VisiblePoint, stack: &mut Stack, counters: &mut Counters) -> Gathered {
        let mut found = Gathered::default();
        let (plan, maps, footprint) = (self.plan, self.maps, f64::from(point.footprint));
        let caustics_here = !point.seen_directly || plan.gathers_visible_caustics(self.iteration);
        let scatters = point.scattering.albedo != Rgb::ZERO;
        let unshrunk = [
            (MapKind::Caustic, caustics_here, plan.caustic_radius * footprint),
            (MapKind::Global, scatters, plan.global_radius_at(footprint, point.clearance)),
            (MapKind::Focused, scatters, plan.focused_radius * footprint),
        ];
        let radii: ArrayVec<(MapKind, f64), 3> = unshrunk
            .into_iter()
            .filter(|(kind, is_wanted, _)| *is_wanted && !maps[*kind].is_empty())
            .map(|(kind, _, radius)| {
                (kind, self.limited(point, radius) * plan.shrink_at(kind, point.pixel, self.iteration))
            })
            .collect();
        let compares = plan.compares_discs(point.pixel, self.iteration);
        let largest = radii.iter().fold(0.0, |largest, (_, radius)| radius.max(largest));
        let view = self.view(point, largest * if compares { WIDER } else { 1.0 }, counters);
        for (kind, radius) in radii {
            let is_caustic = kind == MapKind::Caustic;
            *(if is_caustic { &mut counters.caustic_gathers } else { &mut counters.global_gathers }) += 1;
            let light = self.estimate(l, kind, stack, point, view.as_ref(), radius);
            found.radiance += light;
            if compares {
                let wider = self.estimate(l, kind, stack, point, view.as_ref(), WIDER * radius);
                found.contrasts[kind] = (wider - light).element_sum();
            }
        }
        if found.radiance.is_finite() && MapKind::ALL.into_iter().all(|kind| found.contrasts[kind].is_finite()) {
            found
        } else {
            counters.dropped_samples += 1;
            Gathered::default()
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

    /// The density estimate of reflected radiance: `sum f flux K / integral of K` over the disc on the surface. Light
    /// in a Phong lobe counts for caustic photons only; the camera's own paths find the rest of it.
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
        let primitive = &self.world.aggregate.primitives()[point.primitive as usize];
        let Surface::Object { shared, .. } = self.world.surfaces[point.primitive as usize] else { return Rgb::ZERO };
        let (map, linear) = (&self.maps[kind], self.plan.corrects_edges());
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
        let diffuse = bsdf::eval_diffuse(&point.scattering);
        let glossy = kind == MapKind::Caustic && matches!(point.scattering.lobe, Lobe::Phong { .. });
        let limit = MAX_SHADING_FACTOR as f32;
        let tilt = Tilt { normal: point.n_shade, limit, bend: self.bend(primitive, point, radius) };
        let reflected = if glossy || view.is_some() {
            let mut sum = Rgb::ZERO;
            map.for_each(l, &query, &tilt, stack, |weight, photon| {
                sum += weight * photon.flux * reflected_part(point, view, glossy, &photon);
            });
            sum
        } else if tilt.bend > 0.0 || point.n_shade != point.n_side {
            map.sum_tilted_flux(l, &query, &tilt, stack) * diffuse
        } else {
            map.sum_flux(l, &query, stack) * diffuse
        };
        point.throughput * reflected / integral as f32
    }
}

/// The part of a photon's light that a point reflects, by its Phong lobe too if `glossy`; none if it is not in view.
fn reflected_part(point: &VisiblePoint, view: Option<&VisibilityPolygon>, glossy: bool, photon: &Photon) -> Rgb {
    if view.is_some_and(|view| !view.holds((photon.position - point.position).as_dvec3())) {
        return Rgb::ZERO;
    }
    let diffuse = bsdf::eval_diffuse(&point.scattering);
    let (n_shade, wo) = (point.n_shade.as_dvec3(), point.wo.as_dvec3());
    let lobe = || bsdf::eval_glossy(&point.scattering, n_shade, wo, photon.wi.as_dvec3());
    if glossy { diffuse + lobe() } else { diffuse }
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
    let Some(moments) = kernel::clipped_moments(-(point.uv.x * u) - point.uv.y * v, u, v, open, radius) else {
        return whole;
    };
    let (slope, integral) = moments.slope_and_integral(linear);
    (slope.x * e0 + slope.y * e1, integral)
}

/// Orthonormal axes of the plane of two vectors.
fn plane_axes(a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let e0 = a.normalize_or_zero();
    (e0, (b - e0 * e0.dot(b)).normalize_or_zero())
}
