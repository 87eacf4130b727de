use glam::DVec3;

/// The points `origin + t * direction` with `t_min < t < t_max`. The direction may have any length; t is in units of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The point at t = 0, in scene units.
    pub origin: DVec3,
    /// A finite vector other than zero.
    pub direction: DVec3,
    /// Hits have `t > t_min`.
    pub t_min: f64,
    /// Hits have `t < t_max`.
    pub t_max: f64,
}

impl Ray {
    /// The half line from `origin`: t from 0 to infinity.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, t_min: 0.0, t_max: f64::INFINITY }
    }

    /// The segment between two points, without its ends: t is 0 at `from` and 1 at `to`.
    pub fn between(from: DVec3, to: DVec3) -> Self {
        Self { origin: from, direction: to - from, t_min: 0.0, t_max: 1.0 }
    }

    /// The point at t.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }
}
