//! From a ray to its nearest hit: down the tree of parts, nearest first.

use super::lineup::OneRay;
use super::newton::{Domain, Knowledge, Outcome, Root, solve};
use super::packet::{Branch, Candidates, Packet, PacketRay, upper_end};
use super::paraboloid::MARGIN;
use super::patch::Prepared;
use super::search::subdivide;
use super::tree::{Link, Target};
use super::unit::UnitRay;
use crate::math::lanes::{LANES, Lanes, set_bits, simd_dispatch};
use arrayvec::ArrayVec;

/// A root that counts, with the parameter t of the scene ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) root: Root,
    pub(super) t: f64,
}

/// A tree of at most 12 halvings has 12 levels of nodes at most, each of which leaves 7 siblings behind.
const STACK_SIZE: usize = 88;

/// Pieces looked at by subdivision before it gives up on a ray that runs within the surface; rays that merely graze it
/// need a few dozen.
const MAX_PIECES: usize = 5_000;

/// The state of one ray on its way through a patch.
pub(super) struct Walk<'a> {
    pub(super) patch: &'a Prepared,
    pub(super) ray: UnitRay,
    pub(super) best: Option<Hit>,
    pub(super) pieces_left: usize,
}

impl<'a> Walk<'a> {
    #[inline(always)]
    pub(super) fn new(patch: &'a Prepared, ray: UnitRay) -> Self {
        Self { patch, ray, best: None, pieces_left: MAX_PIECES }
    }

    /// The nearest hit, or with `ANY` the first to be found.
    #[inline(always)]
    pub(super) fn run<L: Lanes, const ANY: bool>(mut self, l: L) -> Option<Hit> {
        let mut ray = PacketRay::new(l, &self.ray);
        let mut stack = Stack::new();
        stack.push((f32::NEG_INFINITY, self.patch.tree.root()));
        while let Some((near, link)) = stack.pop() {
            if near > upper_end(&self.ray) {
                continue;
            }
            match self.patch.tree.follow(link) {
                Target::Node(node) => {
                    let (mask, near) = node.test(l, OneRay, &ray);
                    let bottom = stack.len();
                    for k in set_bits(mask) {
                        insert(&mut stack, bottom, (near[k], node.child(k)));
                    }
                }
                Target::Packet(packet) => {
                    self.visit_packet(l, packet, &packet.test(l, OneRay, &ray));
                    if ANY && self.best.is_some() {
                        return self.best;
                    }
                    ray.shorten(l, &self.ray);
                }
            }
        }
        self.best
    }

    /// Looks for roots where the paraboloids of a packet leave any.
    #[inline(always)]
    fn visit_packet(&mut self, l: impl Lanes, packet: &Packet, candidates: &Candidates) {
        for bit in set_bits(candidates.branches) {
            let branch = candidates.branch(bit);
            let (part, enlarged) = packet.domain(bit % LANES);
            let (alpha, beta) = branch.start;
            let start = (part.x + alpha * MARGIN * part.half_x, part.y + beta * MARGIN * part.half_y);
            self.follow(l, (part, enlarged), &branch, start);
        }
        for k in set_bits(candidates.unknown) {
            subdivide(self, &packet.domain(k).0);
        }
    }

    /// Looks for the root on one branch of a part, from a start in x and y.
    #[inline(always)]
    pub(super) fn follow(
        &mut self,
        l: impl Lanes,
        (part, enlarged): (Domain, f64),
        branch: &Branch,
        start: (f64, f64),
    ) {
        if branch.near > upper_end(&self.ray) {
            return;
        }
        let known = Knowledge { enlarged, slope: branch.slope, reach: f64::INFINITY };
        match solve(l, &self.patch.power, &self.ray, &part, &known, start) {
            Outcome::Root(root) => self.accept(root),
            Outcome::None => {}
            Outcome::Unknown => subdivide(self, &part),
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
        }
    }
}

/// What is left to visit, with where the ray enters it, the nearest on top.
pub(super) type Stack = ArrayVec<(f32, Link), STACK_SIZE>;

/// Pushes an entry below those above `bottom` that are nearer.
#[inline(always)]
pub(super) fn insert(stack: &mut Stack, bottom: usize, entry: (f32, Link)) {
    stack.push(entry);
    let mut place = stack.len() - 1;
    while place > bottom && stack[place - 1].0 < stack[place].0 {
        stack.swap(place - 1, place);
        place -= 1;
    }
}

simd_dispatch! {
    /// The nearest hit of a ray.
    pub(super) fn nearest_hit(l: impl Lanes, patch: &Prepared, ray: UnitRay) -> Option<Hit> {
        Walk::new(patch, ray).run::<_, false>(l)
    }
}

simd_dispatch! {
    /// Whether a ray has any hit.
    pub(super) fn has_hit(l: impl Lanes, patch: &Prepared, ray: UnitRay) -> bool {
        Walk::new(patch, ray).run::<_, true>(l).is_some()
    }
}
