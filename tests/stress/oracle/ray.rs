use glam::DVec3;

/// Least distance of a hit, and distance within which surfaces are one interface: scenes of the oracle are some units wide.
pub(super) const NEAR: f64 = 1e-6;

/// A ray with a unit direction.
#[derive(Clone, Copy)]
pub(super) struct Ray {
    pub(super) origin: DVec3,
    pub(super) direction: DVec3,
}

impl Ray {
    /// The point at this distance.
    pub(super) fn at(&self, distance: f64) -> DVec3 {
        self.origin + distance * self.direction
    }
}

/// A point where a ray meets a surface.
#[derive(Clone, Copy)]
pub(super) struct Hit {
    pub(super) distance: f64,
    /// Unit normal of the front.
    pub(super) normal: DVec3,
    /// Index of the surface.
    pub(super) surface: usize,
}
