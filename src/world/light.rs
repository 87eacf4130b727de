use crate::geometry::{Quad, Sphere};
use crate::math::Rgb;
use glam::DVec3;
use std::f64::consts::PI;

/// A source of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// An invisible point with the same intensity (W/sr) everywhere.
    Point {
        /// Where it is.
        position: DVec3,
        /// W/sr.
        intensity: Rgb,
    },
    /// A Lambertian sphere that shines outwards.
    Sphere {
        /// Its surface.
        sphere: Sphere,
        /// W/(sr m^2).
        radiance: Rgb,
    },
    /// A Lambertian parallelogram that shines to the side of its normal.
    Quad {
        /// Its surface.
        quad: Quad,
        /// W/(sr m^2).
        radiance: Rgb,
    },
}

impl Light {
    /// All that it emits, W.
    pub fn power(&self) -> Rgb {
        match self {
            Self::Point { intensity, .. } => *intensity * (4.0 * PI) as f32,
            Self::Sphere { sphere, radiance } => *radiance * (PI * 4.0 * PI * sphere.radius * sphere.radius) as f32,
            Self::Quad { quad, radiance } => *radiance * (PI * quad.area()) as f32,
        }
    }

    /// Its middle.
    pub fn center(&self) -> DVec3 {
        match self {
            Self::Point { position, .. } => *position,
            Self::Sphere { sphere, .. } => sphere.center,
            Self::Quad { quad, .. } => quad.position(0.5, 0.5),
        }
    }

    /// Radius of a ball about the middle that holds all of it.
    pub fn reach(&self) -> f64 {
        match self {
            Self::Point { .. } => 0.0,
            Self::Sphere { sphere, .. } => sphere.radius,
            Self::Quad { quad, .. } => 0.5 * (quad.edges().0.length() + quad.edges().1.length()),
        }
    }

    /// Radiance towards `direction` from the surface of an area light with this outward or front normal.
    pub fn emitted(&self, n_geom: DVec3, direction: DVec3) -> Rgb {
        match self {
            Self::Sphere { radiance, .. } | Self::Quad { radiance, .. } if n_geom.dot(direction) > 0.0 => *radiance,
            _ => Rgb::ZERO,
        }
    }
}
