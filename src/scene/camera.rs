use glam::DVec3;

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The pinhole, scene units.
    pub position: DVec3,
    /// The point in the middle of the picture.
    pub target: DVec3,
    /// Points upwards in the picture.
    pub up: DVec3,
    /// The whole vertical angle of view, degrees, between 0 and 180.
    pub fov_y: f64,
}

impl Default for Camera {
    fn default() -> Self {
        Self { position: DVec3::new(0.0, 0.0, 3.8), target: DVec3::ZERO, up: DVec3::Y, fov_y: 40.0 }
    }
}
