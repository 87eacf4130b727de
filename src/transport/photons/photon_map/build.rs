//! Construction by sorting: every node is a range of the photons in Morton order, split where the highest differing bit of the codes
//! changes (a linear BVH's construction, with boxes made tight).

use super::map::PhotonMap;
use super::morton::{self, Coded};
use super::node::{BLOCK_INDEX_BITS, Moments, Node, PhotonBlock, set};
use crate::math::{LANES, Rgb};
use crate::transport::photons::Photon;
use arrayvec::ArrayVec;
use glam::Vec3;
use rayon::prelude::*;

/// Most photons of a leaf, unless they have the same position.
pub(super) const LEAF_SIZE: usize = 32;

impl PhotonMap {
    /// Builds the map of these photons. Their order matters only among photons with the same position.
    pub fn build(photons: &[Photon]) -> Self {
        if photons.is_empty() {
            return Self::default();
        }
        let mut order = morton::order(photons);
        // The children of the root are independent: each is built as a subtree of its own.
        let ranges: Vec<&mut [Coded]> = eighths(photons, &mut order).into_iter().collect();
        let subtrees: Vec<(Child, Subtree<'_>)> = ranges
            .into_par_iter()
            .map(|range| {
                let blocks = Vec::with_capacity(range.len() * 3 / 2 / LANES);
                let mut subtree = Subtree { photons, nodes: Vec::new(), moments: Vec::new(), blocks };
                (subtree.add(range), subtree)
            })
            .collect();
        let mut map = Self { len: photons.len(), ..Self::default() };
        map.nodes.push(Node::EMPTY);
        map.moments.push(Moments::ZERO);
        for (slot, (root, subtree)) in subtrees.into_iter().enumerate() {
            map.append(slot, root, subtree);
        }
        map
    }

    /// Appends a subtree as a child of the root: shifts the indices of its nodes, and marks the indices of its blocks with the subtree.
    fn append(&mut self, slot: usize, mut root: Child, subtree: Subtree) {
        let (nodes, mark) = (self.nodes.len() as u32, (slot as u32) << BLOCK_INDEX_BITS);
        let moved = |first: u32, blocks: u32| if blocks == 0 { first + nodes } else { first | mark };
        root.first = moved(root.first, root.blocks);
        self.nodes.extend(subtree.nodes.into_iter().map(|mut node| {
            for (first, blocks) in node.first.iter_mut().zip(node.blocks) {
                *first = moved(*first, blocks);
            }
            node
        }));
        self.moments.extend(subtree.moments);
        self.blocks.push(subtree.blocks);
        root.write(slot, &mut self.nodes[0], &mut self.moments[0]);
    }
}

/// Up to eight ranges, from three rounds of splitting; a range that fits a leaf stays whole.
fn eighths<'a>(photons: &[Photon], order: &'a mut [Coded]) -> ArrayVec<&'a mut [Coded], LANES> {
    let mut ranges = ArrayVec::from_iter([order]);
    for _ in 0..LANES.ilog2() {
        ranges = ranges
            .into_iter()
            .flat_map(|range| {
                let middle = split(photons, range).unwrap_or(0);
                let (left, right) = range.split_at_mut(middle);
                [left, right].into_iter().filter(|range| !range.is_empty())
            })
            .collect();
    }
    ranges
}

/// The index where the highest differing bit of the codes changes; `None` for a leaf.
fn split(photons: &[Photon], order: &mut [Coded]) -> Option<usize> {
    let differing = |order: &[Coded]| order.first().zip(order.last()).map_or(0, |(a, b)| a.code ^ b.code);
    if order.len() <= LEAF_SIZE {
        return None;
    }
    if differing(order) == 0 {
        // All photons lie in one cell of the grid: a finer grid over the cell alone tells them apart.
        morton::refine(photons, order);
    }
    let bit = differing(order).checked_ilog2()?;
    Some(order.partition_point(|item| item.code >> bit & 1 == 0))
}

/// One child of a node.
struct Child {
    min: Vec3,
    max: Vec3,
    tags: [u32; 2],
    first: u32,
    blocks: u32,
    flux: Rgb,
    /// First moments of the flux, by channel.
    first_moments: [Vec3; 3],
    second_moments: Rgb,
}

impl Child {
    fn empty(first: u32, blocks: u32) -> Self {
        Self {
            min: Vec3::INFINITY,
            max: Vec3::NEG_INFINITY,
            tags: [u32::MAX, 0],
            first,
            blocks,
            flux: Rgb::ZERO,
            first_moments: [Vec3::ZERO; 3],
            second_moments: Rgb::ZERO,
        }
    }

    fn center(&self) -> Vec3 {
        0.5 * (self.min + self.max)
    }

    fn include(&mut self, min: Vec3, max: Vec3, tags: [u32; 2]) {
        (self.min, self.max) = (self.min.min(min), self.max.max(max));
        self.tags = [self.tags[0].min(tags[0]), self.tags[1].max(tags[1])];
    }

    /// Adds moments about a point at this offset from the middle of the box.
    fn add_moments(&mut self, flux: Rgb, first: [Vec3; 3], second: Rgb, offset: Vec3) {
        self.flux += flux;
        self.second_moments +=
            second + 2.0 * Rgb::from_array(first.map(|first| first.dot(offset))) + flux * offset.length_squared();
        for ((sum, first), flux) in self.first_moments.iter_mut().zip(first).zip(flux.to_array()) {
            *sum += first + offset * flux;
        }
    }

    fn write(&self, slot: usize, node: &mut Node, moments: &mut Moments) {
        set(&mut node.min, slot, self.min);
        set(&mut node.max, slot, self.max);
        (node.tags[0][slot], node.tags[1][slot]) = (self.tags[0], self.tags[1]);
        (node.first[slot], node.blocks[slot]) = (self.first, self.blocks);
        set(&mut moments.flux, slot, self.flux);
        for (columns, first) in moments.first.iter_mut().zip(self.first_moments) {
            set(columns, slot, first);
        }
        set(&mut moments.second, slot, self.second_moments);
    }
}

/// A subtree under construction.
struct Subtree<'a> {
    photons: &'a [Photon],
    nodes: Vec<Node>,
    moments: Vec<Moments>,
    blocks: Vec<PhotonBlock>,
}

impl Subtree<'_> {
    /// Adds the node or leaf over a range of photons, and all below it.
    fn add(&mut self, order: &mut [Coded]) -> Child {
        let ranges = eighths(self.photons, order);
        if ranges.len() > 1 { self.add_inner(ranges) } else { self.add_leaf(ranges.into_iter().flatten()) }
    }

    fn add_inner(&mut self, ranges: ArrayVec<&mut [Coded], LANES>) -> Child {
        let index = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        self.moments.push(Moments::ZERO);
        let children: ArrayVec<Child, LANES> = ranges.into_iter().map(|range| self.add(range)).collect();
        let mut all = Child::empty(index as u32, 0);
        children.iter().for_each(|child| all.include(child.min, child.max, child.tags));
        for (slot, child) in children.iter().enumerate() {
            let offset = child.center() - all.center();
            all.add_moments(child.flux, child.first_moments, child.second_moments, offset);
            child.write(slot, &mut self.nodes[index], &mut self.moments[index]);
        }
        all
    }

    fn add_leaf<'b>(&mut self, order: impl Iterator<Item = &'b mut Coded>) -> Child {
        let first = self.blocks.len();
        let mut leaf = Child::empty(first as u32, 0);
        for (k, item) in order.enumerate() {
            let slot = k % LANES;
            if slot == 0 {
                self.blocks.push(PhotonBlock::EMPTY);
                leaf.blocks += 1;
            }
            let photon = &self.photons[item.index as usize];
            let block = &mut self.blocks[first + k / LANES];
            set(&mut block.position, slot, photon.position);
            set(&mut block.flux, slot, photon.flux);
            set(&mut block.wi, slot, photon.wi);
            (block.cos[slot], block.tag[slot]) = (photon.cos, photon.tag);
            leaf.include(photon.position, photon.position, [photon.tag; 2]);
        }
        for block in &self.blocks[first..] {
            for k in 0..LANES {
                let Photon { position, flux, .. } = block.photon(k);
                if flux != Rgb::ZERO {
                    leaf.add_moments(flux, [Vec3::ZERO; 3], Rgb::ZERO, position - leaf.center());
                }
            }
        }
        leaf
    }
}
