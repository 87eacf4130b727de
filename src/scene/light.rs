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
    /// A source so far away that its rays come from everywhere outside the scene. No ray sees it.
    Sun {
        /// The direction in which its light travels, of any length.
        direction: DVec3,
        /// Irradiance of a plane across the direction, above the scene, W/m^2.
        irradiance: Rgb,
        /// The angle under which the disc of the sun appears, degrees; 0 for parallel rays.
        diameter: f64,
    },
    /// Parallel rays that leave a disc. No ray sees it.
    Beam {
        /// The center of the disc, scene units.
        center: DVec3,
        /// The direction of the rays, of any length.
        direction: DVec3,
        /// The radius of the disc, scene units, above 0.
        radius: f64,
        /// Power, W, even over the disc.
        power: Rgb,
    },
}

impl Emitter {
    /// The angle under which the sun appears from the earth, degrees.
    pub const SUN_DIAMETER: f64 = 0.53;
    /// The greatest diameter of a sun, degrees: a wider one lights as a sky does.
    pub const MOST_DIAMETER: f64 = 90.0;
}
