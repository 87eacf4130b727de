use super::bezier::{Patch, PatchHit};
use super::{Plane, Quad, Sphere};
use crate::math::{Aabb, Ray};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// A surface that rays can hit.
#[derive(Clone, Debug)]
pub enum Primitive {
    /// A parallelogram.
    Quad(Quad),
    /// A sphere.
    Sphere(Sphere),
    /// An unbounded plane.
    Plane(Plane),
    /// A bicubic Bezier patch with its own tree.
    Patch(Arc<Patch>),
}

/// The hit of a ray on a primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The ray parameter, in units of the ray's direction.
    pub t: f64,
    /// Index of the primitive in its aggregate.
    pub primitive: u32,
    /// The parameter u on quads, planes and patches; 0 on spheres.
    pub u: f64,
    /// The parameter v on quads, planes and patches; 0 on spheres.
    pub v: f64,
}

/// The parameters of a surface at a hit, and the derivatives of the position by them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangents {
    /// (u, v): from 0 to 1 over a quad, a patch or a sphere, in scene units on a plane.
    pub uv: DVec2,
    /// The derivative of the position by u.
    pub dpdu: DVec3,
    /// The derivative of the position by v.
    pub dpdv: DVec3,
}

impl Primitive {
    /// A box that holds the primitive; empty for a plane, which is unbounded.
    pub fn bounds(&self) -> Aabb {
        match self {
            Self::Quad(quad) => quad.bounds(),
            Self::Sphere(sphere) => sphere.bounds(),
            Self::Patch(patch) => patch.bounds(),
            Self::Plane(_) => Aabb::EMPTY,
        }
    }

    /// The largest absolute values of the coordinates that points of the primitive are computed from, by axis; on a plane the points' own
    /// coordinates come on top.
    pub fn magnitude(&self) -> DVec3 {
        let of_box = |bounds: Aabb| bounds.min.abs().max(bounds.max.abs());
        match self {
            Self::Quad(quad) => of_box(quad.bounds()),
            Self::Sphere(sphere) => of_box(sphere.bounds()),
            Self::Plane(plane) => plane.position(0.0, 0.0).abs(),
            // Rays meet a patch in its unit space, which mixes the axes.
            Self::Patch(patch) => {
                let points = patch.net().points.as_flattened().iter();
                DVec3::splat(points.fold(0.0, |largest: f64, p| largest.max(p.abs().max_element())))
            }
        }
    }

    /// Whether the primitive stands beside a quad: no part of it is above or below the quad's inside.
    pub fn is_beside(&self, quad: &Quad) -> bool {
        match self {
            Self::Quad(other) => quad.is_beside(&other.corners()),
            Self::Sphere(sphere) => quad.is_beside(&sphere.bounds().corners()),
            // A patch lies in the convex hull of its control points.
            Self::Patch(patch) => quad.is_beside(patch.net().points.as_flattened()),
            Self::Plane(plane) => {
                let heights = quad.corners().map(|corner| plane.normal().dot(corner - plane.position(0.0, 0.0)));
                let tolerance = 1e-12 * (quad.edges().0.length() + quad.edges().1.length());
                heights.iter().all(|h| *h >= -tolerance) || heights.iter().all(|h| *h <= tolerance)
            }
        }
    }

    /// Whether it is a kind of primitive that blocks hold.
    pub(super) fn is_in_blocks(&self) -> bool {
        matches!(self, Self::Quad(_) | Self::Sphere(_))
    }

    /// The nearest hit as (t, u, v); `None` for a miss.
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray) -> Option<(f64, f64, f64)> {
        match self {
            Self::Quad(quad) => quad.intersect(ray),
            Self::Sphere(sphere) => sphere.intersect(ray).map(|t| (t, 0.0, 0.0)),
            Self::Patch(patch) => patch.intersect(ray).map(|PatchHit { t, u, v }| (t, u, v)),
            Self::Plane(plane) => plane.intersect(ray),
        }
    }

    /// Position and geometric unit normal (to the front or the outside) of a hit, computed from the surface's equation, so
    /// that their error does not grow with the length of the ray.
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> (DVec3, DVec3) {
        match self {
            Self::Quad(quad) => (quad.position(hit.u, hit.v), quad.normal()),
            Self::Plane(plane) => (plane.position(hit.u, hit.v), plane.normal()),
            Self::Sphere(sphere) => {
                let normal = sphere.normal(ray.at(hit.t));
                (sphere.center + sphere.radius * normal, normal)
            }
            Self::Patch(patch) => (patch.net().eval(hit.u, hit.v), patch.normal(hit.u, hit.v)),
        }
    }

    /// The distance of a point to the surface (for a patch, to the boxes around its subpatches), or `limit` if that is less.
    pub(super) fn distance(&self, point: DVec3, limit: f64) -> f64 {
        let distance = match self {
            Self::Quad(quad) => quad.distance(point),
            Self::Sphere(sphere) => sphere.distance(point),
            Self::Plane(plane) => plane.distance(point),
            Self::Patch(patch) => patch.distance(point, limit),
        };
        distance.min(limit)
    }

    /// The parameters and the derivatives by them at a hit with this geometric normal.
    pub fn tangents(&self, hit: &Hit, normal: DVec3) -> Tangents {
        let uv = DVec2::new(hit.u, hit.v);
        match self {
            Self::Quad(quad) => Tangents { uv, dpdu: quad.edges().0, dpdv: quad.edges().1 },
            Self::Plane(plane) => Tangents { uv, dpdu: plane.axes().0, dpdv: plane.axes().1 },
            Self::Sphere(sphere) => {
                let (dpdu, dpdv) = sphere.derivatives(normal);
                Tangents { uv: Sphere::uv(normal), dpdu, dpdv }
            }
            Self::Patch(patch) => {
                let d = patch.net().derivatives(hit.u, hit.v);
                Tangents { uv, dpdu: d.dpdu, dpdv: d.dpdv }
            }
        }
    }
}
