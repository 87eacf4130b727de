//! A node of the subpatch tree: eight boxes side by side, as in a wide BVH \[DHK08\].

use crate::geometry::bezier::unit::{Column, LaneLayout, LaneRays, ROUNDING};
use crate::math::Aabb;
use crate::math::float::{round_down, round_up};
use crate::math::lanes::{LANES, Lanes};
use glam::DVec3;
use std::array::from_fn;

/// Reference to a [`Node`] or to a leaf of the tree, by its index.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct NodeRef(u32);

const LEAF_BIT: u32 = 1 << 31;

impl NodeRef {
    /// The node with this index.
    pub(crate) fn node(index: usize) -> Self {
        Self(index as u32)
    }

    /// The leaf with this index.
    pub(crate) fn leaf(index: usize) -> Self {
        Self(LEAF_BIT | index as u32)
    }

    /// Whether it refers to a leaf.
    #[inline(always)]
    pub(crate) fn is_leaf(self) -> bool {
        self.0 & LEAF_BIT != 0
    }

    /// The index among the nodes, or among the leaves.
    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        (self.0 & !LEAF_BIT) as usize
    }
}

/// Up to eight boxes in unit space, each with the node or leaf inside.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    low: [Column; 3],
    high: [Column; 3],
    children: [NodeRef; LANES],
    count: usize,
}

impl Node {
    /// The node of these children. Boxes are rounded outward to `f32` and enlarged by the rounding of a ray; empty slots
    /// get boxes at infinity.
    pub(crate) fn new(boxes: &[Aabb], children: &[NodeRef]) -> Self {
        let corner = |f: &dyn Fn(&Aabb) -> f32, empty: f32| from_fn(|k| boxes.get(k).map_or(empty, f));
        Self {
            low: [0, 1, 2].map(|axis| corner(&|b| round_down(b.min[axis] - ROUNDING), f32::INFINITY)),
            high: [0, 1, 2].map(|axis| corner(&|b| round_up(b.max[axis] + ROUNDING), f32::INFINITY)),
            children: from_fn(|k| children.get(k).copied().unwrap_or_default()),
            count: boxes.len(),
        }
    }

    /// The lanes in which a ray hits a box (bit k for lane k), and z of the entry, by the slab test \[KayKajiya86\].
    #[inline(always)]
    pub(crate) fn intersect_boxes<L: Lanes>(
        &self,
        l: L,
        layout: impl LaneLayout,
        ray: &LaneRays<L>,
    ) -> (u32, [f32; LANES]) {
        let mut near = ray.z_min;
        let mut far = ray.z_max;
        for axis in 0..3 {
            let low = l.mul(l.sub(layout.load(l, &self.low[axis]), ray.origin[axis]), ray.inverse[axis]);
            let high = l.mul(l.sub(layout.load(l, &self.high[axis]), ray.origin[axis]), ray.inverse[axis]);
            near = l.max(near, l.min(low, high));
            far = l.min(far, l.max(low, high));
        }
        // A ray enters a box at infinity at infinity, or never.
        (l.bits(l.less(near, far)), l.store(near))
    }

    /// The distance of a point to each box; infinite for empty slots.
    #[inline(always)]
    pub(crate) fn distances(&self, point: DVec3) -> [f64; LANES] {
        from_fn(|k| {
            let outside = [0, 1, 2].map(|axis| {
                let (low, high) = (f64::from(self.low[axis][k]), f64::from(self.high[axis][k]));
                (low - point[axis]).max(point[axis] - high).max(0.0)
            });
            DVec3::from_array(outside).length()
        })
    }

    /// The number of children.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Child k.
    #[inline(always)]
    pub(crate) fn child(&self, k: usize) -> NodeRef {
        self.children[k]
    }
}
