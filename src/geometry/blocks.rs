//! Blocks of four quads or spheres in SIMD lanes. A ray tests all of a few blocks in less time than it takes to traverse a
//! BVH.

use super::quad::{EDGE_TOLERANCE, Quad};
use super::{Hit, Primitive, Sphere};
use crate::math::Ray;
use glam::DVec3;
use pulp::{Simd, cast};
use std::array::from_fn;

/// Primitives in a block, which are the lanes of a vector.
const WIDTH: usize = 4;

type Column = [f64; WIDTH];

/// Four vectors as a structure of arrays.
type Columns = [Column; 3];

/// Four vectors in SIMD registers.
type Wide3<S> = [<S as Simd>::f64s; 3];

/// The quads and spheres that every ray tests.
#[derive(Clone, Debug, Default)]
pub(super) struct PrimitiveBlocks {
    quads: Vec<Quad4>,
    spheres: Vec<Sphere4>,
}

/// Four quads. Unused lanes hold quads without area, which no ray hits.
#[derive(Clone, Debug)]
struct Quad4 {
    corner: Columns,
    normal: Columns,
    dual_u: Columns,
    dual_v: Columns,
    /// The primitives' indices, as `f64` so that lanes select them like t, u and v.
    primitive: Column,
}

/// Four spheres. Unused lanes hold spheres with a negative squared radius, which no ray hits.
#[derive(Clone, Debug)]
struct Sphere4 {
    center: Columns,
    radius_squared: Column,
    /// The primitives' indices, as `f64` so that lanes select them like t, u and v.
    primitive: Column,
}

/// One ray in all lanes.
struct WideRay<S: Simd> {
    origin: Wide3<S>,
    direction: Wide3<S>,
    length_squared: S::f64s,
    inverse_length_squared: S::f64s,
    t_min: S::f64s,
}

/// For each lane, the nearest hit on the primitives in that lane of the blocks.
struct Nearest<S: Simd> {
    /// The ray's `t_max` where there is no hit.
    t: S::f64s,
    u: S::f64s,
    v: S::f64s,
    primitive: S::f64s,
}

impl PrimitiveBlocks {
    /// Blocks of the quads and spheres among the primitives.
    pub(super) fn new<'a>(primitives: impl Iterator<Item = (u32, &'a Primitive)>) -> Self {
        let (mut quads, mut spheres) = (Vec::new(), Vec::new());
        for (index, primitive) in primitives {
            match primitive {
                Primitive::Quad(quad) => quads.push((index, *quad)),
                Primitive::Sphere(sphere) => spheres.push((index, *sphere)),
                Primitive::Plane(_) | Primitive::Patch(_) => {}
            }
        }
        Self {
            quads: quads.chunks(WIDTH).map(Quad4::new).collect(),
            spheres: spheres.chunks(WIDTH).map(Sphere4::new).collect(),
        }
    }

    /// Shortens the ray to its nearest hit, if any.
    #[inline(always)]
    pub(super) fn intersect<S: Simd>(&self, s: S, ray: &mut Ray, closest: &mut Option<Hit>) {
        if self.quads.is_empty() && self.spheres.is_empty() {
            return;
        }
        let nearest = self.nearest(s, ray);
        let t: Column = cast(nearest.t);
        // Without branches, which would be mispredicted: any lane may be the nearest.
        let first = usize::from(t[1] < t[0]);
        let second = 2 + usize::from(t[3] < t[2]);
        let lane = if t[second] < t[first] { second } else { first };
        if t[lane] < ray.t_max {
            ray.t_max = t[lane];
            let [u, v, primitive]: [Column; 3] = [cast(nearest.u), cast(nearest.v), cast(nearest.primitive)];
            *closest = Some(Hit { t: t[lane], primitive: primitive[lane] as u32, u: u[lane], v: v[lane] });
        }
    }

    /// Whether the ray has any hit.
    #[inline(always)]
    pub(super) fn occluded<S: Simd>(&self, s: S, ray: &Ray) -> bool {
        s.reduce_min_f64s(self.nearest(s, ray).t) < ray.t_max
    }

    #[inline(always)]
    fn nearest<S: Simd>(&self, s: S, ray: &Ray) -> Nearest<S> {
        let wide = WideRay::new(s, ray);
        let zero = s.splat_f64s(0.0);
        let mut nearest = Nearest { t: s.splat_f64s(ray.t_max), u: zero, v: zero, primitive: zero };
        for block in &self.quads {
            block.intersect(s, &wide, &mut nearest);
        }
        for block in &self.spheres {
            block.intersect(s, &wide, &mut nearest);
        }
        nearest
    }
}

impl<S: Simd> WideRay<S> {
    #[inline(always)]
    fn new(s: S, ray: &Ray) -> Self {
        let length_squared = ray.direction.length_squared();
        Self {
            origin: splat(s, ray.origin),
            direction: splat(s, ray.direction),
            length_squared: s.splat_f64s(length_squared),
            inverse_length_squared: s.splat_f64s(1.0 / length_squared),
            t_min: s.splat_f64s(ray.t_min),
        }
    }
}

impl<S: Simd> Nearest<S> {
    /// Replaces the nearest hit in the lanes of the mask `hit`.
    #[inline(always)]
    fn replace(&mut self, s: S, hit: S::m64s, [t, u, v]: Wide3<S>, primitive: &Column) {
        self.t = s.select_f64s(hit, t, self.t);
        self.u = s.select_f64s(hit, u, self.u);
        self.v = s.select_f64s(hit, v, self.v);
        self.primitive = s.select_f64s(hit, cast(*primitive), self.primitive);
    }
}

impl Quad4 {
    fn new(quads: &[(u32, Quad)]) -> Self {
        let empty = (0, Quad::new(DVec3::ZERO, DVec3::ZERO, DVec3::ZERO));
        let quads: [_; WIDTH] = from_fn(|k| quads.get(k).copied().unwrap_or(empty));
        let columns = |of: fn(&Quad) -> DVec3| columns(quads.map(|(_, quad)| of(&quad)));
        Self {
            corner: columns(|quad| quad.position(0.0, 0.0)),
            normal: columns(Quad::normal),
            dual_u: columns(|quad| quad.duals().0),
            dual_v: columns(|quad| quad.duals().1),
            primitive: quads.map(|(index, _)| f64::from(index)),
        }
    }

    /// Tests a ray as [`Quad::intersect`] does.
    #[inline(always)]
    fn intersect<S: Simd>(&self, s: S, ray: &WideRay<S>, nearest: &mut Nearest<S>) {
        let normal = load(s, &self.normal);
        let from = sub(s, ray.origin, load(s, &self.corner));
        let t = s.neg_f64s(s.div_f64s(dot(s, normal, from), dot(s, normal, ray.direction)));
        let p = mul_add(s, t, ray.direction, from);
        let (u, v) = (dot(s, p, load(s, &self.dual_u)), dot(s, p, load(s, &self.dual_v)));
        let in_time = s.and_m64s(s.less_than_f64s(ray.t_min, t), s.less_than_f64s(t, nearest.t));
        let inside = s.and_m64s(in_range_0_to_1(s, u), in_range_0_to_1(s, v));
        nearest.replace(s, s.and_m64s(in_time, inside), [t, u, v], &self.primitive);
    }
}

impl Sphere4 {
    fn new(spheres: &[(u32, Sphere)]) -> Self {
        let get = |k: usize| spheres.get(k).copied();
        Self {
            center: columns(from_fn(|k| get(k).map_or(DVec3::ZERO, |(_, sphere)| sphere.center))),
            radius_squared: from_fn(|k| get(k).map_or(-1.0, |(_, sphere)| sphere.radius * sphere.radius)),
            primitive: from_fn(|k| get(k).map_or(0.0, |(index, _)| f64::from(index))),
        }
    }

    /// Tests a ray as [`Sphere::intersect`] does.
    #[inline(always)]
    fn intersect<S: Simd>(&self, s: S, ray: &WideRay<S>, nearest: &mut Nearest<S>) {
        let radius_squared = cast(self.radius_squared);
        let from = sub(s, ray.origin, load(s, &self.center));
        let b = s.neg_f64s(dot(s, from, ray.direction));
        let across = mul_add(s, s.mul_f64s(b, ray.inverse_length_squared), ray.direction, from);
        let discriminant = s.sub_f64s(radius_squared, dot(s, across, across));
        let zero = s.splat_f64s(0.0);
        if s.reduce_max_f64s(discriminant) < 0.0 {
            return;
        }
        // A lane that misses has a negative discriminant, whose root is NaN; all its comparisons are then false.
        let root = s.sqrt_f64s(s.mul_f64s(ray.length_squared, discriminant));
        let q = s.add_f64s(b, s.select_f64s(s.less_than_f64s(b, zero), s.neg_f64s(root), root));
        let t0 = s.div_f64s(s.sub_f64s(dot(s, from, from), radius_squared), q);
        let t1 = s.mul_f64s(q, ray.inverse_length_squared);
        let in_order = s.less_than_f64s(t0, t1);
        let (near, far) = (s.select_f64s(in_order, t0, t1), s.select_f64s(in_order, t1, t0));
        let t = s.select_f64s(s.less_than_f64s(ray.t_min, near), near, far);
        let hit = s.and_m64s(s.less_than_f64s(ray.t_min, t), s.less_than_f64s(t, nearest.t));
        nearest.replace(s, hit, [t, zero, zero], &self.primitive);
    }
}

/// The lanes whose coordinate is from 0 to 1, up to the tolerance.
#[inline(always)]
fn in_range_0_to_1<S: Simd>(s: S, x: S::f64s) -> S::m64s {
    let (low, high) = (s.splat_f64s(-EDGE_TOLERANCE), s.splat_f64s(1.0 + EDGE_TOLERANCE));
    s.and_m64s(s.less_than_or_equal_f64s(low, x), s.less_than_or_equal_f64s(x, high))
}

fn columns(vectors: [DVec3; WIDTH]) -> Columns {
    [vectors.map(|p| p.x), vectors.map(|p| p.y), vectors.map(|p| p.z)]
}

#[inline(always)]
fn load<S: Simd>(_: S, [x, y, z]: &Columns) -> Wide3<S> {
    [cast(*x), cast(*y), cast(*z)]
}

#[inline(always)]
fn splat<S: Simd>(s: S, v: DVec3) -> Wide3<S> {
    [s.splat_f64s(v.x), s.splat_f64s(v.y), s.splat_f64s(v.z)]
}

/// `a - b`.
#[inline(always)]
fn sub<S: Simd>(s: S, a: Wide3<S>, b: Wide3<S>) -> Wide3<S> {
    [s.sub_f64s(a[0], b[0]), s.sub_f64s(a[1], b[1]), s.sub_f64s(a[2], b[2])]
}

/// `f a + b`, with a scalar f in each lane.
#[inline(always)]
fn mul_add<S: Simd>(s: S, f: S::f64s, a: Wide3<S>, b: Wide3<S>) -> Wide3<S> {
    [s.mul_add_e_f64s(f, a[0], b[0]), s.mul_add_e_f64s(f, a[1], b[1]), s.mul_add_e_f64s(f, a[2], b[2])]
}

#[inline(always)]
fn dot<S: Simd>(s: S, a: Wide3<S>, b: Wide3<S>) -> S::f64s {
    s.mul_add_e_f64s(a[0], b[0], s.mul_add_e_f64s(a[1], b[1], s.mul_f64s(a[2], b[2])))
}
