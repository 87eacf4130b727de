use crate::math::Ray;
use glam::DVec3;

/// The map from scene space to the unit space of a patch: the middle of its box at the origin, the diagonal of its box
/// between 1/2 and 1. There, constants mean the same for every patch, and a patch far from the world's origin keeps
/// all its digits.
#[derive(Clone, Copy, Debug)]
pub(super) struct UnitMap {
    center: DVec3,
    /// A power of two: scaling rounds nothing.
    scale: f64,
}

impl UnitMap {
    /// The map for a patch whose box has this middle and this diagonal.
    pub(super) fn new(center: DVec3, diagonal: f64) -> Self {
        let exponent = if diagonal > 0.0 { (diagonal.log2().ceil() as i32).clamp(-1000, 1000) } else { 0 };
        Self { center, scale: 2f64.powi(-exponent) }
    }

    /// Unit space over scene space.
    pub(super) fn scale(&self) -> f64 {
        self.scale
    }

    /// A point of scene space in unit space.
    pub(super) fn point(&self, p: DVec3) -> DVec3 {
        (p - self.center) * self.scale
    }

    /// A ray in unit space; none if it passes the patch by, or has no direction.
    pub(super) fn ray(&self, ray: &Ray) -> Option<UnitRay> {
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
        // The patch lies in the ball of radius 1/2. Written so that a NaN is a miss.
        (origin.length_squared() <= 0.2501 && unit.z_min <= unit.z_max).then_some(unit)
    }
}

/// A ray in unit space, given by its point nearest to the middle of the patch, so that a ray that starts far away costs
/// no digits near the patch. Points on it are at `origin + z * direction`.
#[derive(Clone, Copy, Debug)]
pub(super) struct UnitRay {
    /// The point at z = 0.
    pub(super) origin: DVec3,
    /// Unit length.
    pub(super) direction: DVec3,
    /// Lower end of what counts, not below -1: the patch lies well within `-1 < z < 1`.
    pub(super) z_min: f64,
    /// Upper end of what counts, not above 1; shrinks as hits are found.
    pub(super) z_max: f64,
    /// Unit lengths per unit of t.
    speed: f64,
    /// From the start of the scene ray to `origin`, in unit lengths.
    distance: f64,
    t_min: f64,
    t_max: f64,
}

impl UnitRay {
    /// A ray that meets nothing.
    pub(super) const NONE: Self = Self {
        origin: DVec3::ZERO,
        direction: DVec3::Z,
        z_min: 1.0,
        z_max: -1.0,
        speed: 1.0,
        distance: 0.0,
        t_min: 0.0,
        t_max: 0.0,
    };

    /// The parameter of the scene ray at z, if it counts.
    pub(super) fn t_in_range(&self, z: f64) -> Option<f64> {
        let t = (z + self.distance) / self.speed;
        (self.t_min < t && t < self.t_max).then_some(t)
    }
}
