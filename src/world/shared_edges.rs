use crate::geometry::bezier::ControlNet;
use glam::DVec3;

/// The edges of a patch that are also edges of another patch of the same object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SharedEdges {
    /// Whether the edges at u = 0 and u = 1 are shared.
    pub u: [bool; 2],
    /// Whether the edges at v = 0 and v = 1 are shared.
    pub v: [bool; 2],
}

/// For each patch of an object, the edges that it shares with another patch, in either direction.
pub(super) fn shared_edges(nets: &[ControlNet]) -> Vec<SharedEdges> {
    let edges = |net: &ControlNet| {
        let p = &net.points;
        [
            [p[0][0], p[0][1], p[0][2], p[0][3]],
            [p[3][0], p[3][1], p[3][2], p[3][3]],
            p.map(|row| row[0]),
            p.map(|row| row[3]),
        ]
    };
    // An edge as bits that do not depend on its direction, so that equal edges can be counted by sorting.
    let key = |edge: &[DVec3; 4]| {
        let bits = |points: [DVec3; 4]| points.map(|p| p.to_array().map(|x| (x + 0.0).to_bits()));
        let [a, b, c, d] = *edge;
        bits([a, b, c, d]).min(bits([d, c, b, a]))
    };
    let mut keys: Vec<_> = nets.iter().flat_map(|net| edges(net).map(|edge| key(&edge))).collect();
    keys.sort_unstable();
    let is_shared = |edge: &[DVec3; 4]| {
        let key = key(edge);
        let first = keys.partition_point(|k| *k < key);
        keys.get(first + 1) == Some(&key)
    };
    let shared = |net: &ControlNet| {
        let [u0, u1, v0, v1] = edges(net).map(|edge| is_shared(&edge));
        SharedEdges { u: [u0, u1], v: [v0, v1] }
    };
    nets.iter().map(shared).collect()
}
