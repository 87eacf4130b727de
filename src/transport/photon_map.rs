//! The photon map: a kd-tree with spatial-median splits over photons in Morton order.
//!
//! Sorting the photons by Morton code is the whole construction: every node is a range of the sorted array, split
//! where the highest differing bit of the codes changes. Leaves keep their photons in columns, side by side. Every node
//! keeps the moments of its photons: the kernel is quadratic, so that they give the sum over a whole node at once.

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
    /// The least tag of its photons.
    least_tag: u32,
    /// The greatest.
    greatest_tag: u32,
}

impl Node {
    /// Whether every photon of the node is in the disc and has the right tag.
    #[inline(always)]
    fn is_inside(&self, query: &Query) -> bool {
        let farthest = (query.position - self.min).abs().max((query.position - self.max).abs());
        if farthest.length_squared() > query.radius * query.radius
            || self.least_tag < query.tag_start
            || self.greatest_tag - query.tag_start >= query.tag_span
        {
            return false;
        }
        let (center, half) = (0.5 * (self.min + self.max), 0.5 * (self.max - self.min));
        let height = (center - query.position).dot(query.normal).abs() + half.dot(query.normal.abs());
        height <= Query::SLAB * query.radius
    }
}

/// Sums over the photons of a node, `d` the offset from the middle of its box.
#[derive(Clone, Copy, Debug, Default)]
struct Moments {
    /// Of the flux.
    flux: Rgb,
    /// Of `d` times the flux, by channel.
    first: [Vec3; 3],
    /// Of `|d|^2` times the flux.
    second: Rgb,
}

impl Moments {
    fn add(&mut self, offset: Vec3, flux: Rgb) {
        self.flux += flux;
        for (first, flux) in self.first.iter_mut().zip(flux.to_array()) {
            *first += offset * flux;
        }
        self.second += flux * offset.length_squared();
    }

    /// Adds those of another node, whose middle is at this offset.
    fn add_shifted(&mut self, other: &Self, offset: Vec3) {
        self.flux += other.flux;
        for ((first, other), flux) in self.first.iter_mut().zip(&other.first).zip(other.flux.to_array()) {
            *first += *other + offset * flux;
        }
        self.second += other.second + 2.0 * other.along(offset) + other.flux * offset.length_squared();
    }

    /// Sum of `d . offset` times the flux.
    #[inline(always)]
    fn along(&self, offset: Vec3) -> Rgb {
        Rgb::from_array(self.first.map(|first| first.dot(offset)))
    }

    /// Sum of `1 - |d + offset|^2 / r^2` times the flux.
    #[inline(always)]
    fn sum(&self, offset: Vec3, inverse_radius_sq: f32) -> Rgb {
        let squares = self.second + 2.0 * self.along(offset) + self.flux * offset.length_squared();
        self.flux - squares * inverse_radius_sq
    }
}

/// Photons for queries by place.
#[derive(Clone, Debug, Default)]
pub struct PhotonMap {
    nodes: Vec<Node>,
    moments: Vec<Moments>,
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
        let mut tree = Tree { photons, order: morton::order(photons), nodes: Vec::new(), moments: Vec::new() };
        if !photons.is_empty() {
            tree.build_node(0, photons.len());
        }
        let Tree { order, nodes, moments, .. } = tree;
        let column = |f: fn(&Photon) -> f32| in_order(photons, &order, f);
        let bits = |f: fn(&Photon) -> u32| in_order(photons, &order, f);
        Self {
            nodes,
            moments,
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
        let mut whole_nodes = Rgb::ZERO;
        let wide = WideQuery::new(query);
        let inverse_radius_sq = 1.0 / (query.radius * query.radius);
        let mut nodes = self.nodes_near(query);
        while let Some((index, node)) = nodes.next() {
            if node.is_inside(query) {
                let center = 0.5 * (node.min + node.max);
                whole_nodes += self.moments[index].sum(center - query.position, inverse_radius_sq);
                nodes.index = node.skip as usize;
            } else {
                let (start, end) = (node.start as usize, (node.start + node.count) as usize);
                for first in (start..end).step_by(LANES) {
                    self.accumulate(&wide, first, end, &mut sums);
                }
            }
        }
        whole_nodes + Rgb::from_array(sums.map(|lanes| lanes.reduce_add()))
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
        let mut nodes = self.nodes_near(query);
        while let Some((_, node)) = nodes.next() {
            for k in node.start as usize..(node.start + node.count) as usize {
                let position = Vec3::new(self.x[k], self.y[k], self.z[k]);
                let weight = kernel_weight(query, inverse, position, self.tag[k]);
                if weight > 0.0 {
                    let flux = Rgb::new(self.red[k], self.green[k], self.blue[k]);
                    photon(weight, flux, PackedDirection::from_bits(self.wi[k]).unpack());
                }
            }
        }
    }

    fn nodes_near<'a>(&'a self, query: &Query) -> NodesNear<'a> {
        NodesNear { nodes: &self.nodes, index: 0, position: query.position, radius_sq: query.radius * query.radius }
    }

    /// Bytes on the heap.
    pub fn memory_bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
            + self.moments.capacity() * size_of::<Moments>()
            + self.len() * 8 * size_of::<f32>()
    }
}

/// Nodes whose box a ball meets, inner ones before their children; inner ones hold no photons of their own.
struct NodesNear<'a> {
    nodes: &'a [Node],
    index: usize,
    position: Vec3,
    radius_sq: f32,
}

impl<'a> NodesNear<'a> {
    /// The next node and its index.
    #[inline(always)]
    fn next(&mut self) -> Option<(usize, &'a Node)> {
        while let Some(node) = self.nodes.get(self.index) {
            let outside = (node.min - self.position).max(self.position - node.max).max(Vec3::ZERO);
            if outside.length_squared() < self.radius_sq {
                self.index += 1;
                return Some((self.index - 1, node));
            }
            self.index = node.skip as usize;
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
    moments: Vec<Moments>,
}

impl Tree<'_> {
    /// Appends the subtree over a range; returns its index.
    fn build_node(&mut self, start: usize, end: usize) -> usize {
        let index = self.nodes.len();
        let unknown =
            Node { min: Vec3::ZERO, max: Vec3::ZERO, start: 0, count: 0, skip: 0, least_tag: 0, greatest_tag: 0 };
        self.nodes.push(unknown);
        self.moments.push(Moments::default());
        if let Some(middle) = self.split(start, end) {
            let children = [self.build_node(start, middle), self.build_node(middle, end)];
            self.join(index, children);
        } else {
            self.finish_leaf(index, start, end);
        }
        self.nodes[index].skip = self.nodes.len() as u32;
        index
    }

    fn join(&mut self, index: usize, children: [usize; 2]) {
        let [a, b] = children.map(|child| self.nodes[child]);
        let (min, max) = (a.min.min(b.min), a.max.max(b.max));
        self.nodes[index] = Node {
            min,
            max,
            least_tag: a.least_tag.min(b.least_tag),
            greatest_tag: a.greatest_tag.max(b.greatest_tag),
            ..self.nodes[index]
        };
        let mut moments = Moments::default();
        for (node, child) in [a, b].iter().zip(children) {
            moments.add_shifted(&self.moments[child], 0.5 * (node.min + node.max) - 0.5 * (min + max));
        }
        self.moments[index] = moments;
    }

    fn finish_leaf(&mut self, index: usize, start: usize, end: usize) {
        let photons = || self.order[start..end].iter().map(|item| &self.photons[item.index as usize]);
        let empty = (Vec3::INFINITY, Vec3::NEG_INFINITY, u32::MAX, 0);
        let (min, max, least_tag, greatest_tag) = photons().fold(empty, |(min, max, least, greatest), p| {
            (min.min(p.position), max.max(p.position), least.min(p.tag), greatest.max(p.tag))
        });
        let mut moments = Moments::default();
        photons().for_each(|p| moments.add(p.position - 0.5 * (min + max), p.flux));
        let (start, count) = (start as u32, (end - start) as u32);
        self.nodes[index] = Node { min, max, start, count, least_tag, greatest_tag, ..self.nodes[index] };
        self.moments[index] = moments;
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
