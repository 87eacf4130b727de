//! The photon map: a kd-tree with spatial-median splits over photons in Morton order, eight children a node.
//!
//! Every node keeps the moments of its children's photons: the kernel is quadratic, so that they give the sum over a
//! child that lies in the disc as a whole at once.

mod build;

use super::camera_pass::Facet;
use super::photon::Photon;
use super::tilt::Tilt;
#[cfg(target_arch = "x86_64")]
use crate::math::lanes::Avx2;
use crate::math::lanes::Portable;
use crate::math::{LANES, Lanes, Rgb};
use glam::Vec3;
use multiversion::multiversion;

/// Eight values of three coordinates or channels.
type Columns = [[f32; LANES]; 3];

/// Up to eight photons side by side. Those that are missing are infinitely far away and carry nothing.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Block {
    position: Columns,
    flux: Columns,
    /// Towards where they came from.
    wi: Columns,
    cos: [f32; LANES],
    tag: [u32; LANES],
}

impl Block {
    fn photon(&self, k: usize) -> Photon {
        let at = |columns: &Columns| Vec3::from_array(columns.map(|column| column[k]));
        Photon {
            position: at(&self.position),
            flux: at(&self.flux),
            wi: at(&self.wi),
            cos: self.cos[k],
            tag: self.tag[k],
        }
    }
}

/// Eight children side by side. Those that are missing have empty boxes.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Node {
    min: Columns,
    max: Columns,
    /// The least and the greatest tag of the photons.
    tags: [[u32; LANES]; 2],
    /// An inner node's index, or the first block of a leaf: its part of the map in the highest bits.
    first: [u32; LANES],
    /// Blocks of a leaf; 0 for an inner node.
    blocks: [u32; LANES],
}

/// Sums over the photons of each child of a node, `d` the offset from the middle of its box.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Moments {
    /// Of the flux.
    flux: Columns,
    /// Of `d` times the flux, by channel.
    first: [Columns; 3],
    /// Of `|d|^2` times the flux.
    second: Columns,
}

/// Photons for queries by place.
#[derive(Clone, Debug, Default)]
pub struct PhotonMap {
    /// The root first; none where there is no photon.
    nodes: Vec<Node>,
    /// Of the node with the same index.
    moments: Vec<Moments>,
    /// For each child of the root the blocks below it, which are built apart and not moved again.
    blocks: Vec<Vec<Block>>,
    len: usize,
}

/// Bits of a block's place within its part.
const PLACE_BITS: u32 = u32::BITS - LANES.ilog2();

/// What a density estimate looks for.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// In the coordinates of the photons.
    pub position: Vec3,
    /// Unit length; photons farther than [`Query::SLAB`] radii from the tangent plane belong to another surface.
    pub normal: Vec3,
    /// Of the disc.
    pub radius: f32,
    /// The kernel is `(1 - d^2 / r^2) (1 + slope d)`, `d` the offset from the position.
    pub slope: Vec3,
    /// Photons count whose tag is at least this, by less than `tag_span`.
    pub tag_start: u32,
    /// See `tag_start`; not 0.
    pub tag_span: u32,
}

impl Query {
    /// Half the thickness of the disc, in radii: a surface curves away from its tangent plane by a quarter of the
    /// radius where the radius is half the radius of curvature.
    pub const SLAB: f32 = 0.25;

    /// Whether the kernel is the same in all directions.
    fn is_even(&self) -> bool {
        self.slope == Vec3::ZERO
    }
}

/// Nodes still to visit; kept from query to query to save allocations.
pub(super) type Stack = Vec<u32>;

impl PhotonMap {
    /// The map of these photons. Depends on their order only among photons in the same place.
    pub fn build(photons: &[Photon]) -> Self {
        build::build(photons)
    }

    /// The number of photons.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no photon.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// For each query the sum of flux times the kernel over the photons of its disc.
    pub fn sums(&self, queries: &[Query]) -> Vec<Rgb> {
        sums(self, queries)
    }

    /// Sum of flux times the kernel over the photons of the disc.
    #[inline(always)]
    pub(super) fn sum_flux<L: Lanes>(&self, l: L, query: &Query, stack: &mut Stack) -> Rgb {
        let mut sums = [l.splat(0.0); 3];
        let whole = self.visit::<L, true>(
            l,
            query,
            stack,
            #[inline(always)]
            |block, weight| sums = mul_add3(l, weight, load3(l, &block.flux), sums),
        );
        sum3(l, [l.add(sums[0], whole[0]), l.add(sums[1], whole[1]), l.add(sums[2], whole[2])])
    }

    /// Sum of the squares of flux times the kernel: the variance of [`Self::sum_flux`] if photons are independent.
    #[inline(always)]
    pub(super) fn sum_squares<L: Lanes>(&self, l: L, query: &Query, stack: &mut Stack) -> Rgb {
        let mut sums = [l.splat(0.0); 3];
        self.visit::<L, false>(
            l,
            query,
            stack,
            #[inline(always)]
            |block, weight| {
                let flux = load3(l, &block.flux);
                let weighted = [l.mul(weight, flux[0]), l.mul(weight, flux[1]), l.mul(weight, flux[2])];
                for channel in 0..3 {
                    sums[channel] = l.mul_add(weighted[channel], weighted[channel], sums[channel]);
                }
            },
        );
        sum3(l, sums)
    }

    /// The sum of flux, each photon's times its factor by the tilt.
    #[inline(always)]
    pub(super) fn sum_tilted_flux<L: Lanes>(&self, l: L, query: &Query, tilt: &Tilt, stack: &mut Stack) -> Rgb {
        let mut sums = [l.splat(0.0); 3];
        self.visit_tilted(
            l,
            query,
            tilt,
            stack,
            #[inline(always)]
            |block: &Block, weight: L::Vector| sums = mul_add3(l, weight, load3(l, &block.flux), sums),
        );
        sum3(l, sums)
    }

    /// The same, each photon's flux times the sum of its factors by the facets, each times the facet's albedo.
    #[inline(always)]
    pub(super) fn sum_faceted_flux<L: Lanes>(
        &self,
        l: L,
        query: &Query,
        tilt: &Tilt,
        facets: &[Facet],
        stack: &mut Stack,
    ) -> Rgb {
        let mut sums = [l.splat(0.0); 3];
        let side = splat3(l, query.normal);
        self.visit::<L, false>(
            l,
            query,
            stack,
            #[inline(always)]
            |photons: &Block, weight: L::Vector| {
                let (wi, cos) = (load3(l, &photons.wi), l.load(&photons.cos));
                let mut reflected = [l.splat(0.0); 3];
                for facet in facets {
                    let factors = Tilt { normal: facet.normal, ..*tilt }.factors(l, side, wi, cos);
                    reflected = mul_add3(l, factors, splat3(l, facet.albedo), reflected);
                }
                let flux = load3(l, &photons.flux);
                for channel in 0..3 {
                    let part = l.mul(weight, flux[channel]);
                    sums[channel] = l.mul_add(part, reflected[channel], sums[channel]);
                }
            },
        );
        sum3(l, sums)
    }

    /// Calls `photon(kernel weight times factor by the tilt, photon)` for each photon of the disc that counts.
    #[inline(always)]
    pub(super) fn for_each<L: Lanes>(
        &self,
        l: L,
        query: &Query,
        tilt: &Tilt,
        stack: &mut Stack,
        mut photon: impl FnMut(f32, Photon),
    ) {
        self.visit_tilted(
            l,
            query,
            tilt,
            stack,
            #[inline(always)]
            |block: &Block, weight: L::Vector| {
                for (k, weight) in l.store(weight).into_iter().enumerate() {
                    if weight != 0.0 {
                        photon(weight, block.photon(k));
                    }
                }
            },
        );
    }

    /// Calls `block(photons, their kernel weights times their factors by the tilt)` for the photons near the disc.
    #[inline(always)]
    fn visit_tilted<L: Lanes>(
        &self,
        l: L,
        query: &Query,
        tilt: &Tilt,
        stack: &mut Stack,
        mut block: impl FnMut(&Block, L::Vector),
    ) {
        let side = splat3(l, query.normal);
        self.visit::<L, false>(
            l,
            query,
            stack,
            #[inline(always)]
            |photons: &Block, weight: L::Vector| {
                let factors = tilt.factors(l, side, load3(l, &photons.wi), l.load(&photons.cos));
                block(photons, l.mul(weight, factors));
            },
        );
    }

    /// Calls `block(photons, their kernel weights)` for the photons near the disc; weights are 0 outside it and for
    /// wrong tags. If `WHOLE`, and the slope is 0, children in the disc as a whole are left out; returns the sums over
    /// these, by lane.
    #[inline(always)]
    fn visit<L: Lanes, const WHOLE: bool>(
        &self,
        l: L,
        query: &Query,
        stack: &mut Stack,
        mut block: impl FnMut(&Block, L::Vector),
    ) -> [L::Vector; 3] {
        let wide = WideQuery::new(l, query);
        let mut whole = [l.splat(0.0); 3];
        stack.clear();
        stack.extend((!self.nodes.is_empty()).then_some(0));
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            let mut near = l.bits(wide.meets(l, node));
            if WHOLE && query.is_even() && near != 0 {
                let inside = wide.holds(l, query, node);
                if l.bits(inside) != 0 {
                    wide.add_whole(l, node, &self.moments[index as usize], inside, &mut whole);
                    near &= !l.bits(inside);
                }
            }
            while near != 0 {
                let slot = near.trailing_zeros() as usize;
                near &= near - 1;
                let (first, blocks) = (node.first[slot], node.blocks[slot]);
                if blocks == 0 {
                    stack.push(first);
                } else {
                    let (part, place) = (first >> PLACE_BITS, first & ((1 << PLACE_BITS) - 1));
                    for photons in &self.blocks[part as usize][place as usize..][..blocks as usize] {
                        block(photons, wide.weights(l, query, photons));
                    }
                }
            }
        }
        whole
    }

    /// Bytes on the heap.
    pub fn memory_bytes(&self) -> usize {
        self.nodes.capacity() * (size_of::<Node>() + size_of::<Moments>())
            + self.blocks.iter().map(|part| part.capacity() * size_of::<Block>()).sum::<usize>()
    }
}

#[multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
fn sums(map: &PhotonMap, queries: &[Query]) -> Vec<Rgb> {
    let mut stack = Stack::new();
    #[cfg(target_arch = "x86_64")]
    if let Some(avx2) = Avx2::try_new() {
        return queries.iter().map(|query| map.sum_flux(avx2, query, &mut stack)).collect();
    }
    queries.iter().map(|query| map.sum_flux(Portable, query, &mut stack)).collect()
}

#[inline(always)]
fn load3<L: Lanes>(l: L, columns: &Columns) -> [L::Vector; 3] {
    [l.load(&columns[0]), l.load(&columns[1]), l.load(&columns[2])]
}

#[inline(always)]
fn splat3<L: Lanes>(l: L, v: Vec3) -> [L::Vector; 3] {
    [l.splat(v.x), l.splat(v.y), l.splat(v.z)]
}

#[inline(always)]
fn sub3<L: Lanes>(l: L, a: [L::Vector; 3], b: [L::Vector; 3]) -> [L::Vector; 3] {
    [l.sub(a[0], b[0]), l.sub(a[1], b[1]), l.sub(a[2], b[2])]
}

#[inline(always)]
fn max3<L: Lanes>(l: L, a: [L::Vector; 3], b: [L::Vector; 3]) -> [L::Vector; 3] {
    [l.max(a[0], b[0]), l.max(a[1], b[1]), l.max(a[2], b[2])]
}

/// `a b + c` by coordinate.
#[inline(always)]
fn mul_add3<L: Lanes>(l: L, a: L::Vector, b: [L::Vector; 3], c: [L::Vector; 3]) -> [L::Vector; 3] {
    [l.mul_add(a, b[0], c[0]), l.mul_add(a, b[1], c[1]), l.mul_add(a, b[2], c[2])]
}

#[inline(always)]
fn sum3<L: Lanes>(l: L, a: [L::Vector; 3]) -> Rgb {
    Rgb::new(l.sum(a[0]), l.sum(a[1]), l.sum(a[2]))
}

/// A query with its numbers in every lane.
struct WideQuery<L: Lanes> {
    position: [L::Vector; 3],
    normal: [L::Vector; 3],
    abs_normal: [L::Vector; 3],
    slope: [L::Vector; 3],
    radius_sq: L::Vector,
    inverse_radius_sq: L::Vector,
    slab: L::Vector,
}

impl<L: Lanes> WideQuery<L> {
    #[inline(always)]
    fn new(l: L, query: &Query) -> Self {
        let radius_sq = query.radius * query.radius;
        Self {
            position: splat3(l, query.position),
            normal: splat3(l, query.normal),
            abs_normal: splat3(l, query.normal.abs()),
            slope: splat3(l, query.slope),
            radius_sq: l.splat(radius_sq),
            inverse_radius_sq: l.splat(1.0 / radius_sq),
            slab: l.splat(Query::SLAB * query.radius),
        }
    }

    /// Mask of the children whose boxes the ball meets.
    #[inline(always)]
    fn meets(&self, l: L, node: &Node) -> L::Vector {
        let (below, above) = (sub3(l, load3(l, &node.min), self.position), sub3(l, self.position, load3(l, &node.max)));
        let outside = max3(l, max3(l, below, above), [l.splat(0.0); 3]);
        l.less(l.dot(outside, outside), self.radius_sq)
    }

    /// Mask of the children whose photons all are in the disc and have the right tag.
    #[inline(always)]
    fn holds(&self, l: L, query: &Query, node: &Node) -> L::Vector {
        let (min, max) = (load3(l, &node.min), load3(l, &node.max));
        let (above_min, below_max) = (sub3(l, self.position, min), sub3(l, max, self.position));
        let farthest = max3(l, above_min, below_max);
        let twice_height =
            l.add(l.abs(l.dot(sub3(l, below_max, above_min), self.normal)), l.dot(sub3(l, max, min), self.abs_normal));
        let in_slab = l.less(l.mul(twice_height, l.splat(0.5)), self.slab);
        let least = l.in_range(&node.tags[0], query.tag_start, query.tag_span);
        let greatest = l.in_range(&node.tags[1], query.tag_start, query.tag_span);
        l.and(l.and(l.less(l.dot(farthest, farthest), self.radius_sq), in_slab), l.and(least, greatest))
    }

    /// Adds the sums of `1 - |d + offset|^2 / r^2` times the flux over some children of a node.
    #[inline(always)]
    fn add_whole(&self, l: L, node: &Node, moments: &Moments, children: L::Vector, sums: &mut [L::Vector; 3]) {
        let (min, size) = (load3(l, &node.min), sub3(l, load3(l, &node.max), load3(l, &node.min)));
        let offset = sub3(l, mul_add3(l, l.splat(0.5), size, min), self.position);
        let offset_sq = l.dot(offset, offset);
        for (channel, total) in sums.iter_mut().enumerate() {
            let flux = l.load(&moments.flux[channel]);
            let along = l.dot(load3(l, &moments.first[channel]), offset);
            let squares = l.mul_add(flux, offset_sq, l.add(l.load(&moments.second[channel]), l.add(along, along)));
            let sum = l.sub(flux, l.mul(squares, self.inverse_radius_sq));
            *total = l.add(*total, l.and(children, sum));
        }
    }

    /// The kernel inside the disc and for the right tag, else 0.
    #[inline(always)]
    fn weights(&self, l: L, query: &Query, photons: &Block) -> L::Vector {
        let offset = sub3(l, load3(l, &photons.position), self.position);
        let kernel = l.sub(l.splat(1.0), l.mul(l.dot(offset, offset), self.inverse_radius_sq));
        let near_plane = l.less(l.abs(l.dot(offset, self.normal)), self.slab);
        let tagged = l.in_range(&photons.tag, query.tag_start, query.tag_span);
        let mut kernel = l.max(kernel, l.splat(0.0));
        if !query.is_even() {
            kernel = l.mul_add(kernel, l.dot(offset, self.slope), kernel);
        }
        // Last: missing photons are infinitely far away, and their kernel may be no number.
        l.and(kernel, l.and(near_plane, tagged))
    }
}

#[cfg(test)]
mod tests;
