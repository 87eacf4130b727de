//! The disc in which a point gathers photons: the kernel over the part of the disc that the surface fills and the point sees.

use super::kernel::{self, Clipped};
use super::visibility_polygon::VisibilityPolygon;
use crate::geometry::Primitive;
use crate::transport::photons::{CosineCorrection, Photon, Query};
use crate::transport::points::VisiblePoint;
use crate::transport::points::bsdf::MAX_SHADING_FACTOR;
use crate::world::{SharedEdges, Surface, World};
use glam::{DVec2, DVec3, Vec3};

/// Least radius of a disc, relative to the largest coordinate of its position: a smaller one would lose its photons to rounding. Positions
/// have an error of up to `f32::EPSILON / 2` in each coordinate, photons must lie within a quarter of the radius of the tangent plane.
const LEAST_RADIUS: f64 = 16.0 * f32::EPSILON as f64;
/// Least sine of the angle between a surface's derivatives. At a degenerate corner of a patch they are parallel up to rounding and span no
/// parallelogram.
const LEAST_SINE: f64 = 1e-9;

/// Where a point gathers photons, and how they count.
pub(in crate::transport) struct Disc<'v> {
    /// The photons that count, and the kernel.
    pub(in crate::transport) query: Query,
    /// The factors of photons with another normal.
    pub(in crate::transport) correction: CosineCorrection,
    /// The region that the point sees; `None` where the point sees the whole disc.
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
        let radius = radius.max(least_radius(point.position));
        let visible = polygon.filter(|polygon| polygon.hides_within(radius));
        let (slope, integral) = match visible {
            None => edge_kernel(primitive, point, shared, radius, linear),
            Some(polygon) => {
                let (slope, integral) = polygon.moments(radius).slope_and_integral(linear, radius);
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

/// The least radius of a disc at this position, scene units; its square is above 0 in `f32`.
#[inline]
fn least_radius(position: Vec3) -> f64 {
    (LEAST_RADIUS * f64::from(position.abs().max_element())).max(f64::from(f32::MIN_POSITIVE).sqrt())
}

/// [`CosineCorrection::curvature`] of a disc.
#[inline]
fn curvature(world: &World, primitive: &Primitive, point: &VisiblePoint, radius: f64) -> f32 {
    match primitive {
        Primitive::Sphere(sphere) => {
            let outward = point.position.as_dvec3() + world.view.origin - sphere.center;
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
    if u.perp_dot(v).abs() <= LEAST_SINE * u.length() * v.length() {
        return whole;
    }
    let Some(clipped) = Clipped::new(-(point.uv.x * u) - point.uv.y * v, u, v, open, radius) else {
        return whole;
    };
    if !linear {
        return (DVec3::ZERO, clipped.integral());
    }
    let (slope, integral) = clipped.moments().slope_and_integral(true, radius);
    (slope.x * e0 + slope.y * e1, integral)
}

/// Orthonormal axes of the plane of two vectors.
fn plane_axes(a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let e0 = a.normalize_or_zero();
    (e0, (b - e0 * e0.dot(b)).normalize_or_zero())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::testing::{self, quad, sphere, visible_point};
    use std::f64::consts::FRAC_PI_2;

    /// The disc at these parameters of the scene's first primitive.
    fn disc(world: &World, uv: DVec2, radius: f64, linear: bool) -> Disc<'static> {
        let point = VisiblePoint { uv, ..visible_point() };
        Disc::new(world, &point, None, radius, linear).expect("an object")
    }

    fn floor() -> World {
        testing::world(&quad("floor", [[-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "grey"))
    }

    /// The kernel `1 - d^2 / r^2` has the integral `pi r^2 / 2`; of a disc about an edge the surface fills a half, about a corner a fourth.
    #[test]
    fn the_integral_covers_the_filled_disc() {
        let (world, whole) = (floor(), FRAC_PI_2 * 0.25);
        for (u, v, fraction) in [(0.5, 0.5, 1.0), (0.0, 0.5, 0.5), (0.5, 1.0, 0.5), (1.0, 0.0, 0.25), (0.26, 0.26, 1.0)]
        {
            let found = disc(&world, DVec2::new(u, v), 0.5, false).integral / whole;
            assert!((found - fraction).abs() < 1e-9, "{found} of the disc at ({u}, {v})");
        }
    }

    /// Over the half disc `x > 0` of radius 1 the moments of the kernel are `pi / 4`, `x: 4 / 15`, `x^2: pi / 24`: the slope along x is
    /// `-(4 / 15) / (pi / 24)`, away from the inside, and the integral `pi / 4 + slope 4 / 15`.
    #[test]
    fn a_linear_kernel_leans_towards_the_edge() {
        let disc = disc(&floor(), DVec2::new(0.0, 0.5), 1.0, true);
        let pi = std::f64::consts::PI;
        let slope = -(4.0 / 15.0) / (pi / 24.0);
        assert!((disc.query.slope - Vec3::new(slope as f32, 0.0, 0.0)).length() < 1e-4, "{}", disc.query.slope);
        let integral = pi / 4.0 + slope * 4.0 / 15.0;
        assert!((disc.integral - integral).abs() < 1e-6, "{} instead of {integral}", disc.integral);
    }

    /// Two patches side by side: the disc goes on over the edge that they share, and ends at the other edges.
    #[test]
    fn shared_edges_of_patches_do_not_end_a_disc() {
        let x = |i: i32| f64::from(i) / 3.0;
        let patch = |left: f64| -> Vec<Vec<[f64; 3]>> {
            (0..4).map(|i| (0..4).map(|j| [left + x(i), 0.0, -x(j)]).collect()).collect()
        };
        let world = testing::world(&format!(
            "[[object]]\nname = \"sheet\"\ntype = \"bezier\"\nmaterial = \"grey\"\npatches = {:?}\n",
            [patch(0.0), patch(1.0)]
        ));
        let fraction = |u: f64| disc(&world, DVec2::new(u, 0.5), 0.4, false).integral / (FRAC_PI_2 * 0.16);
        assert!((fraction(1.0) - 1.0).abs() < 1e-9, "{} at the shared edge", fraction(1.0));
        assert!((fraction(0.0) - 0.5).abs() < 1e-9, "{} at the open edge", fraction(0.0));
    }

    #[test]
    fn spheres_curve_away_on_their_outside() {
        let world = testing::world(&sphere("ball", [0.0; 3], 2.0, "grey"));
        let curvature = |n_side| {
            let position = (DVec3::new(0.0, 2.0, 0.0) - world.view.origin).as_vec3();
            let point = VisiblePoint { position, n_side, ..visible_point() };
            Disc::new(&world, &point, None, 0.5, false).expect("an object").correction.curvature
        };
        assert_eq!((curvature(Vec3::Y), curvature(Vec3::NEG_Y)), (0.25, 0.0));
    }

    #[test]
    fn a_disc_reads_the_tags_of_its_point_and_has_a_least_radius() {
        let world = floor();
        let position = Vec3::new(0.25, 0.0, -0.5);
        let point = VisiblePoint { position, tag: 512, photon_bounces: 7, ..visible_point() };
        let query = Disc::new(&world, &point, None, 0.0, false).expect("an object").query;
        assert_eq!((query.tag_start, query.tag_span), (512, 8), "0 to 7 scattering events");
        assert!((f64::from(query.radius) / (0.5 * LEAST_RADIUS) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn lights_have_no_disc() {
        let lamp = "[[light]]\nname = \"l\"\ntype = \"sphere\"\ncenter = [0, 3, 0]\nradius = 1\nradiance = [1, 1, 1]\n";
        assert!(Disc::new(&testing::world(lamp), &visible_point(), None, 1.0, false).is_none());
    }
}
