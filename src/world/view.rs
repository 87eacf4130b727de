use crate::geometry::Sphere;
use glam::DVec3;

/// Where the surfaces are that the camera sees, directly, in mirrors or through glass: medians over a few probe rays, so that a small or
/// far object in the picture does not move them. Surfaces that scatter light from the lamps count, others only if the
/// camera sees none that do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    /// Origin of positions in `f32`, scene units: of the box around what the camera sees, the point nearest to the camera. No point of the
    /// box is farther from it than from the camera, so that the rounding of a position stays a small fraction of the pixel's footprint.
    pub origin: DVec3,
    /// Median position of the surfaces, by coordinate, scene units.
    pub center: DVec3,
    /// Median length of the paths from the camera to the surfaces, scene units; above 0.
    pub distance: f64,
    /// Half the diagonal of the part of the film that shows the surfaces, over its distance from the camera.
    pub spread: f64,
    /// Size of the region around the surfaces, over `distance`: `spread`, or the median free path of light between the surfaces if that is
    /// more, as where the camera looks at a detail.
    pub region: f64,
    /// Ball around most of the points where mirrors and glass may send light to the surfaces; `None` if the probe rays found none.
    pub specular: Option<Sphere>,
}

impl View {
    /// Half the diagonal of what the film shows at the median distance, scene units.
    pub fn radius(&self) -> f64 {
        self.spread * self.distance
    }
}
