//! The map and its sums over discs.

use super::node::{BLOCK_INDEX_BITS, Moments, Node, PhotonBlock};
use super::query::{Query, WideQuery, load3, mul_add3, splat3, sum3};
use crate::math::lanes::simd_dispatch;
use crate::math::{Lanes, Rgb};
use crate::transport::photons::{CosineCorrection, Photon};
use crate::transport::points::Facet;

/// Photons, to be found by position.
#[derive(Clone, Debug, Default)]
pub struct PhotonMap {
    /// The root first; empty for a map without photons.
    pub(super) nodes: Vec<Node>,
    /// The moments of the node with the same index.
    pub(super) moments: Vec<Moments>,
    /// The blocks below each child of the root: subtrees are built independently, and their blocks are not moved again.
    pub(super) blocks: Vec<Vec<PhotonBlock>>,
    pub(super) len: usize,
}

/// Indices of the nodes still to visit; reused by the next query to save allocations.
pub(in crate::transport) type Stack = Vec<u32>;

impl PhotonMap {
    /// The number of photons.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether the map holds no photon.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The sum of flux times the kernel over the photons of each query's disc, W; one value for each query, in their order.
    pub fn sums(&self, queries: &[Query]) -> Vec<Rgb> {
        sums(self, queries)
    }

    /// The sum of flux times the kernel over the photons of a disc, W.
    #[inline(always)]
    pub(in crate::transport) fn sum_flux<L: Lanes>(&self, l: L, query: &Query, stack: &mut Stack) -> Rgb {
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

    /// The sum of the squares of flux times the kernel: the variance of [`Self::sum_flux`] for independent photons.
    #[inline(always)]
    pub(in crate::transport) fn sum_squares<L: Lanes>(&self, l: L, query: &Query, stack: &mut Stack) -> Rgb {
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

    /// The sum of flux times the kernel times the cosine correction of each photon, W.
    #[inline(always)]
    pub(in crate::transport) fn sum_corrected_flux<L: Lanes>(
        &self,
        l: L,
        query: &Query,
        correction: &CosineCorrection,
        stack: &mut Stack,
    ) -> Rgb {
        let mut sums = [l.splat(0.0); 3];
        self.visit_corrected(
            l,
            query,
            correction,
            stack,
            #[inline(always)]
            |block: &PhotonBlock, weight: L::Vector| sums = mul_add3(l, weight, load3(l, &block.flux), sums),
        );
        sum3(l, sums)
    }

    /// The sum of flux times the kernel times the sum over facets of albedo times cosine correction, W.
    #[inline(always)]
    pub(in crate::transport) fn sum_faceted_flux<L: Lanes>(
        &self,
        l: L,
        query: &Query,
        correction: &CosineCorrection,
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
            |photons: &PhotonBlock, weight: L::Vector| {
                let (wi, cos) = (load3(l, &photons.wi), l.load(&photons.cos));
                let mut reflected = [l.splat(0.0); 3];
                for facet in facets {
                    let factors = CosineCorrection { normal: facet.normal, ..*correction }.factors(l, side, wi, cos);
                    reflected = mul_add3(l, factors, splat3(l, facet.albedo), reflected);
                }
                let flux = load3(l, &photons.flux);
                for channel in 0..3 {
                    let term = l.mul(weight, flux[channel]);
                    sums[channel] = l.mul_add(term, reflected[channel], sums[channel]);
                }
            },
        );
        sum3(l, sums)
    }

    /// Calls `photon(kernel weight times cosine correction, photon)` for each photon of a disc whose weight is not 0.
    #[inline(always)]
    pub(in crate::transport) fn for_each<L: Lanes>(
        &self,
        l: L,
        query: &Query,
        correction: &CosineCorrection,
        stack: &mut Stack,
        mut photon: impl FnMut(f32, Photon),
    ) {
        self.visit_corrected(
            l,
            query,
            correction,
            stack,
            #[inline(always)]
            |block: &PhotonBlock, weight: L::Vector| {
                for (k, weight) in l.store(weight).into_iter().enumerate() {
                    if weight != 0.0 {
                        photon(weight, block.photon(k));
                    }
                }
            },
        );
    }

    /// Calls `block(photons, kernel weights times cosine corrections)` for the photons near a disc.
    #[inline(always)]
    fn visit_corrected<L: Lanes>(
        &self,
        l: L,
        query: &Query,
        correction: &CosineCorrection,
        stack: &mut Stack,
        mut block: impl FnMut(&PhotonBlock, L::Vector),
    ) {
        let side = splat3(l, query.normal);
        self.visit::<L, false>(
            l,
            query,
            stack,
            #[inline(always)]
            |photons: &PhotonBlock, weight: L::Vector| {
                let factors = correction.factors(l, side, load3(l, &photons.wi), l.load(&photons.cos));
                block(photons, l.mul(weight, factors));
            },
        );
    }

    /// Calls `block(photons, kernel weights)` for the photons near a disc; weights are 0 outside the disc and for other tags. If `WHOLE`
    /// and the kernel has no slope, children inside the disc are left out; returns the sums of flux times kernel over their photons,
    /// by lane.
    #[inline(always)]
    fn visit<L: Lanes, const WHOLE: bool>(
        &self,
        l: L,
        query: &Query,
        stack: &mut Stack,
        mut block: impl FnMut(&PhotonBlock, L::Vector),
    ) -> [L::Vector; 3] {
        let wide = WideQuery::new(l, query);
        let mut whole = [l.splat(0.0); 3];
        stack.clear();
        stack.extend((!self.nodes.is_empty()).then_some(0));
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            let mut near = l.bits(wide.overlaps(l, node));
            if WHOLE && query.is_symmetric() && near != 0 {
                let inside = wide.contains(l, query, node);
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
                    let (subtree, index) = (first >> BLOCK_INDEX_BITS, first & ((1 << BLOCK_INDEX_BITS) - 1));
                    for photons in &self.blocks[subtree as usize][index as usize..][..blocks as usize] {
                        block(photons, wide.weights(l, query, photons));
                    }
                }
            }
        }
        whole
    }

    /// Memory on the heap, bytes.
    pub fn memory_bytes(&self) -> usize {
        self.nodes.capacity() * (size_of::<Node>() + size_of::<Moments>())
            + self.blocks.iter().map(|blocks| blocks.capacity() * size_of::<PhotonBlock>()).sum::<usize>()
    }
}

simd_dispatch! {
    fn sums(l: impl Lanes, map: &PhotonMap, queries: &[Query]) -> Vec<Rgb> {
        let mut stack = Stack::new();
        queries.iter().map(|query| map.sum_flux(l, query, &mut stack)).collect()
    }
}
