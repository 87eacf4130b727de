//! Eight parts of a patch side by side, and the intersection of a ray with their paraboloids.

use super::lineup::{Lineup, Numbers};
use super::newton::Domain;
use super::paraboloid::{MARGIN, Paraboloid, ROUNDING};
use super::unit::UnitRay;
use crate::math::lanes::{LANES, Lanes};
use glam::Vec3;
use std::array::from_fn;

/// Up to eight parts.
#[derive(Clone, Debug)]
pub(super) struct Packet {
    center: [Numbers; 3],
    axes: [[Numbers; 3]; 3],
    hessian: [Numbers; 3],
    offset: Numbers,
    extent: [Numbers; 3],
    error: Numbers,
    slope_error: [Numbers; 2],
    convex: Numbers,
    domains: [Numbers; 4],
    /// How many parts there are.
    count: usize,
}

/// What the paraboloids leave to do, by lanes: for one ray and all parts, or for eight rays and one part. On each of the
/// two branches of a paraboloid, along which the height of the ray over it rises or falls, the surface has one root at
/// most.
pub(super) struct Candidates {
    /// Bit k: the surface may have a root on the first branch of lane k; bit 8 + k: on its second one.
    pub(super) branches: u32,
    /// Bit k: nothing is known in lane k.
    pub(super) unknown: u32,
    /// The roots of the paraboloids: z on the ray, and alpha and beta; first branches, then second ones.
    z: [Numbers; 2],
    start: [[Numbers; 2]; 2],
    /// By how much z may be off.
    slack: Numbers,
    /// The sign of the slope of the height on the first branch.
    slope: Numbers,
}

/// Where to look for the root of one branch.
pub(super) struct Branch {
    /// Lower bound of z.
    pub(super) near: f32,
    /// Approximate parameters of the part.
    pub(super) start: (f64, f64),
    /// Whether the ray crosses the surface along its normal there, 1, or against it, -1.
    pub(super) slope: f64,
}

impl Candidates {
    /// The branch of a bit of `branches`.
    #[inline(always)]
    pub(super) fn branch(&self, bit: usize) -> Branch {
        let (branch, k) = (bit / LANES, bit % LANES);
        let [alpha, beta] = [f64::from(self.start[branch][0][k]), f64::from(self.start[branch][1][k])];
        Branch {
            near: self.z[branch][k] - self.slack[k],
            start: (alpha.clamp(-1.0, 1.0), beta.clamp(-1.0, 1.0)),
            slope: f64::from(if branch == 0 { self.slope[k] } else { -self.slope[k] }),
        }
    }

    /// Alpha and beta of the roots on a branch.
    #[inline(always)]
    pub(super) fn starts<L: Lanes>(&self, l: L, branch: usize) -> [L::Vector; 2] {
        [l.load(&self.start[branch][0]), l.load(&self.start[branch][1])]
    }
}

impl Packet {
    /// Up to eight parts; the rest of the places stay empty.
    pub(super) fn new(parts: &[Paraboloid]) -> Self {
        debug_assert!((1..=LANES).contains(&parts.len()), "one to eight parts");
        let numbers =
            |f: &dyn Fn(&Paraboloid) -> f64| -> Numbers { from_fn(|k| parts.get(k).map_or(0.0, |p| f(p) as f32)) };
        // Bounds may not shrink when they are rounded.
        let bound = |f: &dyn Fn(&Paraboloid) -> f64| numbers(&|p| f(p) * (1.0 + 1e-6));
        Self {
            center: [0, 1, 2].map(|k| numbers(&|p| p.center[k])),
            axes: [0, 1, 2].map(|a| [0, 1, 2].map(|k| numbers(&|p| p.axes[a][k]))),
            hessian: [0, 1, 2].map(|k| numbers(&|p| p.hessian[k])),
            offset: numbers(&|p| p.offset),
            extent: [0, 1, 2].map(|k| bound(&|p| p.extent[k])),
            error: bound(&|p| p.error),
            slope_error: [0, 1].map(|k| bound(&|p| p.slope_error[k])),
            convex: numbers(&|p| p.convex),
            domains: [
                numbers(&|p| p.domain.x),
                numbers(&|p| p.domain.y),
                numbers(&|p| p.domain.half_x),
                numbers(&|p| p.domain.half_y),
            ],
            count: parts.len(),
        }
    }

    /// How many parts there are.
    #[inline(always)]
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Part k of the parameter square, and the factor by which it may be enlarged with still one root a branch.
    #[inline(always)]
    pub(super) fn domain(&self, k: usize) -> (Domain, f64) {
        let [x, y, half_x, half_y] = &self.domains;
        let at = |of: &Numbers| f64::from(of[k]);
        (Domain { x: at(x), y: at(y), half_x: at(half_x), half_y: at(half_y) }, MARGIN * f64::from(self.convex[k]))
    }

    /// Intersects a ray with the paraboloids of all parts, or eight rays with that of one.
    ///
    /// Let w count along the ray from its point nearest to the center of the part. The height of the ray over the
    /// paraboloid is `h(w) = c + b w + a w^2`, and over the surface it differs from that by `error` at most. Between two
    /// roots of the surface the mean slope of the true height is zero, and it differs by `slope_error` along the ray from
    /// the mean slope of h, which is h'(w) for some w between them. So with `d = b^2 - 4 a c`:
    /// roots of the surface lie where `|h| <= error`, thus where `|h'|^2 >= d - 4 |a| error`; if that is more than
    /// `slope_error` squared, then there is one at most on each side of the vertex. If `d + 4 |a| error < 0`, there is none.
    #[inline(always)]
    pub(super) fn test<L: Lanes>(&self, l: L, lineup: impl Lineup, ray: &PacketRay<L>) -> Candidates {
        let center = lineup.numbers3(l, &self.center);
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
            [lineup.numbers3(l, &self.axes[0]), lineup.numbers3(l, &self.axes[1]), lineup.numbers3(l, &self.axes[2])];
        let at @ [alpha, beta, gamma] = [l.dot(axis_a, foot), l.dot(axis_b, foot), l.dot(axis_c, foot)];
        let along @ [d_alpha, d_beta, d_gamma] =
            [l.dot(axis_a, ray.direction), l.dot(axis_b, ray.direction), l.dot(axis_c, ray.direction)];
        let [h_aa, h_ab, h_bb] = lineup.numbers3(l, &self.hessian);
        // Of the paraboloid, by alpha and by beta.
        let slope_a = l.mul_add(h_aa, alpha, l.mul(h_ab, beta));
        let slope_b = l.mul_add(h_ab, alpha, l.mul(h_bb, beta));
        let height = l.mul_add(slope_a, alpha, l.mul(slope_b, beta));
        let turn_a = l.mul_add(h_aa, d_alpha, l.mul(h_ab, d_beta));
        let turn_b = l.mul_add(h_ab, d_alpha, l.mul(h_bb, d_beta));
        let c = l.mul_add(l.splat(-0.5), height, l.sub(gamma, lineup.numbers(l, &self.offset)));
        let b = l.sub(d_gamma, l.mul_add(slope_a, d_alpha, l.mul(slope_b, d_beta)));
        let a = l.scale(-0.5, l.mul_add(turn_a, d_alpha, l.mul(turn_b, d_beta)));

        let error = lineup.numbers(l, &self.error);
        let b_squared = l.mul(b, b);
        let discriminant = l.mul_add(l.splat(-4.0), l.mul(a, c), b_squared);
        let spread = l.scale(4.0, l.mul(l.abs(a), error));
        let steepness = l.sub(discriminant, spread);
        let [error_a, error_b] = [lineup.numbers(l, &self.slope_error[0]), lineup.numbers(l, &self.slope_error[1])];
        let slope_error = l.mul_add(error_a, l.abs(d_alpha), l.mul(error_b, l.abs(d_beta)));
        let known = l.less(l.mul_add(l.splat(2e-6), b_squared, l.mul(slope_error, slope_error)), steepness);
        let none = l.less(l.mul_add(l.splat(2e-6), b_squared, l.add(discriminant, spread)), l.splat(0.0));

        let sign = l.sign(b);
        let sum = l.mul_add(sign, l.sqrt(discriminant), b);
        let slack = l.div(error, l.sqrt(steepness));
        let reach = [
            l.mul_add(l.abs(d_alpha), slack, lineup.numbers(l, &self.extent[0])),
            l.mul_add(l.abs(d_beta), slack, lineup.numbers(l, &self.extent[1])),
        ];
        let first = Root::new(l, l.div(l.scale(-2.0, c), sum), nearest, &at, &along);
        let second = Root::new(l, l.div(l.scale(-0.5, sum), a), nearest, &at, &along);
        let lanes = lineup.counting(self.count);
        let known_bits = l.bits(known) & lanes;
        let branches = [first.counts(l, ray, slack, reach), second.counts(l, ray, slack, reach)];
        let mut unknown = !(known_bits | l.bits(none)) & lanes;
        if unknown != 0 {
            unknown &= self.boxes_met(l, lineup, ray, nearest, &at, &along);
        }
        Candidates {
            branches: (branches[0] & known_bits) | (branches[1] & known_bits) << LANES,
            unknown,
            z: [l.store(first.z), l.store(second.z)],
            start: [[l.store(first.alpha), l.store(first.beta)], [l.store(second.alpha), l.store(second.beta)]],
            slack: l.store(slack),
            slope: l.store(sign),
        }
    }

    /// The parts whose oriented boxes the ray meets, with the ray in their coordinates.
    #[inline(always)]
    fn boxes_met<L: Lanes>(
        &self,
        l: L,
        lineup: impl Lineup,
        ray: &PacketRay<L>,
        nearest: L::Vector,
        at: &[L::Vector; 3],
        along: &[L::Vector; 3],
    ) -> u32 {
        let (mut near, mut far) = (l.sub(ray.z_min, nearest), l.sub(ray.z_max, nearest));
        for k in 0..3 {
            // A ray along a face: replaced by one that moves by less than rounding.
            let speed = l.mul(l.sign(along[k]), l.max(l.abs(along[k]), l.splat(1e-12)));
            let extent = lineup.numbers(l, &self.extent[k]);
            let low = l.div(l.sub(l.sub(l.splat(0.0), extent), at[k]), speed);
            let high = l.div(l.sub(extent, at[k]), speed);
            near = l.max(near, l.min(low, high));
            far = l.min(far, l.max(low, high));
        }
        l.bits(l.less(near, far))
    }
}

/// Where a ray meets the paraboloids of the eight parts, on one of their branches.
struct Root<L: Lanes> {
    z: L::Vector,
    alpha: L::Vector,
    beta: L::Vector,
}

impl<L: Lanes> Root<L> {
    /// The root at w.
    #[inline(always)]
    fn new(l: L, w: L::Vector, nearest: L::Vector, at: &[L::Vector; 3], along: &[L::Vector; 3]) -> Self {
        Self { z: l.add(w, nearest), alpha: l.mul_add(w, along[0], at[0]), beta: l.mul_add(w, along[1], at[1]) }
    }

    /// Where a root of the surface may lie within the part and the range of the ray: a bit a part.
    #[inline(always)]
    fn counts(&self, l: L, ray: &PacketRay<L>, slack: L::Vector, reach: [L::Vector; 2]) -> u32 {
        let over = l.and(l.less(l.abs(self.alpha), reach[0]), l.less(l.abs(self.beta), reach[1]));
        let within = l.and(l.less(l.sub(self.z, slack), ray.z_max), l.less(ray.z_min, l.add(self.z, slack)));
        l.bits(l.and(over, within))
    }
}

/// A ray in unit space for all lanes, or one for each, ready for tests of eight boxes or parts at once.
pub(super) struct PacketRay<L: Lanes> {
    pub(super) origin: [L::Vector; 3],
    pub(super) direction: [L::Vector; 3],
    pub(super) inverse: [L::Vector; 3],
    pub(super) z_min: L::Vector,
    pub(super) z_max: L::Vector,
}

impl<L: Lanes> PacketRay<L> {
    /// One ray for all lanes.
    #[inline(always)]
    pub(super) fn new(l: L, ray: &UnitRay) -> Self {
        let direction = ray.direction.as_vec3();
        Self {
            origin: l.splat3(ray.origin.as_vec3().to_array()),
            direction: l.splat3(direction.to_array()),
            inverse: l.splat3(inverse(direction).to_array()),
            z_min: l.splat(lower_end(ray)),
            z_max: l.splat(upper_end(ray)),
        }
    }

    /// A ray for each lane.
    #[inline(always)]
    pub(super) fn together(l: L, rays: &[UnitRay; LANES]) -> Self {
        let (mut origin, mut direction, mut inverses) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3], [[0.0; LANES]; 3]);
        let (mut z_min, mut z_max) = ([0.0; LANES], [0.0; LANES]);
        for (k, ray) in rays.iter().enumerate() {
            let (o, d) = (ray.origin.as_vec3(), ray.direction.as_vec3());
            let inverse = inverse(d);
            for axis in 0..3 {
                origin[axis][k] = o[axis];
                direction[axis][k] = d[axis];
                inverses[axis][k] = inverse[axis];
            }
            (z_min[k], z_max[k]) = (lower_end(ray), upper_end(ray));
        }
        Self {
            origin: l.load3(&origin),
            direction: l.load3(&direction),
            inverse: l.load3(&inverses),
            z_min: l.load(&z_min),
            z_max: l.load(&z_max),
        }
    }

    /// Lowers the upper end to that of the ray.
    #[inline(always)]
    pub(super) fn shorten(&mut self, l: L, ray: &UnitRay) {
        self.z_max = l.splat(upper_end(ray));
    }

    /// Lowers the upper ends to those of the rays.
    #[inline(always)]
    pub(super) fn shorten_all(&mut self, l: L, ends: &[f32; LANES]) {
        self.z_max = l.load(ends);
    }
}

/// No zero in, hence no NaN in the test of a box.
#[inline(always)]
fn inverse(direction: Vec3) -> Vec3 {
    direction.signum() / direction.abs().max(Vec3::splat(1e-20))
}

/// The lower end of what counts, rounded down.
#[inline(always)]
fn lower_end(ray: &UnitRay) -> f32 {
    ray.z_min as f32 - ROUNDING as f32
}

/// The upper end of what still counts, rounded up.
#[inline(always)]
pub(super) fn upper_end(ray: &UnitRay) -> f32 {
    ray.z_max as f32 + ROUNDING as f32
}
