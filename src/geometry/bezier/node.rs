//! Boxes around pieces of a patch, eight side by side.

use super::lineup::{Lineup, Numbers};
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
    low: [Numbers; 3],
    high: [Numbers; 3],
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

    /// Which boxes a ray meets, or which of eight rays meet one box (bit k for lane k), and where they enter.
    #[inline(always)]
    pub(super) fn test<L: Lanes>(&self, l: L, lineup: impl Lineup, ray: &PacketRay<L>) -> (u32, [f32; LANES]) {
        let mut near = ray.z_min;
        let mut far = ray.z_max;
        for axis in 0..3 {
            let low = l.mul(l.sub(lineup.numbers(l, &self.low[axis]), ray.origin[axis]), ray.inverse[axis]);
            let high = l.mul(l.sub(lineup.numbers(l, &self.high[axis]), ray.origin[axis]), ray.inverse[axis]);
            near = l.max(near, l.min(low, high));
            far = l.min(far, l.max(low, high));
        }
        // A box at infinity is entered at infinity, or never.
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
