//! How the patches of an object hang together.

use crate::app::document::handles::{control_points, weld_groups};
use crate::app::document::selection::PointIndex;
use crate::scene::Bezier;
use glam::DVec3;
use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

/// A side of a patch: 0 is u = 0, 1 is u = 1, 2 is v = 0, 3 is v = 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Side {
    pub(super) patch: usize,
    pub(super) side: usize,
}

impl Side {
    /// The four sides of a patch.
    pub(super) fn of(patch: usize) -> [Self; 4] {
        [0, 1, 2, 3].map(|side| Self { patch, side })
    }

    /// The control point number `k` along the side, in the row that is `depth` rows inside the patch.
    pub(super) fn point(self, k: usize, depth: usize) -> PointIndex {
        let (i, j) = [(depth, k), (3 - depth, k), (k, depth), (k, 3 - depth)][self.side];
        PointIndex { patch: self.patch, i, j }
    }
}

/// Four nodes along an edge, with the smaller end first.
type EdgeKey = [usize; 4];

/// The control points of an object as a mesh. A node is a position with all control points there; an edge is a curve of four
/// nodes with all sides of patches along it.
#[derive(Debug)]
pub(super) struct Connectivity {
    /// The control points of each node.
    nodes: Vec<BTreeSet<PointIndex>>,
    /// The node of each control point, 16 a patch.
    node_of: Vec<usize>,
    /// Made at the first use: a drag without tangents needs no edges.
    edges: OnceCell<BTreeMap<EdgeKey, Vec<Side>>>,
}

impl Connectivity {
    /// The connectivity of an object's patches.
    pub(super) fn of(bezier: &Bezier) -> Self {
        let nodes = weld_groups(bezier);
        let mut node_of = vec![0; 16 * bezier.patches.len()];
        for (node, points) in nodes.iter().enumerate() {
            points.iter().for_each(|point| node_of[point.place()] = node);
        }
        Self { nodes, node_of, edges: OnceCell::new() }
    }

    fn edges(&self) -> &BTreeMap<EdgeKey, Vec<Side>> {
        self.edges.get_or_init(|| {
            let mut edges: BTreeMap<EdgeKey, Vec<Side>> = BTreeMap::new();
            for side in (0..self.node_of.len() / 16).flat_map(Side::of) {
                edges.entry(self.key(side).0).or_default().push(side);
            }
            edges
        })
    }

    /// The control points of each node.
    pub(super) fn nodes(&self) -> &[BTreeSet<PointIndex>] {
        &self.nodes
    }

    /// The position of each node.
    pub(super) fn positions(&self, bezier: &Bezier) -> Vec<DVec3> {
        let mut positions = vec![DVec3::ZERO; self.nodes.len()];
        control_points(bezier).for_each(|(point, at)| positions[self.node(point)] = at);
        positions
    }

    /// The node of a control point.
    pub(super) fn node(&self, point: PointIndex) -> usize {
        self.node_of[point.place()]
    }

    /// All sides along the edge of `side`, itself included. A side that is collapsed to a point is alone: the patches around a
    /// pole do not continue each other there.
    pub(super) fn along(&self, side: Side) -> Vec<Side> {
        let (key, _) = self.key(side);
        if is_point(key) { vec![side] } else { self.edges().get(&key).cloned().unwrap_or_default() }
    }

    /// The edges with one side: the border of the surface.
    pub(super) fn borders(&self) -> impl Iterator<Item = Side> + '_ {
        let alone = self.edges().iter().filter(|(key, sides)| sides.len() == 1 && !is_point(**key));
        alone.map(|(_, sides)| sides[0])
    }

    /// The edges where two sides meet, with the control points of both sides: for each of the four nodes of the edge, the edge's
    /// node and its neighbours on both sides.
    pub(super) fn crossings(&self) -> impl Iterator<Item = [[usize; 3]; 4]> + '_ {
        let seams = self.edges().iter().filter(|(key, sides)| sides.len() == 2 && !is_point(**key));
        seams.map(|(_, sides)| {
            let (a, b) = (sides[0], sides[1]);
            let opposite = self.key(a).1 != self.key(b).1;
            [0, 1, 2, 3].map(|k| {
                let at_b = if opposite { 3 - k } else { k };
                [self.node(a.point(k, 0)), self.node(a.point(k, 1)), self.node(b.point(at_b, 1))]
            })
        })
    }

    /// The sides that are collapsed to a point: its node, and the four nodes beside it inside the patch.
    pub(super) fn poles(&self) -> impl Iterator<Item = (usize, [usize; 4])> + '_ {
        let sides = self.edges().iter().filter(|(key, _)| is_point(**key)).flat_map(|(_, sides)| sides);
        sides.map(|side| (self.node(side.point(0, 0)), [0, 1, 2, 3].map(|k| self.node(side.point(k, 1)))))
    }

    /// The nodes next to each node along rows and columns.
    pub(super) fn neighbours(&self) -> Vec<BTreeSet<usize>> {
        let mut neighbours = vec![BTreeSet::new(); self.nodes.len()];
        for point in self.nodes.iter().flatten() {
            let next = [(point.i + 1, point.j), (point.i, point.j + 1)];
            for (i, j) in next.into_iter().filter(|(i, j)| *i < 4 && *j < 4) {
                let (a, b) = (self.node(*point), self.node(PointIndex { i, j, ..*point }));
                if a != b {
                    neighbours[a].insert(b);
                    neighbours[b].insert(a);
                }
            }
        }
        neighbours
    }

    /// The nodes along a side with the smaller end first, and whether that is against the side's direction.
    fn key(&self, side: Side) -> (EdgeKey, bool) {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| self.node(side.point(k, 0)));
        if [a, b] <= [d, c] { ([a, b, c, d], false) } else { ([d, c, b, a], true) }
    }
}

fn is_point(edge: EdgeKey) -> bool {
    edge.iter().all(|node| *node == edge[0])
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::geometry::bezier::ControlNet;
    use crate::scene::Transform;
    use std::array::from_fn;
    use std::sync::Arc;

    /// A sheet of `columns` patches along x and `rows` patches along z, each of size 3; `height` gives y.
    pub(in crate::app::document::surface) fn sheet(
        columns: usize,
        rows: usize,
        height: impl Fn(f64, f64) -> f64,
    ) -> Bezier {
        let point = |x: usize, z: usize| DVec3::new(x as f64, height(x as f64, z as f64), z as f64);
        let net = |k: usize| {
            let (column, row) = (k % columns, k / columns);
            ControlNet { points: from_fn(|i| from_fn(|j| point(3 * column + i, 3 * row + j))) }
        };
        let patches = Arc::new((0..columns * rows).map(net).collect());
        Bezier { transform: Transform::default(), patches, file: None, uv: None }
    }

    #[test]
    fn a_sheet_has_one_node_a_position_and_seams_between_its_patches() {
        let mesh = Connectivity::of(&sheet(2, 2, |_, _| 0.0));
        assert_eq!((mesh.nodes().len(), mesh.crossings().count(), mesh.borders().count()), (49, 4, 8));
        let middle = mesh.node(PointIndex { patch: 0, i: 3, j: 3 });
        assert_eq!(mesh.nodes()[middle].len(), 4, "four patches meet in the middle");
        assert_eq!(mesh.neighbours()[middle].len(), 4);
    }

    #[test]
    fn the_sides_of_a_crossing_lie_opposite_each_other_in_any_direction_of_the_patches() {
        let mut bezier = sheet(2, 1, |_, _| 0.0);
        let turned = |net: &ControlNet| ControlNet { points: from_fn(|i| from_fn(|j| net.points[j][3 - i])) };
        for _ in 0..4 {
            let net = turned(&bezier.patches[1]);
            Arc::make_mut(&mut bezier.patches)[1] = net;
            let mesh = Connectivity::of(&bezier);
            let at = mesh.positions(&bezier);
            let seam = mesh.crossings().next().unwrap();
            for [edge, a, b] in seam {
                assert_eq!(at[a] + at[b], 2.0 * at[edge]);
                assert_eq!(at[edge].x, 3.0);
            }
        }
    }

    #[test]
    fn an_edge_that_is_a_point_is_no_seam() {
        let mut bezier = sheet(2, 1, |_, _| 0.0);
        for patch in Arc::make_mut(&mut bezier.patches) {
            (0..4).for_each(|i| patch.points[i][0] = DVec3::ZERO);
        }
        let mesh = Connectivity::of(&bezier);
        assert_eq!(mesh.along(Side { patch: 0, side: 2 }).len(), 1);
        assert_eq!(mesh.crossings().count(), 1, "the edge between the patches");
        let pole = mesh.node(PointIndex { patch: 0, i: 2, j: 0 });
        let beside: Vec<_> = mesh.poles().collect();
        assert!(beside.len() == 2 && beside.iter().all(|(node, _)| *node == pole), "{beside:?}");
    }
}
