use super::bezier::{Patch, PatchHit};
use super::packets::Packets;
use super::{Bvh, Plane, Quad, Sphere};
use crate::math::lanes::{LANES, Lanes, set_bits, simd_dispatch, with_lanes};
use crate::math::{Aabb, Ray};
use glam::{DVec2, DVec3};
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

    /// Whether it stands beside a quad: only over its edges, or not over it at all.
    pub fn is_beside(&self, quad: &Quad) -> bool {
        match self {
            Self::Quad(other) => quad.is_beside(&other.corners()),
            Self::Sphere(sphere) => quad.is_beside(&sphere.bounds().corners()),
            // The surface lies in the convex hull of its control points.
            Self::Patch(patch) => quad.is_beside(patch.net().points.as_flattened()),
            Self::Plane(plane) => {
                let heights = quad.corners().map(|corner| plane.normal().dot(corner - plane.position(0.0, 0.0)));
                let tolerance = 1e-12 * (quad.edges().0.length() + quad.edges().1.length());
                heights.iter().all(|h| *h >= -tolerance) || heights.iter().all(|h| *h <= tolerance)
            }
        }
    }

    /// Whether it may go in packets.
    fn is_simple(&self) -> bool {
        matches!(self, Self::Quad(_) | Self::Sphere(_))
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

/// Up to so many quads and spheres are tested one and all; more of them go into the tree.
const FEW: usize = 24;

/// All primitives of a scene: planes and a few quads and spheres, which every ray is tested against, and the tree over the
/// others.
#[derive(Clone, Debug, Default)]
pub struct Aggregate {
    primitives: Vec<Primitive>,
    planes: Vec<u32>,
    packets: Packets,
    /// Over what is in the packets, to look for what is near a point.
    few: Bvh,
    /// Over all that is neither a plane nor in the packets.
    bvh: Bvh,
}

impl Aggregate {
    /// Builds the tree; takes n log n.
    pub fn new(primitives: Vec<Primitive>) -> Self {
        let planes = (0..primitives.len() as u32).filter(|&i| matches!(primitives[i as usize], Primitive::Plane(_)));
        let (few, others) = boxes(&primitives);
        Self {
            planes: planes.collect(),
            packets: packets(&primitives),
            few: Bvh::build(&few),
            bvh: Bvh::build(&others),
            primitives,
        }
    }

    /// The same tree fitted to moved primitives: as many, of the same kinds, in the same order. Linear time.
    pub fn refitted(&self, primitives: Vec<Primitive>) -> Self {
        let (few_boxes, other_boxes) = boxes(&primitives);
        let (mut few, mut bvh) = (self.few.clone(), self.bvh.clone());
        few.refit(&few_boxes);
        bvh.refit(&other_boxes);
        Self { planes: self.planes.clone(), packets: packets(&primitives), few, bvh, primitives }
    }

    /// In the order they were given.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// The box around all that have bounds.
    pub fn bounds(&self) -> Aabb {
        self.few.bounds().union(&self.bvh.bounds())
    }

    /// The nearest hit with `t_min < t < t_max`.
    #[inline]
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        closest_hit(self, ray)
    }

    /// The nearest hits of eight rays: the same as one by one, but quicker for rays that go nearly the same way.
    #[inline]
    pub fn closest_hits(&self, rays: &[Ray; LANES]) -> [Option<Hit>; LANES] {
        closest_hits(self, rays)
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
        let to_few = self.few.distance(point, to_planes, to);
        self.bvh.distance(point, to_few, to)
    }

    #[inline(always)]
    fn meet_packets(&self, ray: &mut Ray, closest: &mut Option<Hit>) {
        with_lanes!(l => self.packets.meet(l.simd(), ray, closest));
    }

    #[inline(always)]
    fn packets_occlude(&self, ray: &Ray) -> bool {
        with_lanes!(l => self.packets.occlude(l.simd(), ray))
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

/// Whether the primitives are so few that quads and spheres go in packets.
fn has_few(primitives: &[Primitive]) -> bool {
    primitives.iter().filter(|primitive| primitive.is_simple()).count() <= FEW
}

fn packets(primitives: &[Primitive]) -> Packets {
    if has_few(primitives) { Packets::new((0..).zip(primitives)) } else { Packets::default() }
}

/// The boxes of what is in the packets and of the others; empty for the rest.
fn boxes(primitives: &[Primitive]) -> (Vec<Aabb>, Vec<Aabb>) {
    let few = has_few(primitives);
    let boxed = |primitive: &Primitive, wanted: bool| if wanted { primitive.bounds() } else { Aabb::EMPTY };
    let boxes = |in_packets: bool| primitives.iter().map(|p| boxed(p, (few && p.is_simple()) == in_packets)).collect();
    (boxes(true), boxes(false))
}

simd_dispatch! {
    fn closest_hit(aggregate: &Aggregate, ray: &Ray) -> Option<Hit> {
        let mut ray = *ray;
        let mut closest = None;
        for &plane in &aggregate.planes {
            aggregate.meet(plane, &mut ray, &mut closest);
        }
        aggregate.meet_packets(&mut ray, &mut closest);
        aggregate.bvh.traverse(&mut ray, |primitive, ray| {
            aggregate.meet(primitive, ray, &mut closest);
            true
        });
        closest
    }
}

simd_dispatch! {
    fn closest_hits(aggregate: &Aggregate, rays: &[Ray; LANES]) -> [Option<Hit>; LANES] {
        let mut rays = *rays;
        let mut closest = [None; LANES];
        for (ray, closest) in rays.iter_mut().zip(&mut closest) {
            for &plane in &aggregate.planes {
                aggregate.meet(plane, ray, closest);
            }
            aggregate.meet_packets(ray, closest);
        }
        aggregate.bvh.traverse_together(&mut rays, |primitive, met, rays| {
            if let Primitive::Patch(patch) = &aggregate.primitives[primitive as usize] {
                for (lane, hit) in patch.intersect_together(rays, met).into_iter().enumerate() {
                    if let Some(PatchHit { t, u, v }) = hit {
                        rays[lane].t_max = t;
                        closest[lane] = Some(Hit { t, primitive, u, v });
                    }
                }
            } else {
                for lane in set_bits(met) {
                    aggregate.meet(primitive, &mut rays[lane], &mut closest[lane]);
                }
            }
        });
        closest
    }
}

simd_dispatch! {
    fn occluded(aggregate: &Aggregate, ray: &Ray) -> bool {
        if aggregate.planes.iter().any(|&plane| aggregate.primitives[plane as usize].intersect(ray).is_some()) {
            return true;
        }
        if aggregate.packets_occlude(ray) {
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::bezier::ControlNet;
    use crate::math::{Sampler, Stream};

    fn bent_net(offset: DVec3) -> ControlNet {
        let point = |i: usize, j: usize| {
            let (x, z) = (i as f64 / 3.0, j as f64 / 3.0);
            offset + DVec3::new(x, 0.8 * (4.0 * x * z).sin(), z)
        };
        ControlNet { points: std::array::from_fn(|i| std::array::from_fn(|j| point(i, j))) }
    }

    /// The distance to a primitive, or to the nearest of many points on it, so many that no place is farther than 0.02 from one.
    fn by_sampling(primitive: &Primitive, from: DVec3) -> f64 {
        let grid = (0..=100).flat_map(|i| (0..=100).map(move |j| (f64::from(i) / 100.0, f64::from(j) / 100.0)));
        let nearest = |at: &dyn Fn(f64, f64) -> DVec3| {
            grid.clone().map(|(u, v)| from.distance(at(u, v))).fold(f64::INFINITY, f64::min)
        };
        match primitive {
            Primitive::Quad(quad) => nearest(&|u, v| quad.position(u, v)),
            Primitive::Patch(patch) => nearest(&|u, v| patch.net().eval(u, v)),
            Primitive::Sphere(sphere) => (from.distance(sphere.center) - sphere.radius).abs(),
            Primitive::Plane(plane) => (from - plane.position(0.0, 0.0)).dot(plane.normal()).abs(),
        }
    }

    #[test]
    fn walls_are_beside_a_floor_and_what_stands_on_it_is_not() {
        let floor = Quad::new(DVec3::ZERO, DVec3::X, DVec3::NEG_Z);
        let wall_at = |x: f64| {
            let quad = Quad::new(DVec3::new(x, 0.0, 0.0), DVec3::NEG_Z, DVec3::Y);
            let sphere = Sphere { center: DVec3::new(x + 0.2, 0.2, -0.5), radius: 0.2 };
            let plane = Plane::new(DVec3::new(x, 0.0, 0.0), DVec3::X, None);
            let patch = Patch::new(bent_net(DVec3::new(x, 0.0, -1.0)));
            [
                Primitive::Quad(quad),
                Primitive::Sphere(sphere),
                Primitive::Plane(plane),
                Primitive::Patch(Arc::new(patch)),
            ]
        };
        assert!(wall_at(1.0).iter().all(|wall| wall.is_beside(&floor)));
        assert!(wall_at(0.5).iter().all(|wall| !wall.is_beside(&floor)));
    }

    /// A point of the unit cube.
    fn unit(k: u64) -> DVec3 {
        let mut s = Sampler::new(4, Stream::Test, 9, k);
        DVec3::new(s.next_1d(), s.next_1d(), s.next_1d())
    }

    /// So many primitives of all kinds in a cube of side 6, over a plane.
    fn scattered(count: u64) -> Aggregate {
        let mut primitives = vec![Primitive::Plane(Plane::new(-3.0 * DVec3::Y, DVec3::Y, None))];
        for k in 0..count {
            let place = 6.0 * unit(k);
            primitives.push(match k % 3 {
                0 => Primitive::Quad(Quad::new(place, unit(100 + k), DVec3::Y)),
                1 => Primitive::Sphere(Sphere { center: place, radius: 0.3 }),
                _ => Primitive::Patch(Arc::new(Patch::new(bent_net(place)))),
            });
        }
        Aggregate::new(primitives)
    }

    #[test]
    fn the_nearest_of_few_and_of_many_is_found() {
        for count in [1, 2, 7, 12, 40] {
            let aggregate = scattered(count);
            let mut hits = 0;
            for k in 0..2000 {
                // From among them, so that some rays begin in spheres.
                let mut ray = Ray::new(6.0 * unit(k), 6.0 * unit(10_000 + k) - 3.0);
                ray.t_min = if k % 5 == 0 { 0.2 } else { 0.0 };
                ray.t_max = if k % 7 == 0 { 1.5 } else { f64::INFINITY };
                ray.direction.y = if k % 41 == 0 { 0.0 } else { ray.direction.y };
                let all = aggregate.primitives().iter().zip(0..);
                let met = all.filter_map(|(primitive, index)| Some((primitive.intersect(&ray)?.0, index)));
                let nearest = met.min_by(|a, b| a.0.total_cmp(&b.0));
                let found = aggregate.closest_hit(&ray);
                assert_eq!(found.map(|hit| hit.primitive), nearest.map(|(_, index)| index), "{count}: {ray:?}");
                assert_eq!(aggregate.occluded(&ray), nearest.is_some(), "{count}: {ray:?}");
                if let (Some(found), Some((t, index))) = (found, nearest) {
                    assert!((found.t - t).abs() < 1e-12 * (1.0 + t), "{count}: {ray:?}");
                    let exact = aggregate.primitives()[index as usize].intersect(&ray).expect("it was met");
                    assert!((found.u - exact.1).abs().max((found.v - exact.2).abs()) < 1e-11, "{count}: {ray:?}");
                    hits += 1;
                }
            }
            assert!(hits > 600, "{count}: {hits} hits");
        }
    }

    #[test]
    fn eight_rays_together_find_what_each_finds_alone() {
        let aggregate = scattered(40);
        let (mut hits, mut hits_on_patches) = (0, 0);
        for k in 0..2000 {
            // From side by side to every which way.
            let spread = [0.003, 0.1, 2.0][k as usize % 3];
            let from = 14.0 * unit(k) - 4.0;
            let rays: [Ray; LANES] = std::array::from_fn(|lane| {
                let at = 6.0 * unit(10_000 + k) + spread * unit(100_000 + 8 * k + lane as u64);
                let mut ray = Ray::new(from, at - from);
                // Some that end early, are along an axis, or are none.
                ray.t_max = if (k + lane as u64).is_multiple_of(11) { 0.7 } else { ray.t_max };
                ray.direction = match (k + lane as u64) % 37 {
                    0 => DVec3::NAN,
                    1 => DVec3::ZERO,
                    2 => DVec3::NEG_Y,
                    _ => ray.direction,
                };
                ray
            });
            for (ray, together) in rays.iter().zip(aggregate.closest_hits(&rays)) {
                let alone = aggregate.closest_hit(ray);
                assert_eq!(alone.map(|hit| hit.primitive), together.map(|hit| hit.primitive), "{ray:?}");
                if let (Some(a), Some(b)) = (alone, together) {
                    // Newton's method comes from elsewhere.
                    assert!((a.t - b.t).abs() < 1e-10 * a.t, "{ray:?}: {a:?} {b:?}");
                    hits += 1;
                    hits_on_patches += usize::from(a.primitive % 3 == 0 && a.primitive > 0);
                }
            }
        }
        assert!(hits > 8000 && hits_on_patches > 2000, "{hits} hits, {hits_on_patches} on patches");
    }

    #[test]
    fn the_nearest_primitive_that_counts_is_found() {
        let aggregate = scattered(40);
        let mut closer_than_boxes = 0;
        for k in 0..200 {
            let from = 8.0 * unit(1000 + k) - 1.0;
            let counts = |p: u32| u64::from(p) % 5 != k % 5;
            let least = |distance: &dyn Fn(&Primitive) -> f64| {
                let counting = (0..).zip(aggregate.primitives()).filter(|(p, _)| counts(*p));
                counting.map(|(_, primitive)| distance(primitive)).fold(f64::INFINITY, f64::min)
            };
            let to_surface = least(&|primitive| by_sampling(primitive, from));
            let to_box = least(&|primitive| match primitive {
                Primitive::Patch(patch) => patch.bounds().distance(from),
                other => by_sampling(other, from) - 0.02,
            });
            let found = aggregate.distance(from, f64::INFINITY, counts);
            assert!(to_box - 1e-6 < found && found < to_surface + 1e-6, "{found} is not in {to_box} to {to_surface}");
            closer_than_boxes += usize::from(found > to_box + 0.03);
            assert_eq!(aggregate.distance(from, 0.5 * found, counts), 0.5 * found, "the limit");
        }
        assert!(closer_than_boxes > 10, "a patch is held by more than one box");
    }
}
