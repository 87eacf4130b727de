//! A patch cut into nearly flat parts, and the tree of boxes over them.

use super::bending::{SHAPELESS, bending};
use super::newton::Domain;
use super::node::Node;
use super::packet::Packet;
use super::paraboloid::Paraboloid;
use super::row_net::RowNet;
use crate::math::lanes::LANES;
use arrayvec::ArrayVec;
use glam::DVec3;
use std::collections::BinaryHeap;

/// Limit of the number of parts, for the sake of memory, of which a patch shall not take more than 64 KiB, and of build
/// time.
const MAX_PARTS: usize = 256;

/// Halvings after which a part that does not get flatter (a cusp, a collapsed edge) is left to subdivision.
const MAX_DEPTH: usize = 12;

/// The parts of one patch under a tree of boxes with eight children each. Everything in unit space.
#[derive(Clone, Debug, Default)]
pub(super) struct PartTree {
    nodes: Vec<Node>,
    packets: Vec<Packet>,
}

/// Reference to a node or to a leaf of up to eight parts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Link(u32);

const PACKET_BIT: u32 = 1 << 31;

/// What a [`Link`] leads to.
pub(super) enum Target<'a> {
    Node(&'a Node),
    Packet(&'a Packet),
}

/// A part while the tree is built.
struct Piece {
    net: RowNet,
    domain: Domain,
    depth: usize,
    /// See [`bending`].
    bending: [f64; 2],
    halves: Option<[usize; 2]>,
    /// Of how many parts it is made.
    parts: usize,
}

impl PartTree {
    /// Cuts a patch, given in unit space.
    pub(super) fn new(net: &RowNet) -> Self {
        let pieces = cut(net);
        let mut tree = Self::default();
        tree.link(&pieces, 0);
        tree.nodes.shrink_to_fit();
        tree.packets.shrink_to_fit();
        tree
    }

    /// The top of the tree.
    pub(super) fn root(&self) -> Link {
        if self.nodes.is_empty() { Link(PACKET_BIT) } else { Link((self.nodes.len() - 1) as u32) }
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
                match node.child(slot) {
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
        if pieces[root].parts <= LANES {
            let mut parts = ArrayVec::new();
            collect_parts(pieces, root, &mut parts);
            self.packets.push(Packet::new(&parts));
            return Link(PACKET_BIT | (self.packets.len() - 1) as u32);
        }
        let children = children_of(pieces, root);
        let boxes: ArrayVec<_, LANES> = children.iter().map(|&k| pieces[k].net.bounds()).collect();
        let links: ArrayVec<_, LANES> = children.iter().map(|&k| self.link(pieces, k)).collect();
        self.nodes.push(Node::new(&boxes, &links));
        Link((self.nodes.len() - 1) as u32)
    }
}

/// Halves the part that needs it most, again and again. The first piece is the patch.
fn cut(net: &RowNet) -> Vec<Piece> {
    let mut pieces = Vec::with_capacity(2 * MAX_PARTS);
    pieces.push(Piece::new(*net, Domain::WHOLE, 0));
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
    // Halves come after what they are halves of.
    for k in (0..pieces.len()).rev() {
        if let Some(halves) = pieces[k].halves {
            pieces[k].parts = halves.into_iter().map(|half| pieces[half].parts).sum();
        }
    }
    pieces
}

impl Piece {
    fn new(net: RowNet, domain: Domain, depth: usize) -> Self {
        Self { net, domain, depth, bending: bending(&net), halves: None, parts: 1 }
    }

    /// How much halving would help, as a sortable number; none for a part that may stay whole.
    fn need(&self) -> Option<u64> {
        let bending = self.bending[0].max(self.bending[1]);
        let open = bending > 1.0 && self.depth < MAX_DEPTH;
        // The bits of positive floating-point numbers sort as the numbers do.
        open.then(|| (bending.min(SHAPELESS) * self.net.bounds().diagonal()).to_bits())
    }

    /// Two halves, along the axis along which it bends more.
    fn cut(&self) -> [Self; 2] {
        let (nets, domains) = if self.bending[0] >= self.bending[1] {
            (self.net.split_u(), self.domain.halves_x())
        } else {
            (self.net.split_v(), self.domain.halves_y())
        };
        [0, 1].map(|k| Self::new(nets[k], domains[k], self.depth + 1))
    }
}

/// Adds the paraboloids of the parts at or below a piece.
fn collect_parts(pieces: &[Piece], root: usize, parts: &mut ArrayVec<Paraboloid, LANES>) {
    match pieces[root].halves {
        Some(halves) => halves.into_iter().for_each(|half| collect_parts(pieces, half, parts)),
        None => parts.push(Paraboloid::new(&pieces[root].net, pieces[root].domain)),
    }
}

/// Up to eight pieces that make up a piece with more parts than a leaf holds: again and again the one with the most
/// parts gives way to its halves, until none has more than a leaf holds.
fn children_of(pieces: &[Piece], root: usize) -> ArrayVec<usize, LANES> {
    let mut children = ArrayVec::from_iter([root]);
    while children.len() < LANES {
        let parts = |place: &usize| pieces[children[*place]].parts;
        let Some(largest) = (0..children.len()).max_by_key(parts).filter(|place| parts(place) > LANES) else { break };
        let halves = pieces[children.swap_remove(largest)].halves;
        children.extend(halves.into_iter().flatten());
    }
    children
}
