use crate::geometry::bezier::ControlNet;
use glam::DVec3;
use std::sync::Arc;

/// Bicubic Bezier patches that move together.
#[derive(Clone, Debug, PartialEq)]
pub struct Bezier {
    /// Where the patches are put.
    pub transform: Transform,
    /// The control points before the transform; shared, so that a clone costs nothing.
    pub patches: Arc<Vec<ControlNet>>,
    /// The `.bpt` file that holds exactly these patches, relative to the scene file; `None`: written in the scene.
    pub file: Option<String>,
}

/// Scale, then rotate about x, y, z in turn, then translate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Scene units.
    pub translate: DVec3,
    /// Degrees about x, y and z.
    pub rotate: DVec3,
    /// Factors along x, y and z, none of them 0.
    pub scale: DVec3,
}

impl Default for Transform {
    fn default() -> Self {
        Self { translate: DVec3::ZERO, rotate: DVec3::ZERO, scale: DVec3::ONE }
    }
}
