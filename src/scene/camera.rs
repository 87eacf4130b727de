use glam::DVec3;

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The position of the pinhole, scene units.
    pub position: DVec3,
    /// The point that appears in the center of the image, scene units.
    pub target: DVec3,
    /// The direction that points up in the image; any length but 0.
    pub up: DVec3,
    /// The full vertical field of view, degrees, above 0 and below 180.
    pub fov_y: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self { position: DVec3::new(0.0, 0.0, 3.8), target: DVec3::ZERO, up: DVec3::Y, fov_y: 40.0 }
    }
}
