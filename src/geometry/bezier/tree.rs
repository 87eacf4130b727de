//! A patch cut into nearly flat parts, and the tree of boxes over them.

use super::ControlNet;
use super::newton::Domain;
use super::packet::{Packet, PacketRay};
use super::paraboloid::{MARGIN, Paraboloid, ROUNDING};
use crate::math::Aabb;
use crate::math::float::{round_down, round_up};
use glam::DVec3;
use std::array::from_fn;
use std::collections::BinaryHeap;
use wide::f32x4;

/// Parts with [`turns`] below this stay whole: nearly every ray is then decided by the paraboloids and three Newton
/// steps.
const FLAT_ENOUGH: f64 = 0.08;

/// Limit of the number of parts, for the sake of memory and of build time: 64 KiB hold no more.
const MAX_PARTS: usize = 256;

/// Halvings after which a part that does not get flatter (a cusp, a collapsed edge) is left to subdivision.
const MAX_DEPTH: usize = 12;

/// The parts of one patch under a tree of boxes with four children each. Everything in unit space.
#[derive(Clone, Debug, Default)]
pub(super) struct PartTree {
    nodes: Vec<Node>,
    packets: Vec<Packet>,
}

/// Reference to a node or to a leaf of four parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Link(u32);

const PACKET_BIT: u32 = 1 << 31;

/// What a [`Link`] leads to.
pub(super) enum Target<'a> {
    Node(&'a Node),
    Packet(&'a Packet),
}

/// Four boxes and what is in them.
#[derive(Clone, Debug)]
pub(super) struct Node {
    low: [f32x4; 3],
    high: [f32x4; 3],
    children: [Link; 4],
}

/// A part while the tree is built.
struct Piece {
    net: ControlNet,
    domain: Domain,
    depth: usize,
    /// See [`turns`].
    turns: [f64; 2],
    halves: Option<[usize; 2]>,
}

impl PartTree {
    /// Cuts a patch, given in unit space.
    pub(super) fn new(net: &ControlNet) -> Self {
        let pieces = cut(net);
        let mut tree = Self::default();
        tree.link(&pieces, 0);
        tree.nodes.shrink_to_fit();
        tree.packets.shrink_to_fit();
        tree
    }

    /// The top of the tree.
    pub(super) fn root(&self) -> Link {
        if self.nodes.is_empty() { Link(PACKET_BIT) } else { Link(0) }
    }

    /// Follows a link.
    #[inline(always)]
    pub(super) fn follow(&self, link: Link) -> Target<'_> {
        if link.0 & PACKET_BIT != 0 {
            Target::Packet(&self.packets[(link.0 & !PACKET_BIT) as usize])
        } else {
            Target::Node(&self.nodes[link.0 as usize])
        }
    }

    /// How far a point is from the boxes around the parts, or `limit` if that is less; 0 where there is one box only.
    pub(super) fn distance(&self, point: DVec3, limit: f64) -> f64 {
        let mut nearest = if self.nodes.is_empty() { 0.0 } else { limit };
        let mut open = vec![self.root()];
        while let Some(link) = open.pop() {
            let Target::Node(node) = self.follow(link) else { continue };
            for (slot, distance) in node.distances(point).into_iter().enumerate() {
                match node.children[slot] {
                    Link(child) if child & PACKET_BIT != 0 => nearest = nearest.min(distance),
                    link if distance < nearest => open.push(link),
                    _ => {}
                }
            }
        }
        nearest
    }

    /// Memory on the heap.
    pub(super) fn heap_bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>() + self.packets.capacity() * size_of::<Packet>()
    }

    /// Adds the tree below a piece.
    fn link(&mut self, pieces: &[Piece], root: usize) -> Link {
        let below = parts_below(pieces, root);
        if below.len() <= 4 {
            self.packets.push(Packet::new(&below.iter().map(|&k| pieces[k].paraboloid()).collect::<Vec<_>>()));
            return Link(PACKET_BIT | (self.packets.len() - 1) as u32);
        }
        let index = self.nodes.len();
        let children = four_below(pieces, root);
        self.nodes.push(Node::new(&children.iter().map(|&k| pieces[k].net.bounds()).collect::<Vec<_>>()));
        for (place, &child) in children.iter().enumerate() {
            let link = self.link(pieces, child);
            self.nodes[index].children[place] = link;
        }
        Link(index as u32)
    }
}

/// Halves the part that needs it most, again and again. The first piece is the patch.
fn cut(net: &ControlNet) -> Vec<Piece> {
    let mut pieces = vec![Piece::new(*net, Domain::WHOLE, 0)];
    let mut open = BinaryHeap::from_iter(pieces[0].need().map(|need| (need, 0)));
    for _ in 1..MAX_PARTS {
        let Some((_, k)) = open.pop() else {
            break;
        };
        pieces[k].halves = Some([pieces.len(), pieces.len() + 1]);
        for half in pieces[k].cut() {
            open.extend(half.need().map(|need| (need, pieces.len())));
            pieces.push(half);
        }
    }
    pieces
}

impl Piece {
    fn new(net: ControlNet, domain: Domain, depth: usize) -> Self {
        Self { net, domain, depth, turns: turns(&net), halves: None }
    }

    /// How much halving would help, as a sortable number; none for a part that may stay whole.
    fn need(&self) -> Option<u64> {
        let turn = self.turns[0].max(self.turns[1]);
        let open = turn > FLAT_ENOUGH && self.depth < MAX_DEPTH;
        // The bits of positive floating-point numbers sort as the numbers do.
        open.then(|| (turn.min(1.0) * self.net.bounds().diagonal()).to_bits())
    }

    /// Two halves, along the axis along which the tangents turn more.
    fn cut(&self) -> [Self; 2] {
        let (nets, domains) = if self.turns[0] >= self.turns[1] {
            (self.net.split_u(), self.domain.halves_x())
        } else {
            (self.net.split_v(), self.domain.halves_y())
        };
        [0, 1].map(|k| Self::new(nets[k], domains[k], self.depth + 1))
    }

    fn paraboloid(&self) -> Paraboloid {
        let ends = (0.5 - 0.5 * MARGIN, 0.5 + 0.5 * MARGIN);
        Paraboloid::new(&self.net.restricted(ends, ends), self.domain)
    }
}

/// How much the partial derivatives change along u, and along v, relative to their length: about a third of the angle
/// by which a tangent turns.
fn turns(net: &ControlNet) -> [f64; 2] {
    let p = &net.points;
    let (mut du, mut dv, mut duu, mut duv, mut dvv) = (0f64, 0f64, 0f64, 0f64, 0f64);
    for i in 0..3 {
        for j in 0..4 {
            du = du.max(p[i + 1][j].distance_squared(p[i][j]));
            dv = dv.max(p[j][i + 1].distance_squared(p[j][i]));
            if i < 2 {
                duu = duu.max((p[i + 2][j] - 2.0 * p[i + 1][j] + p[i][j]).length_squared());
                dvv = dvv.max((p[j][i + 2] - 2.0 * p[j][i + 1] + p[j][i]).length_squared());
            }
            if j < 3 {
                duv = duv.max((p[i + 1][j + 1] - p[i + 1][j] - p[i][j + 1] + p[i][j]).length_squared());
            }
        }
    }
    let ratio = |change: f64, length: f64| if change > 0.0 { (change / length).sqrt() } else { 0.0 };
    [ratio(duu, du).max(ratio(duv, dv)), ratio(dvv, dv).max(ratio(duv, du))]
}

/// The parts at or below a piece.
fn parts_below(pieces: &[Piece], root: usize) -> Vec<usize> {
    match pieces[root].halves {
        Some(halves) => halves.into_iter().flat_map(|k| parts_below(pieces, k)).collect(),
        None => vec![root],
    }
}

/// Up to four pieces that make up a piece: its halves, and their halves.
fn four_below(pieces: &[Piece], root: usize) -> Vec<usize> {
    let halves = |k: usize| pieces[k].halves.map_or(vec![k], Vec::from);
    halves(root).into_iter().flat_map(halves).collect()
}

impl Node {
    /// Boxes rounded outward to `f32`, and larger by what rounding may move a ray. Missing children get boxes at
    /// infinity.
    fn new(boxes: &[Aabb]) -> Self {
        let corner =
            |f: &dyn Fn(&Aabb) -> f32, empty: f32| f32x4::from(from_fn::<f32, 4, _>(|k| boxes.get(k).map_or(empty, f)));
        Self {
            low: [0, 1, 2].map(|axis| corner(&|b| round_down(b.min[axis] - ROUNDING), f32::INFINITY)),
            high: [0, 1, 2].map(|axis| corner(&|b| round_up(b.max[axis] + ROUNDING), f32::INFINITY)),
            children: [Link(0); 4],
        }
    }

    /// Which boxes the ray meets (bit k for child k), and where it enters them.
    #[inline(always)]
    pub(super) fn test(&self, ray: &PacketRay) -> (u32, [f32; 4]) {
        let mut near = ray.z_min;
        let mut far = ray.z_max;
        for axis in 0..3 {
            let low = (self.low[axis] - ray.origin[axis]) * ray.inverse[axis];
            let high = (self.high[axis] - ray.origin[axis]) * ray.inverse[axis];
            near = near.fast_max(low.fast_min(high));
            far = far.fast_min(low.fast_max(high));
        }
        (near.simd_le(far).to_bitmask(), near.to_array())
    }

    /// How far a point is from each box; infinite where there is none.
    fn distances(&self, point: DVec3) -> [f64; 4] {
        let outside = |axis: usize| {
            let x = f32x4::splat(point[axis] as f32);
            (self.low[axis] - x).max(x - self.high[axis]).max(f32x4::ZERO)
        };
        let [x, y, z] = [0, 1, 2].map(outside);
        (x * x + y * y + z * z).sqrt().to_array().map(f64::from)
    }

    /// Child k.
    #[inline(always)]
    pub(super) fn child(&self, k: usize) -> Link {
        self.children[k]
    }
}
