//! Sorting the photons by Morton code is the whole construction: every node is a range of the sorted array, split
//! where the highest differing bit of the codes changes.

use super::{Block, Columns, Moments, Node, PLACE_BITS, PhotonMap};
use crate::math::{LANES, Rgb};
use crate::transport::morton::{self, Coded};
use crate::transport::photon::Photon;
use arrayvec::ArrayVec;
use glam::Vec3;
use rayon::prelude::*;

/// Photons in a leaf at most, unless they are in the same place.
pub(super) const LEAF_SIZE: usize = 32;

/// The map of these photons.
pub(super) fn build(photons: &[Photon]) -> PhotonMap {
    if photons.is_empty() {
        return PhotonMap::default();
    }
    let mut order = morton::order(photons);
    // The root's children are independent of each other: each is built as a tree of its own.
    let parts: Vec<&mut [Coded]> = eighths(photons, &mut order).into_iter().collect();
    let trees: Vec<(Child, Tree<'_>)> = parts
        .into_par_iter()
        .map(|part| {
            let blocks = Vec::with_capacity(part.len() * 3 / 2 / LANES);
            let mut tree = Tree { photons, nodes: Vec::new(), moments: Vec::new(), blocks };
            (tree.add(part), tree)
        })
        .collect();
    let mut map = PhotonMap { len: photons.len(), ..PhotonMap::default() };
    map.nodes.push(Node::EMPTY);
    map.moments.push(Moments::ZERO);
    for (slot, (mut root, tree)) in trees.into_iter().enumerate() {
        let (nodes, part) = (map.nodes.len() as u32, (slot as u32) << PLACE_BITS);
        let moved = |first: u32, count: u32| if count == 0 { first + nodes } else { first | part };
        root.first = moved(root.first, root.blocks);
        map.nodes.extend(tree.nodes.into_iter().map(|mut node| {
            for (first, count) in node.first.iter_mut().zip(node.blocks) {
                *first = moved(*first, count);
            }
            node
        }));
        map.moments.extend(tree.moments);
        map.blocks.push(tree.blocks);
        root.write(slot, &mut map.nodes[0], &mut map.moments[0]);
    }
    map
}

/// Up to eight parts of a range, from three rounds of splitting; a part that is a leaf stays whole.
fn eighths<'a>(photons: &[Photon], order: &'a mut [Coded]) -> ArrayVec<&'a mut [Coded], LANES> {
    let mut parts = ArrayVec::from_iter([order]);
    for _ in 0..LANES.ilog2() {
        parts = parts
            .into_iter()
            .flat_map(|part| {
                let middle = split(photons, part).unwrap_or(0);
                let (left, right) = part.split_at_mut(middle);
                [left, right].into_iter().filter(|part| !part.is_empty())
            })
            .collect();
    }
    parts
}

/// Where the highest differing bit of the codes changes; `None` for a leaf.
fn split(photons: &[Photon], order: &mut [Coded]) -> Option<usize> {
    let differing = |order: &[Coded]| order.first().zip(order.last()).map_or(0, |(a, b)| a.code ^ b.code);
    if order.len() <= LEAF_SIZE {
        return None;
    }
    if differing(order) == 0 {
        // All in one cell of the grid: a finer grid over this cell alone tells them apart.
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
    /// By channel.
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

    /// Adds the moments of photons about another point, which is at this offset from the middle of the box.
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

fn set(columns: &mut Columns, slot: usize, value: Vec3) {
    for (column, x) in columns.iter_mut().zip(value.to_array()) {
        column[slot] = x;
    }
}

impl Node {
    const EMPTY: Self = Self {
        min: [[f32::INFINITY; LANES]; 3],
        max: [[f32::NEG_INFINITY; LANES]; 3],
        tags: [[u32::MAX; LANES], [0; LANES]],
        first: [0; LANES],
        blocks: [0; LANES],
    };
}

impl Moments {
    const ZERO: Self = Self { flux: [[0.0; LANES]; 3], first: [[[0.0; LANES]; 3]; 3], second: [[0.0; LANES]; 3] };
}

impl Block {
    const EMPTY: Self = Self {
        position: [[f32::MAX; LANES]; 3],
        flux: [[0.0; LANES]; 3],
        wi: [[0.0; LANES]; 3],
        cos: [1.0; LANES],
        tag: [0; LANES],
    };
}

/// A tree while it is built.
struct Tree<'a> {
    photons: &'a [Photon],
    nodes: Vec<Node>,
    moments: Vec<Moments>,
    blocks: Vec<Block>,
}

impl Tree<'_> {
    /// Adds a range of photons and everything below it.
    fn add(&mut self, order: &mut [Coded]) -> Child {
        let parts = eighths(self.photons, order);
        if parts.len() > 1 { self.add_inner(parts) } else { self.add_leaf(parts.into_iter().flatten()) }
    }

    fn add_inner(&mut self, parts: ArrayVec<&mut [Coded], LANES>) -> Child {
        let index = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        self.moments.push(Moments::ZERO);
        let children: ArrayVec<Child, LANES> = parts.into_iter().map(|part| self.add(part)).collect();
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
                self.blocks.push(Block::EMPTY);
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
