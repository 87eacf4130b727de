use super::space::UnitRay;
use crate::math::lanes::{LANES, Lanes};
use glam::Vec3;

/// Bound of the rounding of a point in unit space in `f32`, per unit of length involved: coordinates are below 1, and a dot
/// product rounds five times, each by at most 6e-8.
pub(crate) const ROUNDING: f64 = 4e-6;

/// One ray in unit space in all lanes, or a packet with a ray in each lane, rounded to `f32` for the tests of boxes and
/// subpatches.
pub(crate) struct LaneRays<L: Lanes> {
    pub(crate) origin: [L::Vector; 3],
    pub(crate) direction: [L::Vector; 3],
    /// 1 over `direction`, finite.
    pub(crate) inverse: [L::Vector; 3],
    /// Rounded down.
    pub(crate) z_min: L::Vector,
    /// Rounded up.
    pub(crate) z_max: L::Vector,
}

impl<L: Lanes> LaneRays<L> {
    /// One ray in all lanes.
    #[inline(always)]
    pub(crate) fn splat(l: L, ray: &UnitRay) -> Self {
        let direction = ray.direction.as_vec3();
        Self {
            origin: l.splat3(ray.origin.as_vec3().to_array()),
            direction: l.splat3(direction.to_array()),
            inverse: l.splat3(inverse(direction).to_array()),
            z_min: l.splat(rounded_z_min(ray)),
            z_max: l.splat(rounded_z_max(ray)),
        }
    }

    /// A ray in each lane.
    #[inline(always)]
    pub(crate) fn packet(l: L, rays: &[UnitRay; LANES]) -> Self {
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
            (z_min[k], z_max[k]) = (rounded_z_min(ray), rounded_z_max(ray));
        }
        Self {
            origin: l.load3(&origin),
            direction: l.load3(&direction),
            inverse: l.load3(&inverses),
            z_min: l.load(&z_min),
            z_max: l.load(&z_max),
        }
    }

    /// Lowers `z_max` of all lanes to `z_max` of the one ray.
    #[inline(always)]
    pub(crate) fn shorten(&mut self, l: L, ray: &UnitRay) {
        self.z_max = l.splat(rounded_z_max(ray));
    }

    /// Sets `z_max` of each lane.
    #[inline(always)]
    pub(crate) fn set_z_max(&mut self, l: L, z_max: &[f32; LANES]) {
        self.z_max = l.load(z_max);
    }
}

/// 1 over the direction; zeros are replaced, so that the slab test of a box meets no NaN.
#[inline(always)]
fn inverse(direction: Vec3) -> Vec3 {
    direction.signum() / direction.abs().max(Vec3::splat(1e-20))
}

/// `z_min` of the ray, rounded down.
#[inline(always)]
fn rounded_z_min(ray: &UnitRay) -> f32 {
    ray.z_min as f32 - ROUNDING as f32
}

/// `z_max` of the ray, rounded up.
#[inline(always)]
pub(crate) fn rounded_z_max(ray: &UnitRay) -> f32 {
    ray.z_max as f32 + ROUNDING as f32
}
