//! The disc in which a point gathers photons: the kernel over the part of the disc that the surface fills and the point sees.

use super::kernel::{self, Clipped};
use super::visibility_polygon::VisibilityPolygon;
use crate::geometry::Primitive;
use crate::transport::photons::{CosineCorrection, Photon, Query};
use crate::transport::points::VisiblePoint;
use crate::transport::points::bsdf::MAX_SHADING_FACTOR;
use crate::world::{SharedEdges, Surface, World};
use glam::{DVec2, DVec3};

/// Least radius of a disc, in radii of the world: a smaller one would lose its photons to rounding.
const LEAST_RADIUS: f64 = 1e-6;

/// Where a point gathers photons, and how they count.
pub(in crate::transport) struct Disc<'v> {
    /// The photons that count, and the kernel.
    pub(in crate::transport) query: Query,
    /// The factors of photons with another normal.
    pub(in crate::transport) correction: CosineCorrection,
    /// What the point sees of the disc; `None` where nothing hides any of it.
    pub(in crate::transport) visible: Option<&'v VisibilityPolygon>,
    /// Integral of the kernel over the part of the disc that the surface fills and the point sees, square scene units.
    pub(in crate::transport) integral: f64,
}

impl<'v> Disc<'v> {
    /// The disc of this radius (scene units) around a point; `None` on a light's surface. With `linear` the kernel is unbiased for
    /// irradiance that changes linearly across edges; without, it is less noisy.
    #[inline(always)]
    pub(in crate::transport) fn new(
        world: &World,
        point: &VisiblePoint,
        polygon: Option<&'v VisibilityPolygon>,
        radius: f64,
        linear: bool,
    ) -> Option<Self> {
        let primitive = &world.aggregate.primitives()[point.primitive as usize];
        let Surface::Object { shared, .. } = world.surfaces[point.primitive as usize] else { return None };
        let radius = radius.max(LEAST_RADIUS * world.radius);
        let visible = polygon.filter(|polygon| polygon.hides_within(radius));
        let (slope, integral) = match visible {
            None => edge_kernel(primitive, point, shared, radius, linear),
            Some(polygon) => {
                let (slope, integral) = polygon.moments(radius).slope_and_integral(linear);
                (polygon.in_world(slope), integral)
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
        let correction = CosineCorrection {
            normal: point.n_shade,
            limit: MAX_SHADING_FACTOR as f32,
            curvature: curvature(world, primitive, point, radius),
        };
        Some(Self { query, correction, visible, integral })
    }

    /// Whether the point sees where a photon of the disc lies.
    #[inline]
    pub(in crate::transport) fn sees(&self, photon: &Photon) -> bool {
        self.visible.is_none_or(|polygon| polygon.contains((photon.position - self.query.position).as_dvec3()))
    }
}

/// [`CosineCorrection::curvature`] of a disc.
#[inline]
fn curvature(world: &World, primitive: &Primitive, point: &VisiblePoint, radius: f64) -> f32 {
    match primitive {
        Primitive::Sphere(sphere) => {
            let outward = point.position.as_dvec3() + world.center - sphere.center;
            let is_outside = outward.dot(point.n_side.as_dvec3()) > 0.0;
            if is_outside { (radius / sphere.radius) as f32 } else { 0.0 }
        }
        _ => 0.0,
    }
}

/// The kernel's slope in world coordinates and its integral over the part of the disc that the surface fills: without it edges would
/// be dark.
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
            // To first order the patch is the parallelogram of its derivatives.
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
