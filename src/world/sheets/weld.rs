use super::edge::{Edge, SIDES};
use super::seam::Seam;
use super::union_find::UnionFind;
use crate::geometry::bezier::ControlNet;
use glam::DVec3;

/// Control points of a net.
const POINTS: usize = 16;

/// Moves the control points of edges that nearly meet to their means, so that the surfaces meet exactly: no ray slips between them.
/// Points that are equal already keep their bits.
pub(super) fn weld(nets: &mut [ControlNet], edges: &[Edge], seams: &[Seam]) {
    let is_welded = |seam: &&Seam| {
        let [a, b] = seam.edges.map(|k| &edges[k]);
        seam.gap <= a.weld_tolerance().min(b.weld_tolerance()) && !a.is_point() && !b.is_point()
    };
    if seams.iter().filter(is_welded).all(|seam| seam.gap == 0.0) {
        return;
    }
    let mut same = UnionFind::new(POINTS * nets.len());
    let point = |edge: &Edge, k: usize| POINTS * edge.patch + SIDES[edge.side][k];
    for seam in seams.iter().filter(is_welded) {
        let [a, b] = seam.edges.map(|k| &edges[k]);
        (0..4).for_each(|k| same.unite(point(a, k), point(b, if seam.reversed { 3 - k } else { k })));
    }
    // An edge that is exactly a point stays one.
    for edge in edges.iter().filter(|edge| edge.points == [edge.points[0]; 4]) {
        (1..4).for_each(|k| same.unite(point(edge, 0), point(edge, k)));
    }
    move_to_means(nets, &mut same);
}

/// Moves the control points of each set to their mean.
fn move_to_means(nets: &mut [ControlNet], same: &mut UnionFind) {
    let at = |nets: &[ControlNet], k: usize| nets[k / POINTS].points[k % POINTS / 4][k % 4];
    // The offsets from the first point of the set, so that a surface far from the origin loses no digits.
    let mut sums = vec![(DVec3::ZERO, 0u32); POINTS * nets.len()];
    for k in 0..sums.len() {
        let first = same.least(k);
        let sum = &mut sums[first];
        *sum = (sum.0 + (at(nets, k) - at(nets, first)), sum.1 + 1);
    }
    let is_apart = |k: usize, first: usize| at(nets, k) != at(nets, first);
    let mut moves = vec![false; sums.len()];
    for k in 0..sums.len() {
        let first = same.least(k);
        moves[first] |= is_apart(k, first);
    }
    let firsts: Vec<DVec3> = (0..sums.len()).map(|k| at(nets, same.least(k))).collect();
    for (k, first_point) in firsts.into_iter().enumerate() {
        let first = same.least(k);
        if moves[first] {
            let (sum, count) = sums[first];
            nets[k / POINTS].points[k % POINTS / 4][k % 4] = first_point + sum / f64::from(count);
        }
    }
}
