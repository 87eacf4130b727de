use crate::math::Rgb;
use glam::DVec3;

/// A source of light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Unique among lights.
    pub name: String,
    /// Its form and strength.
    pub emitter: Emitter,
}

/// The kinds of light sources.
#[derive(Clone, Debug, PartialEq)]
pub enum Emitter {
    /// An invisible point.
    Point {
        /// Scene units.
        position: DVec3,
        /// W/sr.
        intensity: Rgb,
    },
    /// A sphere that shines outwards.
    Sphere {
        /// Scene units.
        center: DVec3,
        /// Scene units, above 0.
        radius: f64,
        /// W/(sr m^2).
        radiance: Rgb,
    },
    /// A parallelogram that shines to the side of `edge_u x edge_v`.
    Quad {
        /// Scene units.
        corner: DVec3,
        /// Scene units.
        edge_u: DVec3,
        /// Scene units.
        edge_v: DVec3,
        /// W/(sr m^2).
        radiance: Rgb,
    },
}
