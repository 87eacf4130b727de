//! The light that one camera path of a pixel finds in a Phong lobe.

use crate::math::Rgb;
use glam::Vec3;

/// A pixel's sample of the light in its Phong lobe.
#[derive(Clone, Copy, Debug)]
pub struct LobeSample {
    /// Radiance from photons at the points that the lobe shows, as the pixel sees it.
    pub radiance: Rgb,
    /// Position of the point with the lobe, relative to the middle of the world.
    pub(super) position: Vec3,
    /// Unit normal at the point.
    pub(super) normal: Vec3,
    /// First tag of the photons on the same surface and side.
    pub(super) tag: u32,
    /// Greatest distance of a neighbour, scene units.
    pub(super) reuse_distance: f32,
    /// `reuse_distance` in pixels, for a surface that faces the camera.
    pub(super) window: u32,
}
