//! Nearly flat parts of a patch, each within an oriented box, and the test of four of them at once.

use super::ControlNet;
use super::newton::Domain;
use super::unit::UnitRay;
use glam::DVec3;
use wide::f32x4;

/// Rounding in `f32` moves a ray in unit space by less than this; boxes are larger by as much.
///
/// Coordinates are below 1 and a dot product rounds five times: some 5 * 6e-8, and twice that where two of them are
/// combined, for the height above the mean plane and for the place within it alike.
pub(super) const ROUNDING: f64 = 4e-6;

/// The same for derivatives by parameters from -1 to 1 and for the shares that they bound.
const SLOPE_ROUNDING: f64 = 1e-5;

/// A part of a patch in coordinates (alpha, beta, gamma) in which it is nearly the square `[-1, 1]^2` in the plane
/// gamma = 0, with bounds of all deviations. Everything in unit space.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlatPart {
    domain: Domain,
    /// Where alpha, beta and gamma are zero.
    center: DVec3,
    /// The gradients of alpha, beta and gamma; the last has unit length.
    axes: [DVec3; 3],
    /// Bounds of `|alpha - s|`, `|beta - t|` and `|gamma|`, with s and t the parameters, from -1 to 1.
    deviation: [f64; 3],
    /// Bound of the sums of the absolute derivatives by s and t of `alpha - s`, and of `beta - t`.
    shear: f64,
    /// Bounds of the absolute derivatives of gamma by s and by t.
    slope: [f64; 2],
}

impl FlatPart {
    /// The bounds for the part over `domain` with this net of its own.
    pub(super) fn new(net: &ControlNet, domain: Domain) -> Self {
        let [[p00, .., p03], _, _, [p30, .., p33]] = net.points;
        let (a, b) = (0.25 * ((p33 - p00) + (p30 - p03)), 0.25 * ((p33 - p00) - (p30 - p03)));
        let normal = a.cross(b);
        let flat = Self {
            domain,
            center: 0.25 * ((p00 + p33) + (p03 + p30)),
            axes: [DVec3::ZERO, DVec3::ZERO, DVec3::Z],
            deviation: [f64::INFINITY; 3],
            shear: f64::INFINITY,
            slope: [f64::INFINITY; 2],
        };
        if normal.length() <= 1e-9 * a.length() * b.length() || normal.length() < 1e-12 {
            return flat;
        }
        let normal = normal.normalize();
        let (across_b, across_a) = (b.cross(normal), normal.cross(a));
        let axes = [across_b / across_b.dot(a), across_a / across_a.dot(b), normal].map(rounded);
        Self { axes, ..flat }.bounded(net, [a, b, normal])
    }

    /// Moves the center to where the deviations are smallest, then bounds them by the control points.
    fn bounded(mut self, net: &ControlNet, basis: [DVec3; 3]) -> Self {
        for (axis, direction) in basis.into_iter().enumerate() {
            let (low, high) = self.deviations(net, axis);
            self.center += 0.5 * (low + high) * direction;
        }
        self.center = rounded(self.center);
        for axis in 0..3 {
            let (low, high) = self.deviations(net, axis);
            self.deviation[axis] = high.max(-low) + ROUNDING * self.axes[axis].length();
        }
        let [[alpha_s, alpha_t], [beta_s, beta_t], slope] = [0, 1, 2].map(|axis| self.largest_derivatives(net, axis));
        self.shear = (alpha_s + alpha_t).max(beta_s + beta_t) + SLOPE_ROUNDING;
        self.slope = slope.map(|x| x + SLOPE_ROUNDING);
        self
    }

    fn coordinate(&self, p: DVec3, axis: usize) -> f64 {
        self.axes[axis].dot(p - self.center)
    }

    /// The range of alpha - s, beta - t or gamma over the control points. Their parameters are those of the affine map
    /// in Bezier form.
    fn deviations(&self, net: &ControlNet, axis: usize) -> (f64, f64) {
        let mut range = (f64::INFINITY, f64::NEG_INFINITY);
        for (k, p) in net.points.iter().flatten().enumerate() {
            let parameter = [k / 4, k % 4].get(axis).map_or(0.0, |&i| 2.0 / 3.0 * i as f64 - 1.0);
            let deviation = self.coordinate(*p, axis) - parameter;
            range = (range.0.min(deviation), range.1.max(deviation));
        }
        range
    }

    /// Bounds of the absolute derivatives by s and by t of the deviation.
    fn largest_derivatives(&self, net: &ControlNet, axis: usize) -> [f64; 2] {
        let (mut by_s, mut by_t) = (0f64, 0f64);
        let expected = [f64::from(axis == 0), f64::from(axis == 1)];
        for i in 0..3 {
            for j in 0..4 {
                let along_s = net.points[i + 1][j] - net.points[i][j];
                let along_t = net.points[j][i + 1] - net.points[j][i];
                by_s = by_s.max((1.5 * self.axes[axis].dot(along_s) - expected[0]).abs());
                by_t = by_t.max((1.5 * self.axes[axis].dot(along_t) - expected[1]).abs());
            }
        }
        [by_s, by_t]
    }

    /// How far the part is from flat: about the angle by which its tangents turn, or what corresponds to it within the
    /// plane. Infinite for a part without a plane.
    pub(super) fn curvature(&self) -> f64 {
        let [along_s, along_t, _] = self.axes.map(DVec3::length);
        self.shear + self.slope[0] * along_s + self.slope[1] * along_t
    }
}

/// The vector with its coordinates rounded to `f32`. What is bounded afterwards holds for the rounded values.
fn rounded(p: DVec3) -> DVec3 {
    p.as_vec3().as_dvec3()
}

/// Four flat parts, side by side for vector instructions.
#[derive(Clone, Debug)]
pub(super) struct FlatParts {
    center: [f32x4; 3],
    axes: [[f32x4; 3]; 3],
    deviation: [f32x4; 3],
    shear: f32x4,
    slope: [f32x4; 2],
    domains: [[f32; 4]; 4],
    /// Bit k is set where there is a part.
    occupied: u32,
}

/// What the test of four parts leaves to do.
pub(super) struct Candidates {
    /// Bit k is set if the ray may meet part k.
    pub(super) mask: u32,
    /// Lower bound of z.
    pub(super) near: [f32; 4],
    /// Whether the ray meets the part once at most: bit k.
    pub(super) unique: u32,
    /// Bound of the nonlinearity of the equations, see [`super::newton::solve`].
    pub(super) nonlinearity: [f32; 4],
    /// Where the ray meets the mean plane.
    pub(super) start: [[f32; 4]; 2],
}

impl FlatParts {
    /// Up to four parts; the rest of the places stay empty.
    pub(super) fn new(parts: &[FlatPart]) -> Self {
        debug_assert!((1..=4).contains(&parts.len()), "one to four parts");
        let lanes = |f: &dyn Fn(&FlatPart) -> f64| {
            f32x4::from(std::array::from_fn::<f32, 4, _>(|k| parts.get(k).map_or(0.0, |part| f(part) as f32)))
        };
        let domain = |f: fn(&Domain) -> f64| std::array::from_fn(|k| parts.get(k).map_or(0.0, |p| f(&p.domain) as f32));
        Self {
            center: [0, 1, 2].map(|k| lanes(&|p| p.center[k])),
            axes: [0, 1, 2].map(|a| [0, 1, 2].map(|k| lanes(&|p| p.axes[a][k]))),
            deviation: [0, 1, 2].map(|a| lanes(&|p| p.deviation[a] * (1.0 + 1e-6))),
            shear: lanes(&|p| p.shear),
            slope: [0, 1].map(|a| lanes(&|p| p.slope[a])),
            domains: [domain(|d| d.x), domain(|d| d.y), domain(|d| d.half_x), domain(|d| d.half_y)],
            occupied: (1 << parts.len()) - 1,
        }
    }

    /// Part k of the parameter square.
    pub(super) fn domain(&self, k: usize) -> Domain {
        let [x, y, half_x, half_y] = self.domains.map(|d| f64::from(d[k]));
        Domain { x, y, half_x, half_y }
    }

    /// Intersects the ray with the boxes.
    ///
    /// In part k the equations read `s + O(deviation) = alpha + gamma d_alpha / d_gamma`
    /// with gamma of either sign below its bound, and so for t.
    ///
    /// At most one root: let two roots differ by D in (s, t) and by g in gamma, and let p be the drift of (alpha, beta)
    /// per unit of gamma along the ray. Then `D = p g` but for the shear e, so `|D| <= |p|_max |g| / (1 - e)`; and with
    /// the slopes G of gamma `|g| <= G_s |D_s| + G_t |D_t| <= (G_s |p_s| + G_t |p_t| + (G_s + G_t) |p|_max e / (1 - e)) |g|`.
    /// If the sum is below 1, then g and D are zero.
    #[inline(always)]
    pub(super) fn test(&self, ray: &FlatRay) -> Candidates {
        let from_center: [f32x4; 3] = std::array::from_fn(|k| ray.origin[k] - self.center[k]);
        let dot = |axis: &[f32x4; 3], v: &[f32x4; 3]| axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
        let speed: [f32x4; 3] = std::array::from_fn(|a| dot(&self.axes[a], &ray.direction));
        let inverse = f32x4::ONE / speed[2];
        let z = -dot(&self.axes[2], &from_center) * inverse;
        let reach = (inverse * self.deviation[2]).abs();
        let start = [0, 1].map(|a| dot(&self.axes[a], &from_center) + z * speed[a]);
        let width = [0, 1].map(|a| speed[a].abs() * reach + self.deviation[a] + f32x4::ONE);
        // Written so that a NaN, from a ray within the plane, keeps the part.
        let outside = start[0].abs().simd_ge(width[0])
            | start[1].abs().simd_ge(width[1])
            | (z - reach).simd_ge(ray.z_max)
            | (z + reach).simd_le(ray.z_min);
        let drift = [0, 1].map(|a| (speed[a] * inverse).abs());
        let drift_max = drift[0].fast_max(drift[1]);
        let steepness = drift_max * (self.slope[0] + self.slope[1]);
        let fold =
            drift[0] * self.slope[0] + drift[1] * self.slope[1] + steepness * self.shear / (f32x4::ONE - self.shear);
        Candidates {
            mask: !outside.to_bitmask() & self.occupied,
            near: (z - reach).to_array(),
            unique: (fold.simd_lt(f32x4::ONE) & self.shear.simd_lt(f32x4::ONE)).to_bitmask(),
            nonlinearity: (self.shear + steepness).to_array(),
            start: start.map(f32x4::to_array),
        }
    }
}

/// A ray in unit space, ready for tests of four boxes at once.
pub(super) struct FlatRay {
    pub(super) origin: [f32x4; 3],
    direction: [f32x4; 3],
    pub(super) inverse: [f32x4; 3],
    pub(super) z_min: f32x4,
    pub(super) z_max: f32x4,
}

impl FlatRay {
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
