//! Tangent planes across seams (G1), kept while control points move.
//!
//! Across a seam with control points E_k, the neighbours A_k and B_k of a smooth surface lie on lines through E_k, with one ratio
//! r of the lengths `|B_k - E_k|` and `|A_k - E_k|` along the whole seam \[Farin02\]. A move of A by a and of E by e therefore moves B
//! by `(1 + r) e - r a`, which keeps both the line and the ratio; a move of E alone moves A and B by e, and a move of A and B alone
//! moves E by `(r a + b) / (1 + r)`. The neighbours of a smooth pole lie in its tangent plane, and move with the pole.

use super::connectivity::Connectivity;
use super::plane_fit::nearest_plane;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Least cosine of the angle between the legs of a smooth seam, 14 degrees: the renderer smooths over seams up to this angle.
const SMOOTH: f64 = 0.97;

/// A node of a seam with its neighbours on both sides.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    edge: usize,
    sides: [usize; 2],
    /// The length of the second leg over the first.
    ratio: f64,
}

impl Crossing {
    /// The crossing where the legs continue each other; `None` at a crease and at a pole.
    fn new([edge, a, b]: [usize; 3], positions: &[DVec3]) -> Option<Self> {
        let [first, second] = [a, b].map(|side| positions[side] - positions[edge]);
        let cosine = -first.try_normalize()?.dot(second.try_normalize()?);
        (cosine >= SMOOTH).then(|| Self { edge, sides: [a, b], ratio: second.length() / first.length() })
    }

    /// The opposite of a side, with the ratio of its leg to the leg of `side`.
    fn opposite(&self, side: usize) -> (usize, f64) {
        if side == self.sides[0] { (self.sides[1], self.ratio) } else { (self.sides[0], 1.0 / self.ratio) }
    }
}

/// The neighbours of each pole where they lie in one plane with it.
fn smooth_poles(mesh: &Connectivity, positions: &[DVec3]) -> BTreeMap<usize, BTreeSet<usize>> {
    let mut poles: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for (pole, neighbours) in mesh.poles() {
        poles.entry(pole).or_default().extend(neighbours);
    }
    poles.retain(|pole, neighbours| {
        let legs = neighbours.iter().filter_map(|node| (positions[*node] - positions[*pole]).try_normalize());
        let legs: Vec<DVec3> = legs.chain([DVec3::ZERO]).collect();
        let sine = (1.0 - SMOOTH * SMOOTH).sqrt();
        nearest_plane(&legs).is_some_and(|(_, normal)| legs.iter().all(|leg| leg.dot(normal).abs() <= sine))
    });
    poles
}

/// The move of a node; zero without a target.
fn shift(node: usize, positions: &[DVec3], targets: &[Option<DVec3>]) -> DVec3 {
    targets[node].map_or(DVec3::ZERO, |to| to - positions[node])
}

/// Moves the nodes of smooth seams whose neighbours on both sides have targets.
fn follow_both_sides(crossings: &[Crossing], positions: &[DVec3], targets: &mut [Option<DVec3>]) {
    let both: Vec<&Crossing> =
        crossings.iter().filter(|c| c.sides.iter().all(|side| targets[*side].is_some())).collect();
    for Crossing { edge, sides, ratio } in both {
        if targets[*edge].is_none() {
            let [a, b] = sides.map(|side| shift(side, positions, targets));
            targets[*edge] = Some(positions[*edge] + (*ratio * a + b) / (1.0 + ratio));
        }
    }
}

/// The smooth seams and poles around each node.
struct Smooth {
    of_edge: Vec<Vec<Crossing>>,
    of_side: Vec<Vec<Crossing>>,
    poles: BTreeMap<usize, BTreeSet<usize>>,
}

impl Smooth {
    fn new(mesh: &Connectivity, positions: &[DVec3], crossings: &[Crossing]) -> Self {
        let mut of_edge = vec![Vec::new(); positions.len()];
        let mut of_side = of_edge.clone();
        for crossing in crossings {
            of_edge[crossing.edge].push(*crossing);
            crossing.sides.into_iter().for_each(|side| of_side[side].push(*crossing));
        }
        Self { of_edge, of_side, poles: smooth_poles(mesh, positions) }
    }

    /// The nodes that move as `node` does, because it lies on their seam or is their pole.
    fn carried(&self, node: usize) -> Vec<usize> {
        let across = self.of_edge[node].iter().flat_map(|crossing| crossing.sides);
        across.chain(self.poles.get(&node).into_iter().flatten().copied()).collect()
    }

    /// The nodes opposite `node` across seams, with the moves that keep the tangents.
    fn turned(&self, node: usize, shift: impl Fn(usize) -> DVec3) -> Vec<(usize, DVec3)> {
        let turn = |crossing: &Crossing| {
            let (opposite, ratio) = crossing.opposite(node);
            (opposite, (1.0 + ratio) * shift(crossing.edge) - ratio * shift(node))
        };
        self.of_side[node].iter().map(turn).collect()
    }
}

/// Gives a target to each node that must move to keep the tangent planes at smooth seams and poles. Nodes that have a target keep
/// it.
pub(super) fn follow(mesh: &Connectivity, positions: &[DVec3], targets: &mut [Option<DVec3>]) {
    let crossings: Vec<Crossing> =
        mesh.crossings().flatten().filter_map(|nodes| Crossing::new(nodes, positions)).collect();
    follow_both_sides(&crossings, positions, targets);
    let smooth = Smooth::new(mesh, positions, &crossings);
    let mut carrying: VecDeque<usize> = (0..positions.len()).filter(|node| targets[*node].is_some()).collect();
    let mut turning = VecDeque::new();
    loop {
        // An opposite depends on the move of its seam, so it waits until no seam moves any more.
        let followers: Vec<(usize, DVec3)> = if let Some(node) = carrying.pop_front() {
            turning.push_back(node);
            let by = shift(node, positions, targets);
            smooth.carried(node).into_iter().map(|follower| (follower, by)).collect()
        } else if let Some(node) = turning.pop_front() {
            smooth.turned(node, |node| shift(node, positions, targets))
        } else {
            return;
        };
        for (follower, by) in followers {
            if targets[follower].is_none() {
                targets[follower] = Some(positions[follower] + by);
                carrying.push_back(follower);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::connectivity::tests::sheet;
    use super::*;
    use crate::app::document::selection::PointIndex;
    use crate::scene::Bezier;
    use std::sync::Arc;

    /// A smooth sheet of 2 x 2 patches; the second column is twice as wide.
    fn smooth() -> Bezier {
        let mut bezier = sheet(2, 2, |x, z| 0.1 * x + 0.05 * z);
        for net in Arc::make_mut(&mut bezier.patches) {
            *net =
                net.map(|p| if p.x > 3.0 { DVec3::new(2.0 * p.x - 3.0, 0.2 * p.x - 0.3 + 0.05 * p.z, p.z) } else { p });
        }
        bezier
    }

    /// The sheet after a move of control points, and the greatest sine of the angle between normals along its seams.
    fn moved(points: &[(usize, usize, usize)], by: DVec3) -> (Vec<DVec3>, Vec<DVec3>, f64) {
        let mut bezier = smooth();
        let mesh = Connectivity::of(&bezier);
        let before = mesh.positions(&bezier);
        let mut targets = vec![None; before.len()];
        for (patch, i, j) in points {
            let node = mesh.node(PointIndex { patch: *patch, i: *i, j: *j });
            targets[node] = Some(before[node] + by);
        }
        follow(&mesh, &before, &mut targets);
        let after: Vec<DVec3> = targets.iter().zip(&before).map(|(to, at)| to.unwrap_or(*at)).collect();
        for (node, points) in mesh.nodes().iter().enumerate() {
            for point in points {
                Arc::make_mut(&mut bezier.patches)[point.patch].points[point.i][point.j] = after[node];
            }
        }
        let normal = |patch: usize, u: f64, v: f64| {
            let d = bezier.patches[patch].derivatives(u, v);
            d.dpdu.cross(d.dpdv).normalize()
        };
        let kink = |t: f64| {
            let across_x = [0, 2].map(|row| normal(row, 1.0, t).cross(normal(row + 1, 0.0, t)).length());
            let across_z = [0, 1].map(|column| normal(column, t, 1.0).cross(normal(column + 2, t, 0.0)).length());
            across_x.into_iter().chain(across_z).fold(0.0, f64::max)
        };
        (before, after, (0..=16).map(|k| kink(f64::from(k) / 16.0)).fold(0.0, f64::max))
    }

    // Normals of patches of size 3 after some twenty roundings.
    const TOLERANCE: f64 = 1e-14;

    #[test]
    fn every_move_keeps_the_normals_along_all_seams() {
        let by = DVec3::new(0.2, 0.7, -0.3);
        let inner = [(0, 1, 1), (0, 2, 1), (0, 2, 2), (1, 1, 2)];
        let on_seams = [(0, 3, 1), (0, 3, 2), (0, 3, 3), (0, 1, 3), (1, 1, 3), (1, 0, 0)];
        for point in inner.into_iter().chain(on_seams) {
            let (before, after, kink) = moved(&[point], by);
            assert_ne!(before, after);
            assert!(kink < TOLERANCE, "{kink} after a move of {point:?}");
        }
        for points in [vec![(0, 3, 3), (0, 2, 2)], vec![(0, 2, 2), (0, 3, 3), (0, 3, 2)], vec![(0, 2, 3), (1, 1, 3)]] {
            let (_, _, kink) = moved(&points, by);
            assert!(kink < TOLERANCE, "{kink} after a move of {points:?}");
        }
    }

    #[test]
    fn an_opposite_keeps_the_ratio_of_the_legs() {
        let (before, after, _) = moved(&[(0, 2, 1)], DVec3::Y);
        let moved: Vec<DVec3> =
            before.iter().zip(&after).map(|(a, b)| *b - *a).filter(|by| *by != DVec3::ZERO).collect();
        assert_eq!(moved.len(), 2, "{moved:?}");
        assert!(moved.iter().any(|by| by.distance(-2.0 * DVec3::Y) < TOLERANCE), "{moved:?}");
    }

    #[test]
    fn the_neighbours_of_a_smooth_pole_move_with_it() {
        for (slope, followers) in [(0.0, 1 + 7), (1.0, 1)] {
            // Two sectors around the origin, flat or a cone.
            let mut bezier = sheet(2, 1, |_, _| 0.0);
            for net in Arc::make_mut(&mut bezier.patches) {
                *net = net.map(|p| {
                    let (sin, cos) = (0.4 * p.x).sin_cos();
                    DVec3::new(p.z * cos, slope * p.z, p.z * sin)
                });
            }
            let mesh = Connectivity::of(&bezier);
            let positions = mesh.positions(&bezier);
            let mut targets = vec![None; positions.len()];
            targets[mesh.node(PointIndex::default())] = Some(DVec3::Y);
            follow(&mesh, &positions, &mut targets);
            assert_eq!(targets.iter().flatten().count(), followers, "at slope {slope}");
        }
    }

    #[test]
    fn creases_and_far_points_stay() {
        let bezier = sheet(2, 1, |x, _| (x - 3.0).abs());
        let mesh = Connectivity::of(&bezier);
        let positions = mesh.positions(&bezier);
        let mut targets = vec![None; positions.len()];
        targets[mesh.node(PointIndex { patch: 0, i: 2, j: 1 })] = Some(DVec3::Y);
        follow(&mesh, &positions, &mut targets);
        assert_eq!(targets.iter().flatten().count(), 1, "a crease has no common tangent plane");
        let (before, after, _) = moved(&[(0, 0, 1)], DVec3::Y);
        assert_eq!(before.iter().zip(&after).filter(|(a, b)| a != b).count(), 1, "a point of the border moves alone");
    }
}
