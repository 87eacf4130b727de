//! A bounding volume hierarchy with eight children per node \[DHK08\], built by the surface area heuristic \[Wald07\], over
//! anything that has a box.

use crate::math::lanes::LANES;
use crate::math::{Aabb, Ray};
use arrayvec::ArrayVec;

const WIDTH: usize = 8;
/// Levels built by the surface area heuristic. Nodes below split in halves, which bounds the depth of the tree.
const HEURISTIC_LEVELS: usize = 12;
/// Each level leaves at most 7 entries on the stack; halving 2^31 items by eights takes 11 levels more.
const STACK_CAPACITY: usize = 8 + 7 * (HEURISTIC_LEVELS + 11);
/// Bins of the surface area heuristic. More than 16 hardly improve trees of a few thousand boxes.
const BINS: usize = 16;

/// The boxes of eight children as a structure of arrays, so that SIMD instructions test all of them.
#[derive(Clone, Debug)]
struct Node {
    min: [[f64; WIDTH]; 3],
    max: [[f64; WIDTH]; 3],
    /// A node's index, or the bitwise complement of an item's index.
    child: [i32; WIDTH],
    count: u32,
}

/// A tree over boxes. An item is the index of its box.
#[derive(Clone, Debug, Default)]
pub struct Bvh {
    /// A parent stands before its children.
    nodes: Vec<Node>,
}

impl Bvh {
    /// The tree over these boxes, in O(n log n). Empty boxes are never visited.
    pub fn build(boxes: &[Aabb]) -> Self {
        let mut items: Vec<u32> = (0..boxes.len() as u32).filter(|&i| !boxes[i as usize].is_empty()).collect();
        let mut bvh = Self::default();
        if !items.is_empty() {
            bvh.build_node(boxes, &mut items, 0);
        }
        bvh
    }

    fn build_node(&mut self, boxes: &[Aabb], items: &mut [u32], level: usize) -> i32 {
        let index = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        for (slot, group) in partition(boxes, items, level < HEURISTIC_LEVELS).into_iter().enumerate() {
            let bounds = union_of(boxes, group);
            let child = if let [item] = group { !(*item as i32) } else { self.build_node(boxes, group, level + 1) };
            self.nodes[index].set(slot, &bounds, child);
        }
        index as i32
    }

    /// Refits the boxes of the nodes to moved items, in O(n); the tree keeps its topology.
    pub fn refit(&mut self, boxes: &[Aabb]) {
        for index in (0..self.nodes.len()).rev() {
            for slot in 0..self.nodes[index].count as usize {
                let child = self.nodes[index].child[slot];
                let bounds = if child < 0 { boxes[!child as usize] } else { self.nodes[child as usize].bounds() };
                self.nodes[index].set_bounds(slot, &bounds);
            }
        }
    }

    /// The box around all items.
    pub fn bounds(&self) -> Aabb {
        self.nodes.first().map_or(Aabb::EMPTY, Node::bounds)
    }

    /// Calls `visit(item, ray)` for the items whose box the ray hits, near items first. `visit` may shorten the ray
    /// (`t_max`); it returns whether to continue.
    #[inline(always)]
    pub fn traverse(&self, ray: &mut Ray, mut visit: impl FnMut(u32, &mut Ray) -> bool) {
        if self.nodes.is_empty() {
            return;
        }
        let inverse = 1.0 / ray.direction;
        let mut stack = Stack::new();
        stack.push((ray.t_min, 0));
        while let Some((t, child)) = stack.pop() {
            if t > ray.t_max {
                continue;
            }
            if child < 0 {
                if !visit(!child as u32, ray) {
                    return;
                }
                continue;
            }
            let node = &self.nodes[child as usize];
            let near = node.entry_distances(ray, inverse);
            push_sorted(&mut stack, &near, &node.child[..node.count as usize]);
        }
    }

    /// Calls `visit(item, active, rays)` for the items whose box a ray of the packet hits; `active` has a bit for each such
    /// ray. `visit` may shorten the rays.
    #[inline(always)]
    pub fn traverse_packet(&self, rays: &mut [Ray; LANES], mut visit: impl FnMut(u32, u32, &mut [Ray; LANES])) {
        let packet = PacketColumns::new(rays);
        let mut stack: ArrayVec<(f64, i32, u32), STACK_CAPACITY> = ArrayVec::new();
        if !self.nodes.is_empty() {
            stack.push((f64::NEG_INFINITY, 0, (1 << LANES) - 1));
        }
        while let Some((near, child, mut active)) = stack.pop() {
            for (lane, ray) in rays.iter().enumerate() {
                // `near` is the entry of the first ray: this ray enters no earlier.
                active &= !(u32::from(near > ray.t_max) << lane);
            }
            if active == 0 {
                continue;
            }
            if child < 0 {
                visit(!child as u32, active, rays);
                continue;
            }
            let node = &self.nodes[child as usize];
            let bottom = stack.len();
            for slot in 0..node.count as usize {
                let (entered, near) = node.packet_entry(slot, &packet, rays);
                if entered & active != 0 {
                    stack.push((near, node.child[slot], entered & active));
                }
            }
            stack[bottom..].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        }
    }

    /// The distance of a point to the nearest item, or `limit` if that is less. `distance(item, limit)` gives the distance to
    /// one item, or its limit.
    #[inline(always)]
    pub fn distance(&self, point: glam::DVec3, limit: f64, mut distance: impl FnMut(u32, f64) -> f64) -> f64 {
        let mut nearest = limit;
        let mut open: ArrayVec<i32, STACK_CAPACITY> = self.nodes.first().map(|_| 0).into_iter().collect();
        while let Some(child) = open.pop() {
            if child < 0 {
                nearest = nearest.min(distance(!child as u32, nearest));
                continue;
            }
            let node = &self.nodes[child as usize];
            let distances = node.distances_squared(point);
            let near = |slot: &usize| distances[*slot] < nearest * nearest;
            open.extend((0..WIDTH).filter(near).map(|slot| node.child[slot]));
        }
        nearest
    }

    /// Bytes on the heap.
    pub fn memory_bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
    }
}

impl Node {
    const EMPTY: Self =
        Self { min: [[f64::INFINITY; WIDTH]; 3], max: [[f64::NEG_INFINITY; WIDTH]; 3], child: [0; WIDTH], count: 0 };

    fn set(&mut self, slot: usize, bounds: &Aabb, child: i32) {
        self.set_bounds(slot, bounds);
        self.child[slot] = child;
        self.count = self.count.max(slot as u32 + 1);
    }

    fn set_bounds(&mut self, slot: usize, bounds: &Aabb) {
        // A slab test rounds three times; this many ulp more on each side make it conservative.
        let margin = 4.0 * f64::EPSILON * bounds.min.abs().max(bounds.max.abs()).max_element();
        let bounds = bounds.inflated(margin);
        for axis in 0..3 {
            self.min[axis][slot] = bounds.min[axis];
            self.max[axis][slot] = bounds.max[axis];
        }
    }

    fn bounds(&self) -> Aabb {
        let corner = |columns: &[[f64; WIDTH]; 3], slot: usize| {
            glam::DVec3::new(columns[0][slot], columns[1][slot], columns[2][slot])
        };
        (0..self.count as usize)
            .map(|slot| Aabb { min: corner(&self.min, slot), max: corner(&self.max, slot) })
            .fold(Aabb::EMPTY, |all, one| all.union(&one))
    }

    /// For each child, the squared distance of a point to its box; infinite for an empty slot.
    #[inline(always)]
    fn distances_squared(&self, point: glam::DVec3) -> [f64; WIDTH] {
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
    fn packet_entry(&self, slot: usize, packet: &PacketColumns, rays: &[Ray; LANES]) -> (u32, f64) {
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
    fn entry_distances(&self, ray: &Ray, inverse: glam::DVec3) -> [f64; WIDTH] {
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
struct PacketColumns {
    origin: [[f64; LANES]; 3],
    /// 1 over the direction, finite, so that a ray in a face of a box yields no NaN.
    inverse: [[f64; LANES]; 3],
    t_min: [f64; LANES],
}

impl PacketColumns {
    #[inline(always)]
    fn new(rays: &[Ray; LANES]) -> Self {
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

/// Nodes and items to visit, each with t of the entry, the nearest on top.
type Stack = ArrayVec<(f64, i32), STACK_CAPACITY>;

/// Pushes the children that the ray hits, far ones first, by insertion sort: they are few.
#[inline(always)]
fn push_sorted(stack: &mut Stack, near: &[f64; WIDTH], children: &[i32]) {
    let first = stack.len();
    for (&near, &child) in near.iter().zip(children) {
        if near == f64::INFINITY {
            continue;
        }
        stack.push((near, child));
        let mut k = stack.len() - 1;
        while k > first && stack[k].0 > stack[k - 1].0 {
            stack.swap(k, k - 1);
            k -= 1;
        }
    }
}

fn union_of(boxes: &[Aabb], items: &[u32]) -> Aabb {
    items.iter().fold(Aabb::EMPTY, |all, &i| all.union(&boxes[i as usize]))
}

/// Divides items into up to eight groups. Each step splits the group with the greatest cost, which is its size times the area
/// of its box, or its size alone without `by_area`.
fn partition<'a>(boxes: &[Aabb], items: &'a mut [u32], by_area: bool) -> Vec<&'a mut [u32]> {
    let mut groups = vec![items];
    while groups.len() < WIDTH {
        let area = |group: &[u32]| if by_area { union_of(boxes, group).half_area() } else { 1.0 };
        let cost = |group: &&mut [u32]| area(group) * group.len() as f64;
        let splittable = (0..groups.len()).filter(|&g| groups[g].len() > 1);
        let Some(worst) = splittable.max_by(|&a, &b| cost(&groups[a]).total_cmp(&cost(&groups[b]))) else { break };
        let group = groups.swap_remove(worst);
        let middle = if by_area { split_by_area(boxes, group) } else { split_in_halves(boxes, group) };
        let (left, right) = group.split_at_mut(middle);
        groups.push(left);
        groups.push(right);
    }
    groups
}

/// Reorders the items into two groups by the binned surface area heuristic and returns the start of the second group. Splits
/// in halves where all centers coincide.
fn split_by_area(boxes: &[Aabb], items: &mut [u32]) -> usize {
    let center = |i: u32| boxes[i as usize].center();
    let extent = Aabb::around(items.iter().map(|&i| center(i)));
    let bin_of = |i: u32, axis: usize| {
        let x = (center(i)[axis] - extent.min[axis]) / extent.size()[axis];
        ((x * BINS as f64) as usize).min(BINS - 1)
    };
    let mut best: Option<(f64, usize, usize)> = None;
    for axis in (0..3).filter(|&axis| extent.size()[axis] > 0.0) {
        let mut bins = [(Aabb::EMPTY, 0usize); BINS];
        for &i in items.iter() {
            let bin = &mut bins[bin_of(i, axis)];
            *bin = (bin.0.union(&boxes[i as usize]), bin.1 + 1);
        }
        for boundary in 1..BINS {
            let sum = |bins: &[(Aabb, usize)]| {
                bins.iter().fold((Aabb::EMPTY, 0), |all, bin| (all.0.union(&bin.0), all.1 + bin.1))
            };
            let (left, right) = (sum(&bins[..boundary]), sum(&bins[boundary..]));
            if left.1 == 0 || right.1 == 0 {
                continue;
            }
            let cost = left.0.half_area() * left.1 as f64 + right.0.half_area() * right.1 as f64;
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, boundary));
            }
        }
    }
    let Some((_, axis, boundary)) = best else { return split_in_halves(boxes, items) };
    items.sort_by_key(|&i| (bin_of(i, axis), i));
    items.partition_point(|&i| bin_of(i, axis) < boundary)
}

/// Reorders the items along the widest axis of their centers and returns the middle index.
fn split_in_halves(boxes: &[Aabb], items: &mut [u32]) -> usize {
    let center = |i: u32| boxes[i as usize].center();
    let axis = Aabb::around(items.iter().map(|&i| center(i))).size().max_position();
    items.sort_by(|&a, &b| center(a)[axis].total_cmp(&center(b)[axis]).then(a.cmp(&b)));
    items.len() / 2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, Stream, warp};
    use glam::DVec3;

    fn random_boxes(count: u64, scale: f64, size: f64) -> Vec<Aabb> {
        (0..count)
            .map(|k| {
                let mut s = Sampler::new(3, Stream::Test, 9, k);
                let p = scale * DVec3::new(s.next_1d(), s.next_1d(), s.next_1d());
                let q = p + scale * size * DVec3::new(s.next_1d(), s.next_1d(), s.next_1d());
                Aabb { min: p, max: q }
            })
            .collect()
    }

    fn meets(bounds: &Aabb, ray: &Ray) -> bool {
        let (a, b) = ((bounds.min - ray.origin) / ray.direction, (bounds.max - ray.origin) / ray.direction);
        a.min(b).max_element().max(ray.t_min) <= a.max(b).min_element().min(ray.t_max)
    }

    #[test]
    fn finds_what_a_linear_scan_finds() {
        for (count, scale, size) in [(1, 1.0, 0.5), (7, 1e-6, 0.1), (9, 1e6, 0.1), (300, 1.0, 0.05), (2000, 1.0, 0.0)] {
            let boxes = random_boxes(count, scale, size);
            let bvh = Bvh::build(&boxes);
            for k in 0..200 {
                let mut s = Sampler::new(4, Stream::Test, count, k);
                let origin = scale * (3.0 * warp::uniform_sphere(s.next_2d()) + 0.5);
                let target = boxes[(s.next_1d() * count as f64) as usize].center();
                let ray = Ray::new(origin, target - origin);
                let mut seen = vec![false; boxes.len()];
                bvh.traverse(&mut ray.clone(), |item, _| {
                    seen[item as usize] = true;
                    true
                });
                for (i, bounds) in boxes.iter().enumerate() {
                    assert!(seen[i] || !meets(bounds, &ray), "box {i} of {count} was lost");
                }
            }
        }
    }

    #[test]
    fn equal_empty_and_no_boxes_build() {
        let count_visits = |boxes: &[Aabb]| {
            let mut visits = 0;
            Bvh::build(boxes).traverse(&mut Ray::new(DVec3::ZERO, DVec3::X), |_, _| {
                visits += 1;
                true
            });
            visits
        };
        let unit = Aabb { min: -DVec3::ONE, max: DVec3::ONE };
        assert_eq!(count_visits(&[]), 0);
        assert_eq!(count_visits(&vec![unit; 1000]), 1000);
        assert_eq!(count_visits(&[unit, Aabb::EMPTY, unit]), 2);
    }

    #[test]
    fn refit_follows_moved_boxes() {
        let mut boxes = random_boxes(500, 1.0, 0.02);
        let mut bvh = Bvh::build(&boxes);
        for bounds in &mut boxes {
            *bounds = Aabb { min: bounds.min + 10.0, max: bounds.max + 10.0 };
        }
        bvh.refit(&boxes);
        let all = union_of(&boxes, &(0..500).collect::<Vec<_>>());
        assert!(bvh.bounds().min.distance(all.min) < 1e-12 && bvh.bounds().max.distance(all.max) < 1e-12);
    }
}
