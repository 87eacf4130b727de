use crate::math::Rgb;

/// What light transport is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Render {
    /// Scattering events between light and eye on the longest path; 1 is direct light alone.
    pub max_bounces: u32,
    /// Radiance of what a ray sees when it leaves the scene.
    pub background: Rgb,
}

impl Default for Render {
    fn default() -> Self {
        Self { max_bounces: 16, background: Rgb::ZERO }
    }
}
