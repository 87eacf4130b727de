//! Eight rays that go nearly the same way, as those of a camera do: down the tree of parts together, with a ray in each
//! lane. Each finds what it would find alone.

use super::lineup::EightRays;
use super::newton::Domain;
use super::node::Node;
use super::packet::{Candidates, PacketRay, upper_end};
use super::paraboloid::MARGIN;
use super::patch::Prepared;
use super::power::PowerForm;
use super::search::subdivide;
use super::traverse::{Hit, Stack, Walk, insert};
use super::tree::Target;
use super::unit::UnitRay;
use crate::math::lanes::{LANES, Lanes, set_bits, simd_dispatch};
use std::array::from_fn;

/// Newton steps in single precision, after which one in double precision mostly is enough.
const STEPS: usize = 2;

simd_dispatch! {
    /// The nearest hit of each ray; none for [`UnitRay::NONE`].
    pub(super) fn nearest_hits(l: impl Lanes, patch: &Prepared, rays: &[UnitRay; LANES]) -> [Option<Hit>; LANES] {
        Together::new(l, patch, rays).run(l)
    }
}

/// The state of eight rays on their way through a patch.
struct Together<'a, L: Lanes> {
    patch: &'a Prepared,
    walks: [Walk<'a>; LANES],
    rays: PacketRay<L>,
    /// The upper end of each ray, and the farthest of them.
    ends: [f32; LANES],
    farthest: f32,
}

impl<'a, L: Lanes> Together<'a, L> {
    #[inline(always)]
    fn new(l: L, patch: &'a Prepared, rays: &[UnitRay; LANES]) -> Self {
        let mut together = Self {
            patch,
            walks: from_fn(|k| Walk::new(patch, rays[k])),
            rays: PacketRay::together(l, rays),
            ends: [0.0; LANES],
            farthest: 0.0,
        };
        together.shorten(l);
        together
    }

    #[inline(always)]
    fn run(mut self, l: L) -> [Option<Hit>; LANES] {
        let mut stack = Stack::new();
        stack.push((f32::NEG_INFINITY, self.patch.tree.root()));
        while let Some((near, link)) = stack.pop() {
            if near > self.farthest {
                continue;
            }
            match self.patch.tree.follow(link) {
                Target::Node(node) => self.push_farthest_first(l, node, &mut stack),
                Target::Packet(packet) => {
                    for part in 0..packet.count() {
                        let candidates = packet.test(l, EightRays(part), &self.rays);
                        if candidates.branches | candidates.unknown != 0 {
                            self.visit_part(l, packet.domain(part), &candidates);
                        }
                    }
                    self.shorten(l);
                }
            }
        }
        self.walks.map(|walk| walk.best)
    }

    /// Looks for roots where the paraboloid of a part leaves any.
    #[inline(always)]
    fn visit_part(&mut self, l: L, domain: (Domain, f64), candidates: &Candidates) {
        for first in [0, LANES] {
            let lanes = candidates.branches >> first & ((1 << LANES) - 1);
            if lanes == 0 {
                continue;
            }
            let (x, y) = refined(l, &self.patch.power, &self.rays, &domain.0, candidates, first / LANES);
            for k in set_bits(lanes) {
                self.walks[k].follow(l, domain, &candidates.branch(first + k), (f64::from(x[k]), f64::from(y[k])));
            }
        }
        for k in set_bits(candidates.unknown) {
            subdivide(&mut self.walks[k], &domain.0);
        }
    }

    /// Takes over the upper ends of the rays.
    #[inline(always)]
    fn shorten(&mut self, l: L) {
        self.farthest = f32::NEG_INFINITY;
        for (end, walk) in self.ends.iter_mut().zip(&self.walks) {
            *end = upper_end(&walk.ray);
            self.farthest = self.farthest.max(*end);
        }
        self.rays.shorten_all(l, &self.ends);
    }

    /// Pushes the children that any ray meets, the nearest on top.
    #[inline(always)]
    fn push_farthest_first(&self, l: L, node: &Node, stack: &mut Stack) {
        let bottom = stack.len();
        for k in 0..node.count() {
            let (lanes, near) = node.test(l, EightRays(k), &self.rays);
            if lanes == 0 {
                continue;
            }
            let nearest = set_bits(lanes).fold(f32::INFINITY, |nearest, lane| nearest.min(near[lane]));
            insert(stack, bottom, (nearest, node.child(k)));
        }
    }
}

/// The starts of a branch, in x and y, after Newton steps in single precision for all rays at once.
#[inline(always)]
fn refined<L: Lanes>(
    l: L,
    power: &PowerForm,
    rays: &PacketRay<L>,
    part: &Domain,
    candidates: &Candidates,
    branch: usize,
) -> ([f32; LANES], [f32; LANES]) {
    let (half_x, half_y) = ((MARGIN * part.half_x) as f32, (MARGIN * part.half_y) as f32);
    let (middle_x, middle_y) = (part.x as f32, part.y as f32);
    let [alpha, beta] = candidates.starts(l, branch);
    let mut x = within(l, l.mul_add(alpha, l.splat(half_x), l.splat(middle_x)), middle_x, half_x);
    let mut y = within(l, l.mul_add(beta, l.splat(half_y), l.splat(middle_y)), middle_y, half_y);
    for _ in 0..STEPS {
        let p = [power.slopes(l, 0, x, y), power.slopes(l, 1, x, y), power.slopes(l, 2, x, y)];
        let d = rays.direction;
        let to_ray = [
            l.sub(rays.origin[0], p[0].position),
            l.sub(rays.origin[1], p[1].position),
            l.sub(rays.origin[2], p[2].position),
        ];
        let across_y = cross(l, [p[0].dy, p[1].dy, p[2].dy], d);
        let across_x = cross(l, d, [p[0].dx, p[1].dx, p[2].dx]);
        let inverse = l.div(l.splat(1.0), l.dot([p[0].dx, p[1].dx, p[2].dx], across_y));
        x = within(l, l.mul_add(l.dot(to_ray, across_y), inverse, x), middle_x, half_x);
        y = within(l, l.mul_add(l.dot(to_ray, across_x), inverse, y), middle_y, half_y);
    }
    (l.store(x), l.store(y))
}

/// The numbers, but no farther than this from the middle.
#[inline(always)]
fn within<L: Lanes>(l: L, v: L::Vector, middle: f32, half: f32) -> L::Vector {
    l.min(l.max(v, l.splat(middle - half)), l.splat(middle + half))
}

#[inline(always)]
fn cross<L: Lanes>(l: L, a: [L::Vector; 3], b: [L::Vector; 3]) -> [L::Vector; 3] {
    [
        l.sub(l.mul(a[1], b[2]), l.mul(a[2], b[1])),
        l.sub(l.mul(a[2], b[0]), l.mul(a[0], b[2])),
        l.sub(l.mul(a[0], b[1]), l.mul(a[1], b[0])),
    ]
}
