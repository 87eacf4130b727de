//! Four parts of a patch side by side, and the intersection of a ray with their paraboloids.

use super::newton::Domain;
use super::paraboloid::{MARGIN, Paraboloid, ROUNDING};
use super::unit::UnitRay;
use std::array::from_fn;
use wide::f32x4;

/// Up to four parts.
#[derive(Clone, Debug)]
pub(super) struct Packet {
    center: [f32x4; 3],
    axes: [[f32x4; 3]; 3],
    hessian: [f32x4; 3],
    offset: f32x4,
    extent: [f32x4; 3],
    error: f32x4,
    slope_error: [f32x4; 2],
    convex: [f32; 4],
    domains: [[f32; 4]; 4],
    /// Bit k is set where there is a part.
    occupied: u32,
}

/// What the paraboloids leave to do. On each of the two branches of a paraboloid, along which the height of the ray over
/// it rises or falls, the surface has one root at most.
pub(super) struct Candidates {
    /// Bit k: the surface of part k may have a root on its first branch; bit 4 + k: on its second one.
    pub(super) branches: u32,
    /// Bit k: nothing is known of part k.
    pub(super) unknown: u32,
    /// The roots of the paraboloids: z on the ray, and alpha and beta; first branches, then second ones.
    z: [[f32; 4]; 2],
    start: [[[f32; 4]; 2]; 2],
    /// By how much z may be off.
    slack: [f32; 4],
    /// The sign of the slope of the height on the first branch.
    slope: [f32; 4],
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
        let (branch, k) = (bit / 4, bit % 4);
        let [alpha, beta] = self.start[branch].map(|x| f64::from(x[k]));
        Branch {
            near: self.z[branch][k] - self.slack[k],
            start: (alpha.clamp(-1.0, 1.0), beta.clamp(-1.0, 1.0)),
            slope: f64::from(if branch == 0 { self.slope[k] } else { -self.slope[k] }),
        }
    }
}

impl Packet {
    /// Up to four parts; the rest of the places stay empty.
    pub(super) fn new(parts: &[Paraboloid]) -> Self {
        debug_assert!((1..=4).contains(&parts.len()), "one to four parts");
        let numbers =
            |f: &dyn Fn(&Paraboloid) -> f64| -> [f32; 4] { from_fn(|k| parts.get(k).map_or(0.0, |p| f(p) as f32)) };
        let lanes = |f: &dyn Fn(&Paraboloid) -> f64| f32x4::from(numbers(f));
        // Bounds may not shrink when they are rounded.
        let bound = |f: &dyn Fn(&Paraboloid) -> f64| lanes(&|p| f(p) * (1.0 + 1e-6));
        Self {
            center: [0, 1, 2].map(|k| lanes(&|p| p.center[k])),
            axes: [0, 1, 2].map(|a| [0, 1, 2].map(|k| lanes(&|p| p.axes[a][k]))),
            hessian: [0, 1, 2].map(|k| lanes(&|p| p.hessian[k])),
            offset: lanes(&|p| p.offset),
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
            occupied: (1 << parts.len()) - 1,
        }
    }

    /// Part k of the parameter square, and the factor by which it may be enlarged with still one root a branch.
    #[inline(always)]
    pub(super) fn domain(&self, k: usize) -> (Domain, f64) {
        let [x, y, half_x, half_y] = self.domains.map(|d| f64::from(d[k]));
        (Domain { x, y, half_x, half_y }, MARGIN * f64::from(self.convex[k]))
    }

    /// Intersects the ray with the paraboloids.
    ///
    /// Let w count along the ray from its point nearest to the center of the part. The height of the ray over the
    /// paraboloid is `h(w) = c + b w + a w^2`, and over the surface it differs from that by `error` at most. Between two
    /// roots of the surface the mean slope of the true height is zero, and it differs by `slope_error` along the ray from
    /// the mean slope of h, which is h'(w) for some w between them. So with `d = b^2 - 4 a c`:
    /// roots of the surface lie where `|h| <= error`, thus where `|h'|^2 >= d - 4 |a| error`; if that is more than
    /// `slope_error` squared, then there is one at most on each side of the vertex. If `d + 4 |a| error < 0`, there is none.
    #[inline(always)]
    pub(super) fn test(&self, ray: &PacketRay) -> Candidates {
        let dot = |axis: &[f32x4; 3], v: &[f32x4; 3]| axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
        let from_center: [f32x4; 3] = from_fn(|k| ray.origin[k] - self.center[k]);
        let nearest = -dot(&from_center, &ray.direction);
        let foot: [f32x4; 3] = from_fn(|k| from_center[k] + nearest * ray.direction[k]);
        let [alpha, beta, gamma] = [0, 1, 2].map(|k| dot(&self.axes[k], &foot));
        let [d_alpha, d_beta, d_gamma] = [0, 1, 2].map(|k| dot(&self.axes[k], &ray.direction));
        let [h_aa, h_ab, h_bb] = self.hessian;
        let (slope_a, slope_b) = (h_aa * alpha + h_ab * beta, h_ab * alpha + h_bb * beta);
        let half = f32x4::splat(0.5);
        let c = gamma - self.offset - half * (slope_a * alpha + slope_b * beta);
        let b = d_gamma - (slope_a * d_alpha + slope_b * d_beta);
        let a = -half * (h_aa * d_alpha * d_alpha + h_bb * d_beta * d_beta) - h_ab * d_alpha * d_beta;

        let b_squared = b * b;
        let discriminant = b_squared - f32x4::splat(4.0) * (a * c);
        let spread = f32x4::splat(4.0) * (a.abs() * self.error);
        let steepness = discriminant - spread;
        let slope_error = self.slope_error[0] * d_alpha.abs() + self.slope_error[1] * d_beta.abs();
        let known = steepness.simd_gt(slope_error * slope_error + f32x4::splat(2e-6) * b_squared);
        let none = (discriminant + spread).simd_lt(f32x4::splat(-2e-6) * b_squared);

        let sign = b.is_sign_negative().bitselect(-f32x4::ONE, f32x4::ONE);
        let root = discriminant.sqrt();
        let sum = b + sign * root;
        let w = [f32x4::splat(-2.0) * c / sum, -half * sum / a];
        let slack = self.error / steepness.sqrt();
        let start = w.map(|w| [alpha + w * d_alpha, beta + w * d_beta]);
        let z = w.map(|w| w + nearest);
        let reach = [self.extent[0] + d_alpha.abs() * slack, self.extent[1] + d_beta.abs() * slack];
        let passes = [0, 1].map(|k| {
            start[k][0].abs().simd_le(reach[0])
                & start[k][1].abs().simd_le(reach[1])
                & (z[k] - slack).simd_le(ray.z_max)
                & (z[k] + slack).simd_ge(ray.z_min)
        });
        let known_bits = known.to_bitmask() & self.occupied;
        let mut unknown = !(known | none).to_bitmask() & self.occupied;
        if unknown != 0 {
            unknown &= self.boxes_met(ray, nearest, &[alpha, beta, gamma], &[d_alpha, d_beta, d_gamma]);
        }
        Candidates {
            branches: (passes[0].to_bitmask() & known_bits) | (passes[1].to_bitmask() & known_bits) << 4,
            unknown,
            z: z.map(f32x4::to_array),
            start: start.map(|s| s.map(f32x4::to_array)),
            slack: slack.to_array(),
            slope: sign.to_array(),
        }
    }

    /// The parts whose oriented boxes the ray meets, with the ray in their coordinates.
    #[cold]
    fn boxes_met(&self, ray: &PacketRay, nearest: f32x4, at: &[f32x4; 3], along: &[f32x4; 3]) -> u32 {
        let (mut near, mut far) = (ray.z_min - nearest, ray.z_max - nearest);
        let tiny = f32x4::splat(1e-12);
        for k in 0..3 {
            // A ray along a face: replaced by one that moves by less than rounding.
            let speed = along[k].abs().simd_lt(tiny).bitselect(tiny, along[k]);
            let low = (-self.extent[k] - at[k]) / speed;
            let high = (self.extent[k] - at[k]) / speed;
            near = near.fast_max(low.fast_min(high));
            far = far.fast_min(low.fast_max(high));
        }
        near.simd_le(far).to_bitmask()
    }
}

/// A ray in unit space, ready for tests of four boxes or parts at once.
pub(super) struct PacketRay {
    pub(super) origin: [f32x4; 3],
    direction: [f32x4; 3],
    pub(super) inverse: [f32x4; 3],
    pub(super) z_min: f32x4,
    pub(super) z_max: f32x4,
}

impl PacketRay {
    #[inline(always)]
    pub(super) fn new(ray: &UnitRay) -> Self {
        let direction = ray.direction.as_vec3().to_array();
        Self {
            origin: ray.origin.as_vec3().to_array().map(f32x4::splat),
            direction: direction.map(f32x4::splat),
            // No zero, hence no NaN in the test of a box.
            inverse: direction.map(|d| f32x4::splat(1.0 / if d.abs() < 1e-20 { 1e-20f32.copysign(d) } else { d })),
            z_min: f32x4::splat(ray.z_min as f32 - ROUNDING as f32),
            z_max: f32x4::splat(ray.z_max as f32 + ROUNDING as f32),
        }
    }

    /// Lowers the upper end to that of the ray.
    #[inline(always)]
    pub(super) fn shorten(&mut self, ray: &UnitRay) {
        self.z_max = f32x4::splat(ray.z_max as f32 + ROUNDING as f32);
    }
}
