//! A bounding volume hierarchy with eight children per node \[DHK08\], built by the surface area heuristic \[Wald07\],
//! over items with boxes.
//!
//! | file | holds |
//! |---|---|
//! | `node` | `Node`: the boxes of eight children, and the intersection of rays with them |
//! | `partition` | dividing items into eight groups |

mod node;
mod partition;

use crate::math::lanes::LANES;
use crate::math::{Aabb, Ray};
use arrayvec::ArrayVec;
use node::{Node, PacketColumns, WIDTH};
use partition::{partition, union_of};

/// Levels built by the surface area heuristic. Nodes below split in halves, which bounds the depth of the tree.
const HEURISTIC_LEVELS: usize = 12;
/// Each level leaves at most 7 entries on the stack; halving 2^31 items by eights takes 11 levels more.
const STACK_CAPACITY: usize = 8 + 7 * (HEURISTIC_LEVELS + 11);

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

/// Nodes and items to visit, each with t of the entry, the nearest on top.
type Stack = ArrayVec<(f64, i32), STACK_CAPACITY>;

/// Pushes the children that the ray hits, far children first, by insertion sort, because the children are few.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Sampler, Stream, warp};
    use glam::DVec3;

    fn random_boxes(count: u64, scale: f64, size: f64) -> Vec<Aabb> {
        (0..count)
            .map(|k| {
                let mut s = Sampler::new(3, Stream::Camera, 9, k);
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
    fn finds_the_hits_of_a_linear_scan() {
        for (count, scale, size) in [(1, 1.0, 0.5), (7, 1e-6, 0.1), (9, 1e6, 0.1), (300, 1.0, 0.05), (2000, 1.0, 0.0)] {
            let boxes = random_boxes(count, scale, size);
            let bvh = Bvh::build(&boxes);
            for k in 0..200 {
                let mut s = Sampler::new(4, Stream::Camera, count, k);
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
