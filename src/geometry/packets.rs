//! Quads and spheres four at a time: where there are few, testing all of them takes less time than asking a tree which
//! ones to test.

use super::quad::{EDGE_TOLERANCE, Quad};
use super::{Hit, Primitive, Sphere};
use crate::math::Ray;
use crate::math::doubles::{DOUBLES, Doubles};
use glam::DVec3;
use std::array::from_fn;

/// Shapes in a packet.
const WIDTH: usize = DOUBLES;

type Column = [f64; WIDTH];

/// Four vectors, coordinate by coordinate.
type Columns = [Column; 3];

/// Quads and spheres against which every ray is tested.
#[derive(Clone, Debug, Default)]
pub(super) struct Packets {
    quads: Vec<QuadPacket>,
    spheres: Vec<SpherePacket>,
}

/// Four quads. Places that are left over hold quads without area, which meet no ray.
#[derive(Clone, Debug)]
struct QuadPacket {
    corner: Columns,
    normal: Columns,
    dual_u: Columns,
    dual_v: Columns,
    /// Their indices, as numbers that can be chosen between like the others.
    primitive: Column,
}

/// Four spheres. Places that are left over hold spheres whose radius is not a number, which meet no ray.
#[derive(Clone, Debug)]
struct SpherePacket {
    center: Columns,
    radius: Column,
    /// Their indices, as numbers that can be chosen between like the others.
    primitive: Column,
}

/// A ray in every place of vectors.
struct WideRay<D: Doubles> {
    origin: [D::Vector; 3],
    direction: [D::Vector; 3],
    length_squared: D::Vector,
    inverse_length_squared: D::Vector,
    t_min: D::Vector,
    t_max: D::Vector,
}

/// In each place the nearest hit with one of the shapes that have that place in their packets.
struct Nearest<D: Doubles> {
    /// The ray's `t_max` where there is none.
    t: D::Vector,
    u: D::Vector,
    v: D::Vector,
    primitive: D::Vector,
}

impl Packets {
    /// The quads and spheres among these primitives.
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
            quads: quads.chunks(WIDTH).map(QuadPacket::new).collect(),
            spheres: spheres.chunks(WIDTH).map(SpherePacket::new).collect(),
        }
    }

    /// Shortens the ray to its nearest hit, if there is one.
    #[inline(always)]
    pub(super) fn meet<D: Doubles>(&self, d: D, ray: &mut Ray, closest: &mut Option<Hit>) {
        if self.quads.is_empty() && self.spheres.is_empty() {
            return;
        }
        let wide = WideRay::new(d, ray);
        let zero = d.splat(0.0);
        let mut nearest = Nearest { t: wide.t_max, u: zero, v: zero, primitive: zero };
        for packet in &self.quads {
            packet.meet(d, &wide, &mut nearest);
        }
        for packet in &self.spheres {
            packet.meet(d, &wide, &mut nearest);
        }
        let t = d.store(nearest.t);
        // Without branches: no processor can tell beforehand which place is nearest.
        let first = usize::from(t[1] < t[0]);
        let second = 2 + usize::from(t[3] < t[2]);
        let place = [first, second][usize::from(t[second] < t[first])];
        if t[place] < ray.t_max {
            ray.t_max = t[place];
            let primitive = d.store(nearest.primitive)[place] as u32;
            *closest = Some(Hit { t: t[place], primitive, u: d.store(nearest.u)[place], v: d.store(nearest.v)[place] });
        }
    }

    /// Whether anything is hit.
    #[inline(always)]
    pub(super) fn occlude<D: Doubles>(&self, d: D, ray: &Ray) -> bool {
        let wide = WideRay::new(d, ray);
        for packet in &self.quads {
            if d.any(packet.intersect(d, &wide, wide.t_max)[0]) {
                return true;
            }
        }
        for packet in &self.spheres {
            if d.any(packet.intersect(d, &wide, wide.t_max)[0]) {
                return true;
            }
        }
        false
    }
}

impl<D: Doubles> WideRay<D> {
    #[inline(always)]
    fn new(d: D, ray: &Ray) -> Self {
        let length_squared = ray.direction.length_squared();
        Self {
            origin: d.splat3(ray.origin),
            direction: d.splat3(ray.direction),
            length_squared: d.splat(length_squared),
            inverse_length_squared: d.splat(1.0 / length_squared),
            t_min: d.splat(ray.t_min),
            t_max: d.splat(ray.t_max),
        }
    }
}

impl<D: Doubles> Nearest<D> {
    #[inline(always)]
    fn take(&mut self, d: D, hit: D::Vector, [t, u, v]: [D::Vector; 3], primitive: &Column) {
        self.t = d.select(hit, t, self.t);
        self.u = d.select(hit, u, self.u);
        self.v = d.select(hit, v, self.v);
        self.primitive = d.select(hit, d.load(primitive), self.primitive);
    }
}

impl QuadPacket {
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

    #[inline(always)]
    fn meet<D: Doubles>(&self, d: D, ray: &WideRay<D>, nearest: &mut Nearest<D>) {
        let [hit, t, u, v] = self.intersect(d, ray, nearest.t);
        nearest.take(d, hit, [t, u, v], &self.primitive);
    }

    /// Which quads are hit nearer than `t_max`, and t, u and v of the hits; as [`Quad::intersect`].
    #[inline(always)]
    fn intersect<D: Doubles>(&self, d: D, ray: &WideRay<D>, t_max: D::Vector) -> [D::Vector; 4] {
        let normal = d.load3(&self.normal);
        let from = d.sub3(ray.origin, d.load3(&self.corner));
        let t = d.sub(d.splat(0.0), d.div(d.dot(normal, from), d.dot(normal, ray.direction)));
        let p = d.mul_add3(t, ray.direction, from);
        let (u, v) = (d.dot(p, d.load3(&self.dual_u)), d.dot(p, d.load3(&self.dual_v)));
        let (low, high) = (d.splat(-EDGE_TOLERANCE), d.splat(1.0 + EDGE_TOLERANCE));
        let inside_u = d.and(d.less(low, u), d.less(u, high));
        let inside_v = d.and(d.less(low, v), d.less(v, high));
        let in_time = d.and(d.less(ray.t_min, t), d.less(t, t_max));
        [d.and(in_time, d.and(inside_u, inside_v)), t, u, v]
    }
}

impl SpherePacket {
    fn new(spheres: &[(u32, Sphere)]) -> Self {
        let empty = (0, Sphere { center: DVec3::ZERO, radius: f64::NAN });
        let spheres: [_; WIDTH] = from_fn(|k| spheres.get(k).copied().unwrap_or(empty));
        Self {
            center: columns(spheres.map(|(_, sphere)| sphere.center)),
            radius: spheres.map(|(_, sphere)| sphere.radius),
            primitive: spheres.map(|(index, _)| f64::from(index)),
        }
    }

    #[inline(always)]
    fn meet<D: Doubles>(&self, d: D, ray: &WideRay<D>, nearest: &mut Nearest<D>) {
        let [hit, t] = self.intersect(d, ray, nearest.t);
        nearest.take(d, hit, [t, d.splat(0.0), d.splat(0.0)], &self.primitive);
    }

    /// Which spheres are hit nearer than `t_max`, and t of the hits; as [`Sphere::intersect`].
    #[inline(always)]
    fn intersect<D: Doubles>(&self, d: D, ray: &WideRay<D>, t_max: D::Vector) -> [D::Vector; 2] {
        let radius = d.load(&self.radius);
        let radius_squared = d.mul(radius, radius);
        let from = d.sub3(ray.origin, d.load3(&self.center));
        let b = d.sub(d.splat(0.0), d.dot(from, ray.direction));
        let across = d.mul_add3(d.mul(b, ray.inverse_length_squared), ray.direction, from);
        let discriminant = d.sub(radius_squared, d.dot(across, across));
        if !d.any(d.less(d.splat(0.0), discriminant)) {
            return [d.less(t_max, t_max), t_max];
        }
        // The square root of what is negative is not a number, and then nothing that follows is one.
        let q = d.add(b, d.with_sign(d.sqrt(d.mul(ray.length_squared, discriminant)), b));
        let t0 = d.div(d.sub(d.dot(from, from), radius_squared), q);
        let t1 = d.mul(q, ray.inverse_length_squared);
        let in_order = d.less(t0, t1);
        let (near, far) = (d.select(in_order, t0, t1), d.select(in_order, t1, t0));
        let near_is_ahead = d.less(ray.t_min, near);
        let t = d.select(near_is_ahead, near, far);
        [d.and(d.less(ray.t_min, t), d.less(t, t_max)), t]
    }
}

fn columns(vectors: [DVec3; WIDTH]) -> Columns {
    [vectors.map(|p| p.x), vectors.map(|p| p.y), vectors.map(|p| p.z)]
}
