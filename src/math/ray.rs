use glam::DVec3;

/// A half line, or a part of one: the points `origin + t * direction` with `t_min < t < t_max`.
///
/// `direction` need not have unit length; `t` counts in units of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where `t` is zero.
    pub origin: DVec3,
    /// Any finite vector but zero.
    pub direction: DVec3,
    /// Hits at `t <= t_min` do not count.
    pub t_min: f64,
    /// Hits at `t >= t_max` do not count.
    pub t_max: f64,
}

impl Ray {
    /// The ray from `origin` without an end.
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, t_min: 0.0, t_max: f64::INFINITY }
    }

    /// The open segment between two points: `t` is 0 at `from` and 1 at `to`.
    pub fn between(from: DVec3, to: DVec3) -> Self {
        Self { origin: from, direction: to - from, t_min: 0.0, t_max: 1.0 }
    }

    /// The point at `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }
}
