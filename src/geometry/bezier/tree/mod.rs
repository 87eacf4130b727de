//! A patch cut into subpatches that are nearly paraboloids, and a tree of boxes over them: a BVH over subpatches, as in
//! \[MCFS00\] and \[GeimerAbert05\], with eight children per node.
//!
//! | file | holds |
//! |---|---|
//! | `bending` | the criterion by which a subpatch is cut again |
//! | `paraboloid` | `Paraboloid`: a subpatch by a quadratic height field, with bounds of the error |
//! | `subpatch8` | `Subpatch8`, a leaf: eight paraboloids, and the intersection of rays with them |
//! | `node` | `Node`: eight boxes, and the intersection of rays with them |

mod bending;
mod node;
mod paraboloid;
mod subpatch8;

pub(crate) use node::{Node, NodeRef};
pub(crate) use paraboloid::MARGIN;
pub(crate) use subpatch8::{Branch, Candidates, Subpatch8};

use super::unit::{Domain, SoaNet};
use crate::math::lanes::LANES;
use arrayvec::ArrayVec;
use bending::{DEGENERATE, bending};
use glam::DVec3;
use paraboloid::Paraboloid;
use std::collections::BinaryHeap;

/// Limit of the number of subpatches, which keeps a patch below 64 KiB of memory and bounds the build time.
const MAX_SUBPATCHES: usize = 256;

/// Halvings after which the tree leaves a subpatch that gets no flatter (a cusp, a collapsed edge) to subdivision by rays.
const MAX_DEPTH: usize = 12;

/// The subpatches of one patch under a tree of boxes with eight children per node, in unit space.
#[derive(Clone, Debug, Default)]
pub(crate) struct SubpatchTree {
    nodes: Vec<Node>,
    leaves: Vec<Subpatch8>,
}

/// A node or a leaf of the tree.
pub(crate) enum TreeNode<'a> {
    Inner(&'a Node),
    Leaf(&'a Subpatch8),
}

/// A subpatch while the tree is built.
struct Piece {
    net: SoaNet,
    domain: Domain,
    depth: usize,
    /// See [`bending()`].
    bending: [f64; 2],
    /// Indices of its halves, if it is cut.
    halves: Option<[usize; 2]>,
    /// The number of subpatches that it ends up as.
    leaves: usize,
}

impl SubpatchTree {
    /// The tree of a patch with this net in unit space.
    pub(crate) fn new(net: &SoaNet) -> Self {
        let pieces = cut(net);
        let mut tree = Self::default();
        tree.build_node(&pieces, 0);
        tree.nodes.shrink_to_fit();
        tree.leaves.shrink_to_fit();
        tree
    }

    /// The root of the tree.
    pub(crate) fn root(&self) -> NodeRef {
        self.nodes.len().checked_sub(1).map_or(NodeRef::leaf(0), NodeRef::node)
    }

    /// The node or leaf of a reference.
    #[inline(always)]
    pub(crate) fn get(&self, node: NodeRef) -> TreeNode<'_> {
        if node.is_leaf() {
            TreeNode::Leaf(&self.leaves[node.index()])
        } else {
            TreeNode::Inner(&self.nodes[node.index()])
        }
    }

    /// The distance, in unit space, of a point to the nearest box around leaves, or `limit` if that is less; 0 for a tree
    /// that is one leaf.
    pub(crate) fn distance(&self, point: DVec3, limit: f64) -> f64 {
        let mut nearest = if self.nodes.is_empty() { 0.0 } else { limit };
        let mut open = vec![self.root()];
        while let Some(node) = open.pop() {
            let TreeNode::Inner(node) = self.get(node) else { continue };
            for (slot, distance) in node.distances(point).into_iter().enumerate() {
                match node.child(slot) {
                    child if child.is_leaf() => nearest = nearest.min(distance),
                    child if distance < nearest => open.push(child),
                    _ => {}
                }
            }
        }
        nearest
    }

    /// Bytes on the heap.
    pub(crate) fn heap_bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>() + self.leaves.capacity() * size_of::<Subpatch8>()
    }

    /// Adds the tree over the subpatches of a piece.
    fn build_node(&mut self, pieces: &[Piece], root: usize) -> NodeRef {
        if pieces[root].leaves <= LANES {
            let mut subpatches = ArrayVec::new();
            collect_subpatches(pieces, root, &mut subpatches);
            self.leaves.push(Subpatch8::new(&subpatches));
            return NodeRef::leaf(self.leaves.len() - 1);
        }
        let children = children_of(pieces, root);
        let boxes: ArrayVec<_, LANES> = children.iter().map(|&k| pieces[k].net.bounds()).collect();
        let children: ArrayVec<_, LANES> = children.iter().map(|&k| self.build_node(pieces, k)).collect();
        self.nodes.push(Node::new(&boxes, &children));
        NodeRef::node(self.nodes.len() - 1)
    }
}

/// Halves the subpatch with the greatest need, again and again. The first piece is the patch.
fn cut(net: &SoaNet) -> Vec<Piece> {
    let mut pieces = Vec::with_capacity(2 * MAX_SUBPATCHES);
    pieces.push(Piece::new(*net, Domain::WHOLE, 0));
    let mut open = BinaryHeap::from_iter(pieces[0].need().map(|need| (need, 0)));
    for _ in 1..MAX_SUBPATCHES {
        let Some((_, k)) = open.pop() else {
            break;
        };
        pieces[k].halves = Some([pieces.len(), pieces.len() + 1]);
        for half in pieces[k].cut() {
            open.extend(half.need().map(|need| (need, pieces.len())));
            pieces.push(half);
        }
    }
    // Halves stand after their parents.
    for k in (0..pieces.len()).rev() {
        if let Some(halves) = pieces[k].halves {
            pieces[k].leaves = halves.into_iter().map(|half| pieces[half].leaves).sum();
        }
    }
    pieces
}

impl Piece {
    fn new(net: SoaNet, domain: Domain, depth: usize) -> Self {
        Self { net, domain, depth, bending: bending(&net), halves: None, leaves: 1 }
    }

    /// The gain of halving it, as a sortable number; `None` for a subpatch that may stay whole.
    fn need(&self) -> Option<u64> {
        let bending = self.bending[0].max(self.bending[1]);
        let open = bending > 1.0 && self.depth < MAX_DEPTH;
        // The bits of positive floating-point numbers sort as the numbers do.
        open.then(|| (bending.min(DEGENERATE) * self.net.bounds().diagonal()).to_bits())
    }

    /// Its halves along the axis along which it bends more.
    fn cut(&self) -> [Self; 2] {
        let (nets, domains) = if self.bending[0] >= self.bending[1] {
            (self.net.split_u(), self.domain.halves_x())
        } else {
            (self.net.split_v(), self.domain.halves_y())
        };
        [0, 1].map(|k| Self::new(nets[k], domains[k], self.depth + 1))
    }
}

/// Adds the paraboloids of a piece's subpatches.
fn collect_subpatches(pieces: &[Piece], root: usize, subpatches: &mut ArrayVec<Paraboloid, LANES>) {
    match pieces[root].halves {
        Some(halves) => halves.into_iter().for_each(|half| collect_subpatches(pieces, half, subpatches)),
        None => subpatches.push(Paraboloid::new(&pieces[root].net, pieces[root].domain)),
    }
}

/// Up to eight pieces that make up a piece with more than eight subpatches. As long as a slot is free, halves replace the
/// piece with the most subpatches, if it has more than fit in a leaf.
fn children_of(pieces: &[Piece], root: usize) -> ArrayVec<usize, LANES> {
    let mut children = ArrayVec::from_iter([root]);
    while children.len() < LANES {
        let leaves = |slot: &usize| pieces[children[*slot]].leaves;
        let Some(largest) = (0..children.len()).max_by_key(leaves).filter(|slot| leaves(slot) > LANES) else { break };
        let halves = pieces[children.swap_remove(largest)].halves;
        children.extend(halves.into_iter().flatten());
    }
    children
}
