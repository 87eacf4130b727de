//! Cones of places in a chart.

use super::small_targets::{Place, Target};
use glam::DVec3;

/// A cone of directions, or a disc in the plane of parallel rays: the places of a [`Chart`](super::chart::Chart) up to a distance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    /// The unit axis; the middle of the disc.
    pub(super) middle: Place,
    /// Half the angle, radians; radius of the disc in units of the chart.
    pub(super) radius: f64,
}

impl Cone {
    /// The cone in which a ball appears at this offset; `None` from inside of it.
    pub(super) fn around(offset: DVec3, radius: f64) -> Option<Self> {
        let sine = radius / offset.length();
        (sine < 1.0).then(|| Self { middle: offset.normalize(), radius: sine.asin() })
    }

    /// The solid angle over that of the sphere; of a small disc, its area over that of the chart.
    pub(super) fn fraction_of_chart(&self) -> f64 {
        (0.5 * self.radius).sin().powi(2)
    }

    /// The cone as a target without paths yet.
    pub(super) fn target(&self) -> Target {
        Target { middle: self.middle, radius: self.radius, path_fraction: 0.0 }
    }
}
