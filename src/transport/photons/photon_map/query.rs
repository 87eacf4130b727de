//! The disc of a density estimate, and the tests of boxes and photons against the disc, eight at a time.

use super::node::{Columns, Moments, Node, PhotonBlock};
use crate::math::{Lanes, Rgb};
use glam::Vec3;

/// A disc and the photons that count in it.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// Middle of the disc, relative to the middle of the world.
    pub position: Vec3,
    /// Unit normal of the disc. Photons farther than [`Query::SLAB`] radii from the tangent plane belong to another surface.
    pub normal: Vec3,
    /// Radius of the disc, scene units.
    pub radius: f32,
    /// The kernel is `(1 - d^2 / r^2) (1 + slope d)`, `d` the offset from the position.
    pub slope: Vec3,
    /// First tag of the photons that count.
    pub tag_start: u32,
    /// Number of tags from `tag_start` on that count; not 0.
    pub tag_span: u32,
}

impl Query {
    /// Half the thickness of the disc, in radii. A disc with half the radius of curvature of a surface needs a quarter.
    pub const SLAB: f32 = 0.25;

    /// Whether the kernel is radially symmetric.
    pub(super) fn is_symmetric(&self) -> bool {
        self.slope == Vec3::ZERO
    }
}

#[inline(always)]
pub(super) fn load3<L: Lanes>(l: L, columns: &Columns) -> [L::Vector; 3] {
    [l.load(&columns[0]), l.load(&columns[1]), l.load(&columns[2])]
}

#[inline(always)]
pub(super) fn splat3<L: Lanes>(l: L, v: Vec3) -> [L::Vector; 3] {
    [l.splat(v.x), l.splat(v.y), l.splat(v.z)]
}

#[inline(always)]
pub(super) fn sub3<L: Lanes>(l: L, a: [L::Vector; 3], b: [L::Vector; 3]) -> [L::Vector; 3] {
    [l.sub(a[0], b[0]), l.sub(a[1], b[1]), l.sub(a[2], b[2])]
}

#[inline(always)]
pub(super) fn max3<L: Lanes>(l: L, a: [L::Vector; 3], b: [L::Vector; 3]) -> [L::Vector; 3] {
    [l.max(a[0], b[0]), l.max(a[1], b[1]), l.max(a[2], b[2])]
}

/// `a b + c` by coordinate.
#[inline(always)]
pub(super) fn mul_add3<L: Lanes>(l: L, a: L::Vector, b: [L::Vector; 3], c: [L::Vector; 3]) -> [L::Vector; 3] {
    [l.mul_add(a, b[0], c[0]), l.mul_add(a, b[1], c[1]), l.mul_add(a, b[2], c[2])]
}

#[inline(always)]
pub(super) fn sum3<L: Lanes>(l: L, a: [L::Vector; 3]) -> Rgb {
    Rgb::new(l.sum(a[0]), l.sum(a[1]), l.sum(a[2]))
}

/// A query with its numbers in every lane.
pub(super) struct WideQuery<L: Lanes> {
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
    pub(super) fn new(l: L, query: &Query) -> Self {
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

    /// Mask of the children whose boxes overlap the ball around the disc.
    #[inline(always)]
    pub(super) fn overlaps(&self, l: L, node: &Node) -> L::Vector {
        let (below, above) = (sub3(l, load3(l, &node.min), self.position), sub3(l, self.position, load3(l, &node.max)));
        let outside = max3(l, max3(l, below, above), [l.splat(0.0); 3]);
        l.less(l.dot(outside, outside), self.radius_sq)
    }

    /// Mask of the children all of whose photons lie in the disc and have tags that count.
    #[inline(always)]
    pub(super) fn contains(&self, l: L, query: &Query, node: &Node) -> L::Vector {
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

    /// Adds the sums of `1 - |d + offset|^2 / r^2` times the flux over the masked children of a node, from their moments.
    #[inline(always)]
    pub(super) fn add_whole(
        &self,
        l: L,
        node: &Node,
        moments: &Moments,
        children: L::Vector,
        sums: &mut [L::Vector; 3],
    ) {
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

    /// The kernel at photons inside the disc whose tags count, else 0.
    #[inline(always)]
    pub(super) fn weights(&self, l: L, query: &Query, photons: &PhotonBlock) -> L::Vector {
        let offset = sub3(l, load3(l, &photons.position), self.position);
        let kernel = l.sub(l.splat(1.0), l.mul(l.dot(offset, offset), self.inverse_radius_sq));
        let near_plane = l.less(l.abs(l.dot(offset, self.normal)), self.slab);
        let tagged = l.in_range(&photons.tag, query.tag_start, query.tag_span);
        let mut kernel = l.max(kernel, l.splat(0.0));
        if !query.is_symmetric() {
            kernel = l.mul_add(kernel, l.dot(offset, self.slope), kernel);
        }
        // The mask comes last: the kernel of unused lanes, infinitely far away, may be NaN.
        l.and(kernel, l.and(near_plane, tagged))
    }
}
