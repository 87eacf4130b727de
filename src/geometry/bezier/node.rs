//! Boxes around pieces of a patch, eight side by side.

use super::packet::PacketRay;
use super::paraboloid::ROUNDING;
use super::tree::Link;
use crate::math::Aabb;
use crate::math::float::{round_down, round_up};
use crate::math::lanes::{LANES, Lanes};
use glam::DVec3;
use std::array::from_fn;

/// Up to eight boxes and what is in them.
#[derive(Clone, Debug)]
pub(super) struct Node {
    low: [[f32; LANES]; 3],
    high: [[f32; LANES]; 3],
    children: [Link; LANES],
    count: usize,
}

impl Node {
    /// Boxes rounded outward to `f32`, and larger by what rounding may move a ray. Missing children get boxes at
    /// infinity.
    pub(super) fn new(boxes: &[Aabb], children: &[Link]) -> Self {
        let corner = |f: &dyn Fn(&Aabb) -> f32, empty: f32| from_fn(|k| boxes.get(k).map_or(empty, f));
        Self {
            low: [0, 1, 2].map(|axis| corner(&|b| round_down(b.min[axis] - ROUNDING), f32::INFINITY)),
            high: [0, 1, 2].map(|axis| corner(&|b| round_up(b.max[axis] + ROUNDING), f32::INFINITY)),
            children: from_fn(|k| children.get(k).copied().unwrap_or_default()),
            count: boxes.len(),
        }
    }

    /// Which boxes the ray meets (bit k for child k), and where it enters them.
    #[inline(always)]
    pub(super) fn test<L: Lanes>(&self, l: L, ray: &PacketRay<L>) -> (u32, [f32; LANES]) {
        let mut near = ray.z_min;
        let mut far = ray.z_max;
        for axis in 0..3 {
            let low = l.mul(l.sub(l.load(&self.low[axis]), ray.origin[axis]), ray.inverse[axis]);
            let high = l.mul(l.sub(l.load(&self.high[axis]), ray.origin[axis]), ray.inverse[axis]);
            near = l.max(near, l.min(low, high));
            far = l.min(far, l.max(low, high));
        }
        // A box at infinity is entered at infinity, or never.
        (l.bits(l.less(near, far)), l.store(near))
    }

    /// Which of eight rays meet box k (a bit a ray), and where they enter it.
    #[inline(always)]
    pub(super) fn test_one<L: Lanes>(&self, l: L, k: usize, rays: &PacketRay<L>) -> (u32, [f32; LANES]) {
        let mut near = rays.z_min;
        let mut far = rays.z_max;
        for axis in 0..3 {
            let low = l.mul(l.sub(l.splat(self.low[axis][k]), rays.origin[axis]), rays.inverse[axis]);
            let high = l.mul(l.sub(l.splat(self.high[axis][k]), rays.origin[axis]), rays.inverse[axis]);
            near = l.max(near, l.min(low, high));
            far = l.min(far, l.max(low, high));
        }
        (l.bits(l.less(near, far)), l.store(near))
    }

    /// How far a point is from each box; infinite where there is none.
    pub(super) fn distances(&self, point: DVec3) -> [f64; LANES] {
        from_fn(|k| {
            let outside = [0, 1, 2].map(|axis| {
                let (low, high) = (f64::from(self.low[axis][k]), f64::from(self.high[axis][k]));
                (low - point[axis]).max(point[axis] - high).max(0.0)
            });
            DVec3::from_array(outside).length()
        })
    }

    /// How many children there are.
    #[inline(always)]
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Child k.
    #[inline(always)]
    pub(super) fn child(&self, k: usize) -> Link {
        self.children[k]
    }
}
