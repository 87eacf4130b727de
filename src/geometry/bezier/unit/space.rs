use crate::math::Ray;
use glam::DVec3;

/// The map from scene space to the unit space of a patch, where the center of the patch's box is the origin and the box's
/// diagonal is between 1/2 and 1. Tolerances in unit space suit every patch, and a patch far from the world's origin loses
/// no digits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitMap {
    center: DVec3,
    /// A power of two, by which scaling is exact.
    scale: f64,
}

impl UnitMap {
    /// The map for a patch whose box has this center and this length of its diagonal, in scene units.
    pub(crate) fn new(center: DVec3, diagonal: f64) -> Self {
        let exponent = if diagonal > 0.0 { (diagonal.log2().ceil() as i32).clamp(-1000, 1000) } else { 0 };
        Self { center, scale: 2f64.powi(-exponent) }
    }

    /// Unit lengths per scene unit.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// Maps a point from scene space to unit space.
    pub(crate) fn point(&self, p: DVec3) -> DVec3 {
        (p - self.center) * self.scale
    }

    /// Maps a ray to unit space. `None` where it misses the ball around the patch, or has no direction.
    pub(crate) fn ray(&self, ray: &Ray) -> Option<UnitRay> {
        let direction = ray.direction * self.scale;
        let speed = direction.length();
        let direction = direction / speed;
        let from_center = self.point(ray.origin);
        let distance = -from_center.dot(direction);
        let origin = from_center + distance * direction;
        let z = |t: f64| t * speed - distance;
        let unit = UnitRay {
            origin,
            direction,
            z_min: z(ray.t_min).max(-1.0),
            z_max: z(ray.t_max).min(1.0),
            speed,
            distance,
            t_min: ray.t_min,
            t_max: ray.t_max,
        };
        // The patch lies in the ball of radius 1/2. The comparisons are false for NaN, which is a miss.
        (origin.length_squared() <= 0.2501 && unit.z_min <= unit.z_max).then_some(unit)
    }
}

/// A ray in unit space: the points `origin + z * direction`. Its origin is the point nearest to the center of the patch, so
/// that a ray that starts far away loses no digits near the patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitRay {
    /// The point at z = 0.
    pub(crate) origin: DVec3,
    /// Unit length.
    pub(crate) direction: DVec3,
    /// Roots below this are no hits. At least -1: the patch lies within `-1 < z < 1`.
    pub(crate) z_min: f64,
    /// Roots above this are no hits. At most 1; shrinks to the nearest hit so far.
    pub(crate) z_max: f64,
    /// Unit lengths per unit of t.
    speed: f64,
    /// From the origin of the scene ray to `origin`, in unit lengths.
    distance: f64,
    t_min: f64,
    t_max: f64,
}

impl UnitRay {
    /// A ray that misses every patch.
    pub(crate) const MISS: Self = Self {
        origin: DVec3::ZERO,
        direction: DVec3::Z,
        z_min: 1.0,
        z_max: -1.0,
        speed: 1.0,
        distance: 0.0,
        t_min: 0.0,
        t_max: 0.0,
    };

    /// The parameter t of the scene ray at z; `None` outside `t_min < t < t_max`.
    pub(crate) fn t_in_range(&self, z: f64) -> Option<f64> {
        let t = (z + self.distance) / self.speed;
        (self.t_min < t && t < self.t_max).then_some(t)
    }
}
