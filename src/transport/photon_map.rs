//! The photon map: a kd-tree with spatial-median splits over photons in Morton order.
//!
//! Sorting the photons by Morton code is the whole construction: every node is a range of the sorted array, split
//! where the highest differing bit of the codes changes. Leaves keep their photons in columns, side by side.

use super::morton::{self, Coded};
use super::photon::{PackedDirection, Photon};
use crate::math::Rgb;
use glam::Vec3;
use wide::{f32x8, u32x8};

/// Photons in a leaf at most, unless they are in the same place.
const LEAF_SIZE: usize = 32;

/// A node of the tree in depth-first order.
#[derive(Clone, Copy, Debug)]
struct Node {
    min: Vec3,
    max: Vec3,
    /// First photon of the range.
    start: u32,
    /// Photons of a leaf; 0 for an inner node.
    count: u32,
    /// The node that follows when this one's descendants are left out.
    skip: u32,
}

/// Photons for queries by place.
#[derive(Clone, Debug, Default)]
pub struct PhotonMap {
    nodes: Vec<Node>,
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
    red: Vec<f32>,
    green: Vec<f32>,
    blue: Vec<f32>,
    tag: Vec<u32>,
    wi: Vec<u32>,
}

/// What a density estimate looks for.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// In the coordinates of the photons.
    pub position: Vec3,
    /// Unit length; photons farther than [`Query::SLAB`] radii from the tangent plane belong to another surface.
    pub normal: Vec3,
    /// Of the disc.
    pub radius: f32,
    /// Photons count whose tag is at least this, by less than `tag_span`.
    pub tag_start: u32,
    /// See `tag_start`.
    pub tag_span: u32,
}

impl Query {
    /// Half the thickness of the disc, in radii: a surface curves away from its tangent plane by a quarter of the
    /// radius where the radius is half the radius of curvature.
    pub const SLAB: f32 = 0.25;
}

impl PhotonMap {
    /// The map of these photons. Depends on their order only among photons in the same place.
    pub fn build(photons: &[Photon]) -> Self {
        let mut tree = Tree { photons, order: morton::order(photons), nodes: Vec::with_capacity(photons.len() / 4) };
        if !photons.is_empty() {
            tree.build_node(0, photons.len());
        }
        let Tree { order, nodes, .. } = tree;
        let column = |f: fn(&Photon) -> f32| in_order(photons, &order, f);
        let bits = |f: fn(&Photon) -> u32| in_order(photons, &order, f);
        Self {
            nodes,
            x: column(|p| p.position.x),
            y: column(|p| p.position.y),
            z: column(|p| p.position.z),
            red: column(|p| p.flux.x),
            green: column(|p| p.flux.y),
            blue: column(|p| p.flux.z),
            tag: bits(|p| p.tag),
            wi: bits(|p| p.wi.bits()),
        }
    }

    /// The number of photons.
    pub fn len(&self) -> usize {
        self.x.len().saturating_sub(LANES)
    }

    /// Whether there is no photon.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Sum of flux times the Epanechnikov kernel `1 - d^2 / r^2` over the photons of the disc.
    #[inline(always)]
    pub(super) fn sum_flux(&self, query: &Query) -> Rgb {
        let mut sums = [f32x8::ZERO; 3];
        let wide = WideQuery::new(query);
        let mut leaves = self.leaves(query);
        while let Some((start, end)) = leaves.next() {
            for first in (start..end).step_by(LANES) {
                self.accumulate(&wide, first, end, &mut sums);
            }
        }
        Rgb::from_array(sums.map(|lanes| lanes.reduce_add()))
    }

    /// Adds up to [`LANES`] photons, those before `end`, to as many partial sums; without branches.
    #[inline(always)]
    fn accumulate(&self, query: &WideQuery, first: usize, end: usize, sums: &mut [f32x8; 3]) {
        let column = |values: &[f32]| values[first..].first_chunk().map_or(f32x8::ZERO, |lanes| f32x8::new(*lanes));
        let dx = column(&self.x) - query.x;
        let dy = column(&self.y) - query.y;
        let dz = column(&self.z) - query.z;
        let kernel = f32x8::ONE - (dx * dx + dy * dy + dz * dz) * query.inverse_radius_sq;
        let height = (dx * query.normal_x + dy * query.normal_y + dz * query.normal_z).abs();
        let tag = self.tag[first..].first_chunk().map_or(u32x8::ZERO, |lanes| u32x8::new(*lanes)) - query.tag_start;
        let tagged = tag.simd_le(query.last_tag);
        let left = query.lane.simd_lt(f32x8::splat((end - first) as f32));
        let counts = height.simd_le(query.slab) & left & f32x8::from_bits(tagged);
        let weight = kernel.max(f32x8::ZERO) & counts;
        for (sum, color) in sums.iter_mut().zip([&self.red, &self.green, &self.blue]) {
            *sum += weight * column(color);
        }
    }

    /// Calls `photon(kernel weight, flux, direction to where the photon came from)` for each photon of the disc.
    pub(super) fn for_each(&self, query: &Query, mut photon: impl FnMut(f32, Rgb, Vec3)) {
        let inverse = 1.0 / (query.radius * query.radius);
        let mut leaves = self.leaves(query);
        while let Some((start, end)) = leaves.next() {
            for k in start..end {
                let position = Vec3::new(self.x[k], self.y[k], self.z[k]);
                let weight = kernel_weight(query, inverse, position, self.tag[k]);
                if weight > 0.0 {
                    let flux = Rgb::new(self.red[k], self.green[k], self.blue[k]);
                    photon(weight, flux, PackedDirection::from_bits(self.wi[k]).unpack());
                }
            }
        }
    }

    fn leaves<'a>(&'a self, query: &Query) -> Leaves<'a> {
        Leaves { nodes: &self.nodes, index: 0, position: query.position, radius_sq: query.radius * query.radius }
    }

    /// Bytes on the heap.
    pub fn memory_bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>() + self.len() * 8 * size_of::<f32>()
    }
}

/// Leaves whose box a ball meets.
struct Leaves<'a> {
    nodes: &'a [Node],
    index: usize,
    position: Vec3,
    radius_sq: f32,
}

impl Leaves<'_> {
    /// The range of photons of the next leaf.
    #[inline(always)]
    fn next(&mut self) -> Option<(usize, usize)> {
        while let Some(node) = self.nodes.get(self.index) {
            let outside = (node.min - self.position).max(self.position - node.max).max(Vec3::ZERO);
            if outside.length_squared() >= self.radius_sq {
                self.index = node.skip as usize;
                continue;
            }
            self.index += 1;
            if node.count > 0 {
                return Some((node.start as usize, (node.start + node.count) as usize));
            }
        }
        None
    }
}

/// Photons that one pass of vector instructions handles.
const LANES: usize = 8;

/// A query with its numbers in every lane.
struct WideQuery {
    x: f32x8,
    y: f32x8,
    z: f32x8,
    normal_x: f32x8,
    normal_y: f32x8,
    normal_z: f32x8,
    inverse_radius_sq: f32x8,
    slab: f32x8,
    tag_start: u32x8,
    last_tag: u32x8,
    /// The lane's number.
    lane: f32x8,
}

impl WideQuery {
    #[inline(always)]
    fn new(query: &Query) -> Self {
        let splat = f32x8::splat;
        Self {
            x: splat(query.position.x),
            y: splat(query.position.y),
            z: splat(query.position.z),
            normal_x: splat(query.normal.x),
            normal_y: splat(query.normal.y),
            normal_z: splat(query.normal.z),
            inverse_radius_sq: splat(1.0 / (query.radius * query.radius)),
            slab: splat(Query::SLAB * query.radius),
            tag_start: u32x8::splat(query.tag_start),
            last_tag: u32x8::splat(query.tag_span - 1),
            lane: f32x8::new([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]),
        }
    }
}

/// `1 - d^2 / r^2` inside the disc and for the right tag, else 0; without branches.
#[inline(always)]
fn kernel_weight(query: &Query, inverse_radius_sq: f32, position: Vec3, tag: u32) -> f32 {
    let offset = position - query.position;
    let weight = 1.0 - offset.length_squared() * inverse_radius_sq;
    let near_plane = offset.dot(query.normal).abs() <= Query::SLAB * query.radius;
    let right_tag = tag.wrapping_sub(query.tag_start) < query.tag_span;
    if weight > 0.0 && near_plane && right_tag { weight } else { 0.0 }
}

/// The nodes while they are built.
struct Tree<'a> {
    photons: &'a [Photon],
    order: Vec<Coded>,
    nodes: Vec<Node>,
}

impl Tree<'_> {
    /// Appends the subtree over a range and returns its box.
    fn build_node(&mut self, start: usize, end: usize) -> (Vec3, Vec3) {
        let index = self.nodes.len();
        self.nodes.push(Node { min: Vec3::ZERO, max: Vec3::ZERO, start: start as u32, count: 0, skip: 0 });
        let (min, max) = if let Some(middle) = self.split(start, end) {
            let (left, right) = (self.build_node(start, middle), self.build_node(middle, end));
            (left.0.min(right.0), left.1.max(right.1))
        } else {
            self.nodes[index].count = (end - start) as u32;
            self.bounds(start, end)
        };
        let skip = self.nodes.len() as u32;
        let node = &mut self.nodes[index];
        (node.min, node.max, node.skip) = (min, max, skip);
        (min, max)
    }

    /// Where the highest differing bit of the codes changes; `None` for a leaf.
    fn split(&mut self, start: usize, end: usize) -> Option<usize> {
        if end - start <= LEAF_SIZE {
            return None;
        }
        let differing = |order: &[Coded]| order[start].code ^ order[end - 1].code;
        if differing(&self.order) == 0 {
            // All in one cell of the grid: a finer grid over this cell alone tells them apart.
            morton::refine(self.photons, &mut self.order[start..end]);
        }
        let bit = differing(&self.order).checked_ilog2()?;
        Some(start + self.order[start..end].partition_point(|item| item.code >> bit & 1 == 0))
    }

    fn bounds(&self, start: usize, end: usize) -> (Vec3, Vec3) {
        let positions = self.order[start..end].iter().map(|item| self.photons[item.index as usize].position);
        positions.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), p| (min.min(p), max.max(p)))
    }
}

/// One value of each photon in the order of the map, and zeros that the last vector of instructions may read.
fn in_order<T: Default + Send>(photons: &[Photon], order: &[Coded], value: fn(&Photon) -> T) -> Vec<T> {
    let mut values = Vec::with_capacity(order.len() + LANES);
    values.extend(order.iter().map(|item| value(&photons[item.index as usize])));
    values.extend((0..LANES).map(|_| T::default()));
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, Stream};

    fn photons(count: u64, place: impl Fn(&mut Sampler) -> Vec3) -> Vec<Photon> {
        (0..count)
            .map(|k| {
                let mut s = Sampler::new(1, Stream::Test, 77, k);
                let position = place(&mut s);
                let flux = Rgb::new(1.0, s.next_1d() as f32, 0.5);
                Photon { position, flux, wi: PackedDirection::pack(Vec3::Z), tag: (k % 3) as u32 }
            })
            .collect()
    }

    fn brute_force(photons: &[Photon], query: &Query) -> Rgb {
        let inverse = 1.0 / (query.radius * query.radius);
        photons.iter().map(|p| p.flux * kernel_weight(query, inverse, p.position, p.tag)).sum()
    }

    #[test]
    fn sums_what_a_linear_scan_sums() {
        let unit = |s: &mut Sampler| Vec3::new(s.next_1d() as f32, s.next_1d() as f32, s.next_1d() as f32);
        let plane = |s: &mut Sampler| Vec3::new(s.next_1d() as f32, 0.25, s.next_1d() as f32);
        let line = |s: &mut Sampler| Vec3::new(0.0, 1e-3 * s.next_1d() as f32, 0.0);
        let point = |_: &mut Sampler| Vec3::splat(0.5);
        // A far one puts all others into one cell of the grid.
        let far = |s: &mut Sampler| if s.next_1d() < 0.01 { 1e7 * unit(s) } else { unit(s) };
        let places: [&dyn Fn(&mut Sampler) -> Vec3; 5] = [&unit, &plane, &line, &point, &far];
        for (place, count) in places.into_iter().flat_map(|p| [0, 1, 7, 16, 17, 4000].map(|n| (p, n))) {
            let photons = photons(count, place);
            let map = PhotonMap::build(&photons);
            assert_eq!(map.len(), photons.len());
            let largest = map.nodes.iter().map(|node| node.count as usize).max().unwrap_or(0);
            assert!(largest <= LEAF_SIZE || photons.iter().all(|p| p.position == photons[0].position), "{largest}");
            for k in 0..50 {
                let mut s = Sampler::new(2, Stream::Test, 5, k);
                let position = place(&mut s);
                let radius = 0.3 * s.next_1d() as f32;
                let query = Query { position, normal: Vec3::Y, radius, tag_start: 1, tag_span: 2 };
                let (found, expected) = (map.sum_flux(&query), brute_force(&photons, &query));
                // Sums of up to 4000 terms of size 1 in another order: 4000 roundings of 6e-8 of the sum at most.
                assert!((found - expected).abs().max_element() <= 3e-4 * (1.0 + expected.max_element()));
                let mut by_visit = Rgb::ZERO;
                map.for_each(&query, |weight, flux, _| by_visit += weight * flux);
                assert!((by_visit - expected).abs().max_element() <= 3e-4 * (1.0 + expected.max_element()));
            }
        }
    }
}
