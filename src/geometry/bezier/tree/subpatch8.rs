//! Eight subpatches side by side as a structure of arrays, and the intersection of rays with their paraboloids.

use super::paraboloid::{MARGIN, Paraboloid};
use crate::geometry::bezier::unit::{Column, Domain, LaneLayout, LaneRays};
use crate::math::lanes::{LANES, Lanes};
use std::array::from_fn;

/// A leaf of the tree: up to eight subpatches by their paraboloids.
#[derive(Clone, Debug)]
pub(crate) struct Subpatch8 {
    center: [Column; 3],
    axes: [[Column; 3]; 3],
    hessian: [Column; 3],
    offset: Column,
    extent: [Column; 3],
    error: Column,
    slope_error: [Column; 2],
    convex: Column,
    domains: [Column; 4],
    count: usize,
}

/// The candidate roots of rays and subpatches, by lanes. The height of a ray over a paraboloid is monotone on two branches;
/// where the paraboloid decides, the surface has at most one root on each.
pub(crate) struct Candidates {
    /// Bit k: the surface may have a root on the first branch of lane k; bit 8 + k: on its second branch.
    pub(crate) branches: u32,
    /// Bit k: the paraboloid does not decide lane k.
    pub(crate) undecided: u32,
    /// z of the paraboloids' roots on the first and on the second branches.
    z: [Column; 2],
    /// Alpha and beta of these roots, on the first and on the second branches.
    start: [[Column; 2]; 2],
    /// Bound of the error of z.
    slack: Column,
    /// The sign of the height's slope on the first branch.
    slope: Column,
}

/// A candidate root, on one branch of one lane.
pub(crate) struct Branch {
    /// Lower bound of the root's z.
    pub(crate) near: f32,
    /// Approximate alpha and beta, clamped to -1 to 1.
    pub(crate) start: (f64, f64),
    /// 1 where the ray crosses the surface along the normal, -1 where against it.
    pub(crate) slope: f64,
}

impl Candidates {
    /// The candidate of a bit of `branches`.
    #[inline(always)]
    pub(crate) fn branch(&self, bit: usize) -> Branch {
        let (branch, k) = (bit / LANES, bit % LANES);
        let [alpha, beta] = [f64::from(self.start[branch][0][k]), f64::from(self.start[branch][1][k])];
        Branch {
            near: self.z[branch][k] - self.slack[k],
            start: (alpha.clamp(-1.0, 1.0), beta.clamp(-1.0, 1.0)),
            slope: f64::from(if branch == 0 { self.slope[k] } else { -self.slope[k] }),
        }
    }

    /// Alpha and beta of the roots on the first (0) or second (1) branches, by lanes.
    #[inline(always)]
    pub(crate) fn starts<L: Lanes>(&self, l: L, branch: usize) -> [L::Vector; 2] {
        [l.load(&self.start[branch][0]), l.load(&self.start[branch][1])]
    }
}

impl Subpatch8 {
    /// The leaf of one to eight subpatches.
    pub(crate) fn new(subpatches: &[Paraboloid]) -> Self {
        debug_assert!((1..=LANES).contains(&subpatches.len()), "one to eight subpatches");
        let column =
            |f: &dyn Fn(&Paraboloid) -> f64| -> Column { from_fn(|k| subpatches.get(k).map_or(0.0, |p| f(p) as f32)) };
        // Rounding may not shrink a bound.
        let bound = |f: &dyn Fn(&Paraboloid) -> f64| column(&|p| f(p) * (1.0 + 1e-6));
        Self {
            center: [0, 1, 2].map(|k| column(&|p| p.center[k])),
            axes: [0, 1, 2].map(|a| [0, 1, 2].map(|k| column(&|p| p.axes[a][k]))),
            hessian: [0, 1, 2].map(|k| column(&|p| p.hessian[k])),
            offset: column(&|p| p.offset),
            extent: [0, 1, 2].map(|k| bound(&|p| p.extent[k])),
            error: bound(&|p| p.error),
            slope_error: [0, 1].map(|k| bound(&|p| p.slope_error[k])),
            convex: column(&|p| p.convex),
            domains: [
                column(&|p| p.domain.x),
                column(&|p| p.domain.y),
                column(&|p| p.domain.half_x),
                column(&|p| p.domain.half_y),
            ],
            count: subpatches.len(),
        }
    }

    /// The number of subpatches.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// The domain of subpatch k, and the factor by which it may be enlarged while each branch has at most one root.
    #[inline(always)]
    pub(crate) fn domain(&self, k: usize) -> (Domain, f64) {
        let [x, y, half_x, half_y] = &self.domains;
        let at = |of: &Column| f64::from(of[k]);
        (Domain { x: at(x), y: at(y), half_x: at(half_x), half_y: at(half_y) }, MARGIN * f64::from(self.convex[k]))
    }

    /// Intersects rays with the paraboloids, in the pairs of `layout`.
    ///
    /// Let w be the distance along the ray from its point nearest to the center of the subpatch. The height of the ray over
    /// the paraboloid is `h(w) = c + b w + a w^2`; its height over the surface differs from h by at most `error`. Between
    /// two roots of the surface the mean slope of the true height is zero, and it differs by at most `slope_error` from the
    /// mean slope of h, which is h'(w) for some w between them. With `d = b^2 - 4 a c`: roots of the surface lie where
    /// `|h| <= error`, thus where `|h'|^2 >= d - 4 |a| error`. If that exceeds `slope_error` squared, there is at most one
    /// root on each side of the vertex. If `d + 4 |a| error < 0`, there is no root.
    #[inline(always)]
    pub(crate) fn intersect_paraboloids<L: Lanes>(
        &self,
        l: L,
        layout: impl LaneLayout,
        ray: &LaneRays<L>,
    ) -> Candidates {
        let local = self.local_rays(l, layout, ray);
        let [d_alpha, d_beta, _] = local.direction;
        let [c, b, a] = self.heights(l, layout, &local);
        let error = layout.load(l, &self.error);
        let b_squared = l.mul(b, b);
        let discriminant = l.mul_add(l.splat(-4.0), l.mul(a, c), b_squared);
        let spread = l.scale(4.0, l.mul(l.abs(a), error));
        let steepness = l.sub(discriminant, spread);
        let [error_a, error_b] = [layout.load(l, &self.slope_error[0]), layout.load(l, &self.slope_error[1])];
        let slope_error = l.mul_add(error_a, l.abs(d_alpha), l.mul(error_b, l.abs(d_beta)));
        let decided = l.less(l.mul_add(l.splat(2e-6), b_squared, l.mul(slope_error, slope_error)), steepness);
        let none = l.less(l.mul_add(l.splat(2e-6), b_squared, l.add(discriminant, spread)), l.splat(0.0));
        let sign = l.sign(b);
        let sum = l.mul_add(sign, l.sqrt(discriminant), b);
        let slack = l.div(error, l.sqrt(steepness));
        let reach = [
            l.mul_add(l.abs(d_alpha), slack, layout.load(l, &self.extent[0])),
            l.mul_add(l.abs(d_beta), slack, layout.load(l, &self.extent[1])),
        ];
        let first = BranchRoots::new(l, l.div(l.scale(-2.0, c), sum), &local);
        let second = BranchRoots::new(l, l.div(l.scale(-0.5, sum), a), &local);
        let lanes = layout.active(self.count);
        let decided_lanes = l.bits(decided) & lanes;
        let branches = [first.in_range(l, ray, slack, reach), second.in_range(l, ray, slack, reach)];
        let mut undecided = !(decided_lanes | l.bits(none)) & lanes;
        if undecided != 0 {
            undecided &= self.oriented_boxes_hit(l, layout, ray, &local);
        }
        Candidates {
            branches: (branches[0] & decided_lanes) | (branches[1] & decided_lanes) << LANES,
            undecided,
            z: [l.store(first.z), l.store(second.z)],
            start: [[l.store(first.alpha), l.store(first.beta)], [l.store(second.alpha), l.store(second.beta)]],
            slack: l.store(slack),
            slope: l.store(sign),
        }
    }

    /// Rays in the coordinates of the subpatches.
    #[inline(always)]
    fn local_rays<L: Lanes>(&self, l: L, layout: impl LaneLayout, ray: &LaneRays<L>) -> LocalRays<L> {
        let center = layout.load3(l, &self.center);
        let [x, y, z] = ray.direction;
        let from_center =
            [l.sub(ray.origin[0], center[0]), l.sub(ray.origin[1], center[1]), l.sub(ray.origin[2], center[2])];
        let nearest = l.scale(-1.0, l.dot(from_center, ray.direction));
        let foot = [
            l.mul_add(nearest, x, from_center[0]),
            l.mul_add(nearest, y, from_center[1]),
            l.mul_add(nearest, z, from_center[2]),
        ];
        let [axis_a, axis_b, axis_c] =
            [layout.load3(l, &self.axes[0]), layout.load3(l, &self.axes[1]), layout.load3(l, &self.axes[2])];
        LocalRays {
            nearest,
            foot: [l.dot(axis_a, foot), l.dot(axis_b, foot), l.dot(axis_c, foot)],
            direction: [l.dot(axis_a, ray.direction), l.dot(axis_b, ray.direction), l.dot(axis_c, ray.direction)],
        }
    }

    /// The coefficients c, b, a of the heights of rays over the paraboloids, `h(w) = c + b w + a w^2`.
    #[inline(always)]
    fn heights<L: Lanes>(&self, l: L, layout: impl LaneLayout, local: &LocalRays<L>) -> [L::Vector; 3] {
        let ([alpha, beta, gamma], [d_alpha, d_beta, d_gamma]) = (local.foot, local.direction);
        let [h_aa, h_ab, h_bb] = layout.load3(l, &self.hessian);
        // The slopes of the paraboloid by alpha and by beta.
        let slope_a = l.mul_add(h_aa, alpha, l.mul(h_ab, beta));
        let slope_b = l.mul_add(h_ab, alpha, l.mul(h_bb, beta));
        let height = l.mul_add(slope_a, alpha, l.mul(slope_b, beta));
        let turn_a = l.mul_add(h_aa, d_alpha, l.mul(h_ab, d_beta));
        let turn_b = l.mul_add(h_ab, d_alpha, l.mul(h_bb, d_beta));
        let c = l.mul_add(l.splat(-0.5), height, l.sub(gamma, layout.load(l, &self.offset)));
        let b = l.sub(d_gamma, l.mul_add(slope_a, d_alpha, l.mul(slope_b, d_beta)));
        let a = l.scale(-0.5, l.mul_add(turn_a, d_alpha, l.mul(turn_b, d_beta)));
        [c, b, a]
    }

    /// The lanes in which a ray hits the oriented box of a subpatch.
    #[inline(always)]
    fn oriented_boxes_hit<L: Lanes>(
        &self,
        l: L,
        layout: impl LaneLayout,
        ray: &LaneRays<L>,
        local: &LocalRays<L>,
    ) -> u32 {
        let LocalRays { nearest, foot, direction } = *local;
        let (mut near, mut far) = (l.sub(ray.z_min, nearest), l.sub(ray.z_max, nearest));
        for k in 0..3 {
            // A ray parallel to a face gets a speed below rounding, so that nothing divides by zero.
            let speed = l.mul(l.sign(direction[k]), l.max(l.abs(direction[k]), l.splat(1e-12)));
            let extent = layout.load(l, &self.extent[k]);
            let low = l.div(l.sub(l.sub(l.splat(0.0), extent), foot[k]), speed);
            let high = l.div(l.sub(extent, foot[k]), speed);
            near = l.max(near, l.min(low, high));
            far = l.min(far, l.max(low, high));
        }
        l.bits(l.less(near, far))
    }
}

/// Rays in the coordinates alpha, beta, gamma of subpatches, by lanes.
struct LocalRays<L: Lanes> {
    /// z of each ray's point nearest to the center of the subpatch.
    nearest: L::Vector,
    /// Coordinates of this point.
    foot: [L::Vector; 3],
    /// Coordinates of the direction.
    direction: [L::Vector; 3],
}

/// Where rays meet paraboloids on one of their branches, by lanes.
struct BranchRoots<L: Lanes> {
    z: L::Vector,
    alpha: L::Vector,
    beta: L::Vector,
}

impl<L: Lanes> BranchRoots<L> {
    /// The root at w.
    #[inline(always)]
    fn new(l: L, w: L::Vector, local: &LocalRays<L>) -> Self {
        let LocalRays { nearest, foot, direction } = *local;
        Self {
            z: l.add(w, nearest),
            alpha: l.mul_add(w, direction[0], foot[0]),
            beta: l.mul_add(w, direction[1], foot[1]),
        }
    }

    /// The lanes in which a root of the surface may lie within the subpatch and within the range of the ray.
    #[inline(always)]
    fn in_range(&self, l: L, ray: &LaneRays<L>, slack: L::Vector, reach: [L::Vector; 2]) -> u32 {
        let over = l.and(l.less(l.abs(self.alpha), reach[0]), l.less(l.abs(self.beta), reach[1]));
        let within = l.and(l.less(l.sub(self.z, slack), ray.z_max), l.less(ray.z_min, l.add(self.z, slack)));
        l.bits(l.and(over, within))
    }
}
