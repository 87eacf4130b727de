use super::bezier::{Patch, PatchHit};
use super::{Bvh, Plane, Quad, Sphere};
use crate::math::{Aabb, Ray};
use glam::{DVec2, DVec3};
use multiversion::multiversion;
use std::sync::Arc;

/// One surface that a ray can meet.
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

/// Where a ray meets a primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// In units of the ray's direction.
    pub t: f64,
    /// Index of the primitive.
    pub primitive: u32,
    /// Parameters of quads and patches; unused by others.
    pub u: f64,
    /// See `u`.
    pub v: f64,
}

/// How a surface's parameters run where it was hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangents {
    /// As in the scene format: 0 to 1 over a quad, a patch or a sphere, scene units on a plane.
    pub uv: DVec2,
    /// Derivative of the position with respect to u.
    pub dpdu: DVec3,
    /// Derivative of the position with respect to v.
    pub dpdv: DVec3,
}

impl Primitive {
    /// Empty for a plane, which has no bounds.
    pub fn bounds(&self) -> Aabb {
        match self {
            Self::Quad(quad) => quad.bounds(),
            Self::Sphere(sphere) => sphere.bounds(),
            Self::Patch(patch) => patch.bounds(),
            Self::Plane(_) => Aabb::EMPTY,
        }
    }

    #[inline(always)]
    fn intersect(&self, ray: &Ray) -> Option<(f64, f64, f64)> {
        match self {
            Self::Quad(quad) => quad.intersect(ray),
            Self::Sphere(sphere) => sphere.intersect(ray).map(|t| (t, 0.0, 0.0)),
            Self::Patch(patch) => patch.intersect(ray).map(|PatchHit { t, u, v }| (t, u, v)),
            Self::Plane(plane) => plane.intersect(ray),
        }
    }

    /// Position and geometric unit normal (to the front or the outside) of a hit, from the surface itself: as exact
    /// as its own equation, whatever the ray's length.
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

    /// How far a point is from the surface; of a patch, from boxes that hold it closely. `limit` where that is less.
    fn distance(&self, point: DVec3, limit: f64) -> f64 {
        let distance = match self {
            Self::Quad(quad) => quad.distance(point),
            Self::Sphere(sphere) => sphere.distance(point),
            Self::Plane(plane) => plane.distance(point),
            Self::Patch(patch) => patch.distance(point, limit),
        };
        distance.min(limit)
    }

    /// How the parameters run at a hit with this normal.
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

/// All primitives of a scene and the tree over those that have bounds.
#[derive(Clone, Debug, Default)]
pub struct Aggregate {
    primitives: Vec<Primitive>,
    planes: Vec<u32>,
    bvh: Bvh,
}

impl Aggregate {
    /// Builds the tree; takes n log n.
    pub fn new(primitives: Vec<Primitive>) -> Self {
        let boxes: Vec<Aabb> = primitives.iter().map(Primitive::bounds).collect();
        let planes = (0..primitives.len() as u32).filter(|&i| matches!(primitives[i as usize], Primitive::Plane(_)));
        Self { planes: planes.collect(), bvh: Bvh::build(&boxes), primitives }
    }

    /// The same tree fitted to moved primitives: as many, of the same kinds, in the same order. Linear time.
    pub fn refitted(&self, primitives: Vec<Primitive>) -> Self {
        let boxes: Vec<Aabb> = primitives.iter().map(Primitive::bounds).collect();
        let mut bvh = self.bvh.clone();
        bvh.refit(&boxes);
        Self { planes: self.planes.clone(), bvh, primitives }
    }

    /// In the order they were given.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// The box around all that have bounds.
    pub fn bounds(&self) -> Aabb {
        self.bvh.bounds()
    }

    /// The nearest hit with `t_min < t < t_max`.
    #[inline]
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        closest_hit(self, ray)
    }

    /// Whether anything is hit with `t_min < t < t_max`.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        occluded(self, ray)
    }

    /// How far a point is from the nearest of those primitives that count, or `limit` if that is less.
    pub fn distance(&self, point: DVec3, limit: f64, counts: impl Fn(u32) -> bool) -> f64 {
        let to = |primitive: u32, limit: f64| {
            if counts(primitive) { self.primitives[primitive as usize].distance(point, limit) } else { limit }
        };
        let to_planes = self.planes.iter().fold(limit, |nearest, &plane| to(plane, nearest));
        self.bvh.distance(point, to_planes, to)
    }

    /// Shortens the ray to its hit with one primitive, if there is one.
    #[inline(always)]
    fn meet(&self, primitive: u32, ray: &mut Ray, closest: &mut Option<Hit>) {
        if let Some((t, u, v)) = self.primitives[primitive as usize].intersect(ray) {
            ray.t_max = t;
            *closest = Some(Hit { t, primitive, u, v });
        }
    }
}

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn closest_hit(aggregate: &Aggregate, ray: &Ray) -> Option<Hit> {
    let mut ray = *ray;
    let mut closest = None;
    for &plane in &aggregate.planes {
        aggregate.meet(plane, &mut ray, &mut closest);
    }
    aggregate.bvh.traverse(&mut ray, |primitive, ray| {
        aggregate.meet(primitive, ray, &mut closest);
        true
    });
    closest
}

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn occluded(aggregate: &Aggregate, ray: &Ray) -> bool {
    if aggregate.planes.iter().any(|&plane| aggregate.primitives[plane as usize].intersect(ray).is_some()) {
        return true;
    }
    let mut found = false;
    aggregate.bvh.traverse(&mut ray.clone(), |primitive, ray| {
        found = match &aggregate.primitives[primitive as usize] {
            Primitive::Patch(patch) => patch.occluded(ray),
            other => other.intersect(ray).is_some(),
        };
        !found
    });
    found
}
