//! From a ray to its nearest hit: down the tree of parts, nearest first.

use super::newton::{Knowledge, Outcome, Root, solve};
use super::packet::{Packet, PacketRay};
use super::paraboloid::MARGIN;
use super::patch::Prepared;
use super::search::subdivide;
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
    packet_ray: PacketRay,
    best: Option<Hit>,
    pub(super) pieces_left: usize,
}

impl<'a> Walk<'a> {
    #[inline(always)]
    pub(super) fn new(patch: &'a Prepared, ray: UnitRay) -> Self {
        Self { patch, packet_ray: PacketRay::new(&ray), ray, best: None, pieces_left: MAX_PIECES }
    }

    /// The nearest hit, or with `ANY` the first to be found.
    #[inline(always)]
    pub(super) fn run<const ANY: bool>(mut self) -> Option<Hit> {
        let mut stack = [(f32::NEG_INFINITY, self.patch.tree.root()); STACK_SIZE];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (near, link) = stack[height];
            if near > self.z_max() {
                continue;
            }
            match self.patch.tree.follow(link) {
                Target::Node(node) => {
                    let (mask, near) = node.test(&self.packet_ray);
                    height = push_farthest_first(&mut stack, height, mask, |k| (near[k], node.child(k)));
                }
                Target::Packet(packet) => {
                    self.visit_packet(packet);
                    if ANY && self.best.is_some() {
                        return self.best;
                    }
                }
            }
        }
        self.best
    }

    #[inline(always)]
    fn visit_packet(&mut self, packet: &Packet) {
        let candidates = packet.test(&self.packet_ray);
        let mut branches = candidates.branches;
        while branches != 0 {
            let bit = branches.trailing_zeros() as usize;
            branches &= branches - 1;
            let branch = candidates.branch(bit);
            if branch.near > self.z_max() {
                continue;
            }
            let (part, enlarged) = packet.domain(bit % 4);
            let start =
                (part.x + branch.start.0 * MARGIN * part.half_x, part.y + branch.start.1 * MARGIN * part.half_y);
            let known = Knowledge { enlarged, slope: branch.slope, reach: f64::INFINITY };
            match solve(&self.patch.power, &self.ray, &part, &known, start) {
                Outcome::Root(root) => self.accept(root),
                Outcome::None => {}
                Outcome::Unknown => subdivide(self, &part),
            }
        }
        let mut unknown = candidates.unknown;
        while unknown != 0 {
            subdivide(self, &packet.domain(unknown.trailing_zeros() as usize).0);
            unknown &= unknown - 1;
        }
    }

    /// The upper end of what still counts, rounded up.
    #[inline(always)]
    fn z_max(&self) -> f32 {
        self.packet_ray.z_max.to_array()[0]
    }

    /// Keeps a root if it is the nearest so far.
    #[inline(always)]
    pub(super) fn accept(&mut self, root: Root) {
        if root.z < self.ray.z_max
            && let Some(t) = self.ray.t_in_range(root.z)
        {
            self.best = Some(Hit { root, t });
            self.ray.z_max = root.z;
            self.packet_ray.shorten(&self.ray);
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
