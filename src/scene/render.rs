use crate::math::Rgb;

/// The limits of light transport.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Render {
    /// The greatest number of scattering events on a path between light and camera; 1 is direct light alone.
    pub max_bounces: u32,
    /// The radiance along rays that leave the scene.
    pub background: Rgb,
}

impl Default for Render {
    fn default() -> Self {
        Self { max_bounces: 16, background: Rgb::ZERO }
    }
}
