use crate::math::Rgb;
use glam::DVec3;

/// A source of light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// The name, unique among lights.
    pub name: String,
    /// Shape and strength.
    pub emitter: Emitter,
}

/// The shape and the strength of a light source.
#[derive(Clone, Debug, PartialEq)]
pub enum Emitter {
    /// An invisible point with the same intensity in all directions.
    Point {
        /// The position, scene units.
        position: DVec3,
        /// Radiant intensity, W/sr.
        intensity: Rgb,
    },
    /// A sphere that emits outwards.
    Sphere {
        /// The center, scene units.
        center: DVec3,
        /// The radius, scene units, above 0.
        radius: f64,
        /// Radiance, W/(sr m^2).
        radiance: Rgb,
    },
    /// A parallelogram that emits to the side of `edge_u x edge_v`.
    Quad {
        /// The corner at (u, v) = (0, 0), scene units.
        corner: DVec3,
        /// The edge along u, scene units.
        edge_u: DVec3,
        /// The edge along v, scene units.
        edge_v: DVec3,
        /// Radiance, W/(sr m^2).
        radiance: Rgb,
    },
}
