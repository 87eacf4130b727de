//! A tree over boxes in a given order, each node with eight children: a packed R-tree \[KamelFaloutsos93\].

use crate::math::lanes::set_bits;
use crate::math::{LANES, Lanes};
use arrayvec::ArrayVec;
use glam::Vec3;
use rayon::prelude::*;

const WIDTH: usize = LANES;
/// 8^10 boxes, seven siblings open on each level.
const STACK_CAPACITY: usize = 1 + (WIDTH - 1) * 11;
/// Least nodes for a task of its own.
const GRAIN: usize = 512;

/// A tree over boxes. Children that follow each other should be near each other: the tree keeps their order.
#[derive(Clone, Debug, Default)]
pub(super) struct BoxTree {
    /// From the nodes over eight boxes each to the root.
    levels: Vec<Vec<Node>>,
}

/// The boxes of eight children, by coordinate. Empty where there is no child.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Node {
    min: [[f32; WIDTH]; 3],
    max: [[f32; WIDTH]; 3],
}

impl Node {
    fn over(boxes: &[[Vec3; 2]]) -> Self {
        let mut node = Self { min: [[f32::INFINITY; WIDTH]; 3], max: [[f32::NEG_INFINITY; WIDTH]; 3] };
        for (child, [min, max]) in boxes.iter().enumerate() {
            for axis in 0..3 {
                (node.min[axis][child], node.max[axis][child]) = (min[axis], max[axis]);
            }
        }
        node
    }

    fn bounds(&self) -> [Vec3; 2] {
        let least = self.min.map(|row| row.into_iter().fold(f32::INFINITY, f32::min));
        let most = self.max.map(|row| row.into_iter().fold(f32::NEG_INFINITY, f32::max));
        [least.into(), most.into()]
    }

    /// A bit for each child whose box meets the box.
    #[inline(always)]
    fn meets<L: Lanes>(&self, l: L, min: Vec3, max: Vec3) -> u32 {
        let on_axis = |axis: usize| {
            let is_before = l.less(l.load(&self.min[axis]), l.splat(max[axis]));
            l.and(is_before, l.less(l.splat(min[axis]), l.load(&self.max[axis])))
        };
        l.bits(l.and(l.and(on_axis(0), on_axis(1)), on_axis(2)))
    }
}

impl BoxTree {
    pub(super) fn new(boxes: &[[Vec3; 2]]) -> Self {
        let nodes = |boxes: &[[Vec3; 2]]| -> Vec<Node> {
            boxes.par_chunks(WIDTH).with_min_len(GRAIN).map(Node::over).collect()
        };
        let mut levels = Vec::new();
        if !boxes.is_empty() {
            levels.push(nodes(boxes));
        }
        while let Some(level) = levels.last().filter(|level| level.len() > 1) {
            let bounds: Vec<[Vec3; 2]> = level.iter().map(Node::bounds).collect();
            levels.push(nodes(&bounds));
        }
        Self { levels }
    }

    /// Calls `visit` with the index of each box that overlaps the box between these coordinates.
    #[inline(always)]
    pub(super) fn for_each<L: Lanes>(&self, l: L, min: Vec3, max: Vec3, mut visit: impl FnMut(usize)) {
        let mut open: ArrayVec<(usize, usize), STACK_CAPACITY> = ArrayVec::new();
        if let Some(root) = self.levels.len().checked_sub(1) {
            open.push((root, 0));
        }
        while let Some((level, index)) = open.pop() {
            for child in set_bits(self.levels[level][index].meets(l, min, max)) {
                let index = WIDTH * index + child;
                if level == 0 { visit(index) } else { open.push((level - 1, index)) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::lanes::Portable;

    #[test]
    fn every_box_that_meets_is_visited_once() {
        for count in [0usize, 1, 8, 9, 64, 65, 1000] {
            let at = |k: usize| Vec3::new((k * 7 % 31) as f32, (k * 13 % 17) as f32, (k * 5 % 11) as f32);
            let boxes: Vec<[Vec3; 2]> = (0..count).map(|k| [at(k), at(k) + (k % 3) as f32]).collect();
            let tree = BoxTree::new(&boxes);
            for (min, size) in [(Vec3::ZERO, 40.0), (Vec3::splat(3.0), 2.0), (Vec3::new(10.0, 5.0, 2.0), 0.5)] {
                let max = min + size;
                let mut found = Vec::new();
                tree.for_each(Portable, min, max, |index| found.push(index));
                found.sort_unstable();
                let meets = |k: &usize| boxes[*k][0].cmplt(max).all() && boxes[*k][1].cmpgt(min).all();
                assert_eq!(found, (0..count).filter(meets).collect::<Vec<_>>(), "{count} boxes");
            }
        }
    }
}
