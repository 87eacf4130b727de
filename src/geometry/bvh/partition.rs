//! Dividing items into groups by the surface area heuristic in bins: \[Wald07\] I. Wald, On Fast Construction of SAH-based
//! Bounding Volume Hierarchies, IEEE Symposium on Interactive Ray Tracing 2007.

use super::node::WIDTH;
use crate::math::Aabb;

/// Bins of the surface area heuristic. More than 16 hardly improve trees of a few thousand boxes.
const BINS: usize = 16;

/// The box around the boxes of items.
pub(super) fn union_of(boxes: &[Aabb], items: &[u32]) -> Aabb {
    items.iter().fold(Aabb::EMPTY, |all, &i| all.union(&boxes[i as usize]))
}

/// Divides items into up to eight groups. Each step splits the group with the greatest cost, which is its size times the area
/// of its box, or its size alone without `by_area`.
pub(super) fn partition<'a>(boxes: &[Aabb], items: &'a mut [u32], by_area: bool) -> Vec<&'a mut [u32]> {
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

/// Reorders the items into two groups by the binned surface area heuristic \[Wald07\] and returns the start of the second group. Splits
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
