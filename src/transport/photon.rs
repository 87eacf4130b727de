use crate::math::Rgb;
use glam::Vec3;

/// Light that arrived at a point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Photon {
    /// Relative to the middle of the world, which keeps 24 bits of precision inside the scene.
    pub position: Vec3,
    /// W.
    pub flux: Rgb,
    /// Towards where it came from, unit length.
    pub wi: Vec3,
    /// Between `wi` and the surface's normal there; positive.
    pub cos: f32,
    /// Surface, side and scattering events so far: see [`tag`].
    pub tag: u32,
}

/// Scattering events that a tag can tell apart.
pub(super) const MAX_TAG_BOUNCES: u32 = 255;

/// A number that orders photons first by surface and side, then by their scattering events since the light.
pub(super) fn tag(object: u32, front: bool, bounces: u32) -> u32 {
    (object << 1 | u32::from(front)) << 8 | bounces.min(MAX_TAG_BOUNCES)
}
