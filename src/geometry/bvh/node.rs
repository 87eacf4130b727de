//! A node of the tree: the boxes of eight children, and the intersection of rays with them by the slab test \[KayKajiya86\],
//! robust against rounding: \[Ize13\] T. Ize, Robust BVH Ray Traversal, JCGT 2(2), 2013.

use crate::math::lanes::LANES;
use crate::math::{Aabb, Ray};
use glam::DVec3;

/// Children of a node.
pub(super) const WIDTH: usize = 8;

/// The boxes of eight children as a structure of arrays, so that SIMD instructions test all of them.
#[derive(Clone, Debug)]
pub(super) struct Node {
    min: [[f64; WIDTH]; 3],
    max: [[f64; WIDTH]; 3],
    /// For each child, the index of a node, or the bitwise complement of an item.
    pub(super) child: [i32; WIDTH],
    /// The number of children.
    pub(super) count: u32,
}

impl Node {
    /// A node without children.
    pub(super) const EMPTY: Self =
        Self { min: [[f64::INFINITY; WIDTH]; 3], max: [[f64::NEG_INFINITY; WIDTH]; 3], child: [0; WIDTH], count: 0 };

    /// Sets the box and the child of a slot.
    pub(super) fn set(&mut self, slot: usize, bounds: &Aabb, child: i32) {
        self.set_bounds(slot, bounds);
        self.child[slot] = child;
        self.count = self.count.max(slot as u32 + 1);
    }

    /// Sets the box of a slot, enlarged by the rounding of the slab test.
    pub(super) fn set_bounds(&mut self, slot: usize, bounds: &Aabb) {
        // A slab test rounds three times; this many ulp more on each side make it conservative.
        let margin = 4.0 * f64::EPSILON * bounds.min.abs().max(bounds.max.abs()).max_element();
        let bounds = bounds.inflated(margin);
        for axis in 0..3 {
            self.min[axis][slot] = bounds.min[axis];
            self.max[axis][slot] = bounds.max[axis];
        }
    }

    /// The box around all children.
    pub(super) fn bounds(&self) -> Aabb {
        let corner =
            |columns: &[[f64; WIDTH]; 3], slot: usize| DVec3::new(columns[0][slot], columns[1][slot], columns[2][slot]);
        (0..self.count as usize)
            .map(|slot| Aabb { min: corner(&self.min, slot), max: corner(&self.max, slot) })
            .fold(Aabb::EMPTY, |all, one| all.union(&one))
    }

    /// For each child, the squared distance of a point to its box; infinite for an empty slot.
    #[inline(always)]
    pub(super) fn distances_squared(&self, point: DVec3) -> [f64; WIDTH] {
        let mut squares = [0.0; WIDTH];
        for axis in 0..3 {
            for (slot, square) in squares.iter_mut().enumerate() {
                let outside = (self.min[axis][slot] - point[axis]).max(point[axis] - self.max[axis][slot]).max(0.0);
                *square += outside * outside;
            }
        }
        squares
    }

    /// The rays of a packet that hit the box of a child (a bit each), and the least t of an entry.
    #[inline(always)]
    pub(super) fn packet_entry(&self, slot: usize, packet: &PacketColumns, rays: &[Ray; LANES]) -> (u32, f64) {
        let (mut near, mut far): ([f64; LANES], [f64; LANES]) = (packet.t_min, [0.0; LANES]);
        for (far, ray) in far.iter_mut().zip(rays) {
            *far = ray.t_max;
        }
        for axis in 0..3 {
            let (low, high) = (self.min[axis][slot], self.max[axis][slot]);
            for lane in 0..LANES {
                let a = (low - packet.origin[axis][lane]) * packet.inverse[axis][lane];
                let b = (high - packet.origin[axis][lane]) * packet.inverse[axis][lane];
                let (enter, leave) = if a < b { (a, b) } else { (b, a) };
                near[lane] = if enter > near[lane] { enter } else { near[lane] };
                far[lane] = if leave < far[lane] { leave } else { far[lane] };
            }
        }
        let (mut entered, mut nearest) = (0, f64::INFINITY);
        for lane in 0..LANES {
            // The exit is enlarged as for a single ray.
            let hits = near[lane] <= far[lane] * (1.0 + 4.0 * f64::EPSILON);
            entered |= u32::from(hits) << lane;
            nearest = if hits && near[lane] < nearest { near[lane] } else { nearest };
        }
        (entered, nearest)
    }

    /// For each child, t of the ray's entry into its box, by the slab test \[KayKajiya86\]; infinity for a miss.
    ///
    /// A NaN (from a ray in a face of the box) leaves the interval unchanged, by the form of the comparisons.
    #[inline(always)]
    pub(super) fn entry_distances(&self, ray: &Ray, inverse: DVec3) -> [f64; WIDTH] {
        let mut near = [ray.t_min; WIDTH];
        let mut far = [ray.t_max; WIDTH];
        for axis in 0..3 {
            let (origin, inverse) = (ray.origin[axis], inverse[axis]);
            let (low, high) =
                if inverse < 0.0 { (&self.max[axis], &self.min[axis]) } else { (&self.min[axis], &self.max[axis]) };
            for slot in 0..WIDTH {
                let enter = (low[slot] - origin) * inverse;
                let leave = (high[slot] - origin) * inverse;
                near[slot] = if enter > near[slot] { enter } else { near[slot] };
                far[slot] = if leave < far[slot] { leave } else { far[slot] };
            }
        }
        for slot in 0..WIDTH {
            // The exit is enlarged by the rounding of a product, so that rays do not miss boxes without thickness \[Ize13\].
            near[slot] = if near[slot] <= far[slot] * (1.0 + 4.0 * f64::EPSILON) { near[slot] } else { f64::INFINITY };
        }
        near
    }
}

/// The eight rays of a packet as a structure of arrays.
pub(super) struct PacketColumns {
    origin: [[f64; LANES]; 3],
    /// 1 over the direction, finite, so that a ray in a face of a box yields no NaN.
    inverse: [[f64; LANES]; 3],
    t_min: [f64; LANES],
}

impl PacketColumns {
    /// The packet of these rays.
    #[inline(always)]
    pub(super) fn new(rays: &[Ray; LANES]) -> Self {
        let (mut origin, mut inverse, mut t_min) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3], [0.0; LANES]);
        for (lane, ray) in rays.iter().enumerate() {
            for axis in 0..3 {
                let d = ray.direction[axis];
                origin[axis][lane] = ray.origin[axis];
                inverse[axis][lane] = 1.0 / if d.abs() < 1e-300 { 1e-300f64.copysign(d) } else { d };
            }
            t_min[lane] = ray.t_min;
        }
        Self { origin, inverse, t_min }
    }
}
