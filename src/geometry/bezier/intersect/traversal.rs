//! One ray through the tree of a patch, near nodes first.

use super::prepared::PreparedPatch;
use super::query::{Hit, RayQuery};
use super::subdivision::{solve_or_subdivide, subdivide};
use crate::geometry::bezier::tree::{Candidates, MARGIN, NodeRef, Subpatch8, TreeNode};
use crate::geometry::bezier::unit::{ItemPerLane, LaneRays, UnitRay, rounded_z_max};
use crate::math::lanes::{LANES, Lanes, set_bits, simd_dispatch};
use arrayvec::ArrayVec;

/// A tree of at most 12 halvings has at most 12 levels of nodes, each of which leaves 7 siblings on the stack.
const STACK_SIZE: usize = 88;

/// Nodes to visit, each with z of the ray's entry, the nearest on top.
pub(crate) type Stack = ArrayVec<(f32, NodeRef), STACK_SIZE>;

/// Inserts an entry into the entries above `bottom`, which stay sorted: the nearest on top.
#[inline(always)]
pub(crate) fn insert(stack: &mut Stack, bottom: usize, entry: (f32, NodeRef)) {
    stack.push(entry);
    let mut index = stack.len() - 1;
    while index > bottom && stack[index - 1].0 < stack[index].0 {
        stack.swap(index - 1, index);
        index -= 1;
    }
}

simd_dispatch! {
    /// The nearest hit of a ray; `None` for a miss.
    pub(crate) fn nearest_hit(l: impl Lanes, patch: &PreparedPatch, ray: UnitRay) -> Option<Hit> {
        traverse::<_, false>(l, RayQuery::new(patch, ray))
    }
}

simd_dispatch! {
    /// Whether a ray has any hit.
    pub(crate) fn has_hit(l: impl Lanes, patch: &PreparedPatch, ray: UnitRay) -> bool {
        traverse::<_, true>(l, RayQuery::new(patch, ray)).is_some()
    }
}

/// The nearest hit, or with `ANY` the first one found; `None` for a miss.
#[inline(always)]
fn traverse<L: Lanes, const ANY: bool>(l: L, mut query: RayQuery) -> Option<Hit> {
    let mut ray = LaneRays::splat(l, &query.ray);
    let mut stack = Stack::new();
    stack.push((f32::NEG_INFINITY, query.patch.tree.root()));
    while let Some((near, node)) = stack.pop() {
        if near > rounded_z_max(&query.ray) {
            continue;
        }
        match query.patch.tree.get(node) {
            TreeNode::Inner(node) => {
                let (mask, near) = node.intersect_boxes(l, ItemPerLane, &ray);
                let bottom = stack.len();
                for k in set_bits(mask) {
                    insert(&mut stack, bottom, (near[k], node.child(k)));
                }
            }
            TreeNode::Leaf(leaf) => {
                visit_leaf(l, &mut query, leaf, &leaf.intersect_paraboloids(l, ItemPerLane, &ray));
                if ANY && query.nearest.is_some() {
                    return query.nearest;
                }
                ray.shorten(l, &query.ray);
            }
        }
    }
    query.nearest
}

/// Looks for the roots that the paraboloids of a leaf leave possible.
#[inline(always)]
fn visit_leaf(l: impl Lanes, query: &mut RayQuery, leaf: &Subpatch8, candidates: &Candidates) {
    for bit in set_bits(candidates.branches) {
        let branch = candidates.branch(bit);
        let (domain, enlargement) = leaf.domain(bit % LANES);
        let (alpha, beta) = branch.start;
        let start = (domain.x + alpha * MARGIN * domain.half_x, domain.y + beta * MARGIN * domain.half_y);
        solve_or_subdivide(l, query, (domain, enlargement), &branch, start);
    }
    for k in set_bits(candidates.undecided) {
        subdivide(query, &leaf.domain(k).0);
    }
}
