//! A packet of eight rays through the tree of a patch, a ray in each lane \[WSBW01\]: faster than single rays if they
//! are coherent, as camera rays are. A ray has the same hit as alone.

use super::power::PowerForm;
use super::prepared::PreparedPatch;
use super::query::{Hit, RayQuery};
use super::subdivision::{solve_or_subdivide, subdivide};
use super::traversal::{Stack, insert};
use crate::geometry::bezier::tree::{Candidates, MARGIN, Node, TreeNode};
use crate::geometry::bezier::unit::{Domain, LaneRays, RayPerLane, UnitRay, rounded_z_max};
use crate::math::lanes::{LANES, Lanes, set_bits, simd_dispatch};
use std::array::from_fn;

/// Newton steps in single precision, after which one step in double precision is mostly enough.
const STEPS: usize = 2;

simd_dispatch! {
    /// The nearest hit of each ray; `None` for a miss.
    pub(crate) fn nearest_hit_of_each(l: impl Lanes, patch: &PreparedPatch, rays: &[UnitRay; LANES]) -> [Option<Hit>; LANES] {
        PacketTraversal::new(l, patch, rays).run(l)
    }
}

/// The state of eight rays on their way through a patch.
struct PacketTraversal<'a, L: Lanes> {
    patch: &'a PreparedPatch,
    queries: [RayQuery<'a>; LANES],
    rays: LaneRays<L>,
    /// The upper end of each ray.
    z_max: [f32; LANES],
    /// The greatest of the upper ends.
    farthest: f32,
}

impl<'a, L: Lanes> PacketTraversal<'a, L> {
    #[inline(always)]
    fn new(l: L, patch: &'a PreparedPatch, rays: &[UnitRay; LANES]) -> Self {
        let mut traversal = Self {
            patch,
            queries: from_fn(|k| RayQuery::new(patch, rays[k])),
            rays: LaneRays::packet(l, rays),
            z_max: [0.0; LANES],
            farthest: 0.0,
        };
        traversal.shorten(l);
        traversal
    }

    #[inline(always)]
    fn run(mut self, l: L) -> [Option<Hit>; LANES] {
        let mut stack = Stack::new();
        stack.push((f32::NEG_INFINITY, self.patch.tree.root()));
        while let Some((near, node)) = stack.pop() {
            if near > self.farthest {
                continue;
            }
            match self.patch.tree.get(node) {
                TreeNode::Inner(node) => self.push_children(l, node, &mut stack),
                TreeNode::Leaf(leaf) => {
                    for k in 0..leaf.count() {
                        let candidates = leaf.intersect_paraboloids(l, RayPerLane(k), &self.rays);
                        if candidates.branches | candidates.undecided != 0 {
                            self.visit_subpatch(l, leaf.domain(k), &candidates);
                        }
                    }
                    self.shorten(l);
                }
            }
        }
        self.queries.map(|query| query.nearest)
    }

    /// Looks for the roots that the paraboloid of a subpatch leaves possible.
    #[inline(always)]
    fn visit_subpatch(&mut self, l: L, domain: (Domain, f64), candidates: &Candidates) {
        for first in [0, LANES] {
            let lanes = candidates.branches >> first & ((1 << LANES) - 1);
            if lanes == 0 {
                continue;
            }
            let (x, y) = refined(l, &self.patch.power, &self.rays, &domain.0, candidates, first / LANES);
            for k in set_bits(lanes) {
                let start = (f64::from(x[k]), f64::from(y[k]));
                solve_or_subdivide(l, &mut self.queries[k], domain, &candidates.branch(first + k), start);
            }
        }
        for k in set_bits(candidates.undecided) {
            subdivide(&mut self.queries[k], &domain.0);
        }
    }

    /// Ends the lanes' rays where the queries' rays end.
    #[inline(always)]
    fn shorten(&mut self, l: L) {
        self.farthest = f32::NEG_INFINITY;
        for (z_max, query) in self.z_max.iter_mut().zip(&self.queries) {
            *z_max = rounded_z_max(&query.ray);
            self.farthest = self.farthest.max(*z_max);
        }
        self.rays.set_z_max(l, &self.z_max);
    }

    /// Pushes the children that any ray hits, the nearest on top.
    #[inline(always)]
    fn push_children(&self, l: L, node: &Node, stack: &mut Stack) {
        let bottom = stack.len();
        for k in 0..node.count() {
            let (lanes, near) = node.intersect_boxes(l, RayPerLane(k), &self.rays);
            if lanes == 0 {
                continue;
            }
            let nearest = set_bits(lanes).fold(f32::INFINITY, |nearest, lane| nearest.min(near[lane]));
            insert(stack, bottom, (nearest, node.child(k)));
        }
    }
}

/// The starts on a branch, in x and y, after Newton steps in single precision, eight rays side by side.
#[inline(always)]
fn refined<L: Lanes>(
    l: L,
    power: &PowerForm,
    rays: &LaneRays<L>,
    domain: &Domain,
    candidates: &Candidates,
    branch: usize,
) -> ([f32; LANES], [f32; LANES]) {
    let (half_x, half_y) = ((MARGIN * domain.half_x) as f32, (MARGIN * domain.half_y) as f32);
    let (middle_x, middle_y) = (domain.x as f32, domain.y as f32);
    let [alpha, beta] = candidates.starts(l, branch);
    let mut x = clamped(l, l.mul_add(alpha, l.splat(half_x), l.splat(middle_x)), middle_x, half_x);
    let mut y = clamped(l, l.mul_add(beta, l.splat(half_y), l.splat(middle_y)), middle_y, half_y);
    for _ in 0..STEPS {
        let p = [power.lane_tangents(l, 0, x, y), power.lane_tangents(l, 1, x, y), power.lane_tangents(l, 2, x, y)];
        let d = rays.direction;
        let to_ray = [
            l.sub(rays.origin[0], p[0].position),
            l.sub(rays.origin[1], p[1].position),
            l.sub(rays.origin[2], p[2].position),
        ];
        let across_y = cross(l, [p[0].dy, p[1].dy, p[2].dy], d);
        let across_x = cross(l, d, [p[0].dx, p[1].dx, p[2].dx]);
        let inverse = l.div(l.splat(1.0), l.dot([p[0].dx, p[1].dx, p[2].dx], across_y));
        x = clamped(l, l.mul_add(l.dot(to_ray, across_y), inverse, x), middle_x, half_x);
        y = clamped(l, l.mul_add(l.dot(to_ray, across_x), inverse, y), middle_y, half_y);
    }
    (l.store(x), l.store(y))
}

/// The numbers clamped to `middle - half` to `middle + half`.
#[inline(always)]
fn clamped<L: Lanes>(l: L, v: L::Vector, middle: f32, half: f32) -> L::Vector {
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
