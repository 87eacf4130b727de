//! From a ray to its nearest hit: down the tree of parts, nearest first.

use super::newton::{Outcome, Root, solve};
use super::patch::Prepared;
use super::search::subdivide;
use super::slab::{FlatParts, FlatRay};
use super::tree::{Link, Target};
use super::unit::UnitRay;
use multiversion::multiversion;

/// A root that counts, with the parameter t of the scene ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) root: Root,
    pub(super) t: f64,
}

/// A tree of at most 12 halvings has 6 levels of nodes, each of which leaves 3 siblings behind.
const STACK_SIZE: usize = 32;

/// Pieces looked at by subdivision before it gives up on a ray that runs within the surface; rays that merely graze it
/// need a few dozen.
const MAX_PIECES: usize = 5_000;

/// The state of one ray on its way through a patch.
pub(super) struct Walk<'a> {
    pub(super) patch: &'a Prepared,
    pub(super) ray: UnitRay,
    flat_ray: FlatRay,
    best: Option<Hit>,
    pub(super) pieces_left: usize,
}

impl<'a> Walk<'a> {
    #[inline(always)]
    pub(super) fn new(patch: &'a Prepared, ray: UnitRay) -> Self {
        Self { patch, flat_ray: FlatRay::new(&ray), ray, best: None, pieces_left: MAX_PIECES }
    }

    /// The nearest hit, or with `ANY` the first to be found.
    #[inline(always)]
    pub(super) fn run<const ANY: bool>(mut self) -> Option<Hit> {
        let mut stack = [(f32::NEG_INFINITY, self.patch.tree.root()); STACK_SIZE];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (near, link) = stack[height];
            if near > self.flat_ray.z_max.to_array()[0] {
                continue;
            }
            match self.patch.tree.follow(link) {
                Target::Node(node) => {
                    let (mask, near) = node.test(&self.flat_ray);
                    height = push_farthest_first(&mut stack, height, mask, |k| (near[k], node.child(k)));
                }
                Target::Leaf(parts) => {
                    self.visit_leaf(parts);
                    if ANY && self.best.is_some() {
                        return self.best;
                    }
                }
            }
        }
        self.best
    }

    #[inline(always)]
    fn visit_leaf(&mut self, parts: &FlatParts) {
        let candidates = parts.test(&self.flat_ray);
        let mut mask = candidates.mask;
        while mask != 0 {
            let k = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            if candidates.near[k] > self.flat_ray.z_max.to_array()[0] {
                continue;
            }
            let part = parts.domain(k);
            let outcome = if candidates.unique >> k & 1 != 0 {
                let [s, t] = candidates.start.map(|start| f64::from(start[k]).clamp(-1.0, 1.0));
                let start = (part.x + s * part.half_x, part.y + t * part.half_y);
                solve(&self.patch.power, &self.ray, &part, f64::from(candidates.nonlinearity[k]), start)
            } else {
                Outcome::Unknown
            };
            match outcome {
                Outcome::Root(root) => self.accept(root),
                Outcome::None => {}
                Outcome::Unknown => subdivide(self, &part),
            }
        }
    }

    /// Keeps a root if it is the nearest so far.
    #[inline(always)]
    pub(super) fn accept(&mut self, root: Root) {
        if root.z < self.ray.z_max
            && let Some(t) = self.ray.t_in_range(root.z)
        {
            self.best = Some(Hit { root, t });
            self.ray.z_max = root.z;
            self.flat_ray.shorten(&self.ray);
        }
    }
}

/// Pushes what the mask names, in the order in which it is to be left for later: the nearest on top.
#[inline(always)]
fn push_farthest_first(
    stack: &mut [(f32, Link); STACK_SIZE],
    height: usize,
    mut mask: u32,
    child: impl Fn(usize) -> (f32, Link),
) -> usize {
    let mut top = height;
    while mask != 0 {
        let entry = child(mask.trailing_zeros() as usize);
        mask &= mask - 1;
        let mut place = top;
        while place > height && stack[place - 1].0 < entry.0 {
            stack[place] = stack[place - 1];
            place -= 1;
        }
        stack[place] = entry;
        top += 1;
    }
    top
}

/// The nearest hit of a ray.
#[multiversion(targets("x86_64+avx+avx2+fma"))]
pub(super) fn nearest_hit(patch: &Prepared, ray: UnitRay) -> Option<Hit> {
    Walk::new(patch, ray).run::<false>()
}

/// Whether a ray has any hit.
#[multiversion(targets("x86_64+avx+avx2+fma"))]
pub(super) fn has_hit(patch: &Prepared, ray: UnitRay) -> bool {
    Walk::new(patch, ray).run::<true>().is_some()
}
