use crate::math::float::rounding;
use glam::DVec3;

/// How well the points of a surface are known.
#[derive(Clone, Copy, Debug)]
pub struct Precision {
    /// The [magnitude](crate::geometry::Primitive::magnitude), scene units.
    pub(super) magnitude: DVec3,
    /// Least rounding in any direction, scene units: surfaces that touch it are one with it at this distance; 0 without contact.
    pub(super) contact: f64,
}

impl Precision {
    /// How far rounding may move the surface, and the surfaces that touch it, at a point along the unit normal there, scene units.
    #[inline]
    pub fn rounding(&self, point: DVec3, normal: DVec3) -> f64 {
        // Points of a plane lie far beyond the point that defines it.
        rounding(self.magnitude.max(point.abs()), normal).max(self.contact)
    }
}
