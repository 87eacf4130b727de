use super::{ParallelRays, Precision};
use crate::geometry::{Quad, Sphere};
use crate::math::Rgb;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Distance of test points from the surface of a light over rounding: beyond what rounding does not tell apart.
const OFF_SURFACE: f64 = 2.0;

/// A source of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// An invisible point with the same intensity in all directions.
    Point {
        /// Its position, in scene units.
        position: DVec3,
        /// Radiant intensity, W/sr.
        intensity: Rgb,
    },
    /// A sphere that emits outwards, with the same radiance in all directions.
    Sphere {
        /// Its surface.
        sphere: Sphere,
        /// Radiance, W/(sr m^2).
        radiance: Rgb,
    },
    /// A parallelogram that emits to the side of its normal, with the same radiance in all directions.
    Quad {
        /// Its surface.
        quad: Quad,
        /// Radiance, W/(sr m^2).
        radiance: Rgb,
    },
    /// A sun or a beam. No ray sees it.
    Parallel(ParallelRays),
}

impl Light {
    /// The total emitted power, W; of a sun, the power through its disc.
    pub fn power(&self) -> Rgb {
        match self {
            Self::Point { intensity, .. } => *intensity * (4.0 * PI) as f32,
            Self::Sphere { sphere, radiance } => *radiance * (PI * 4.0 * PI * sphere.radius * sphere.radius) as f32,
            Self::Quad { quad, radiance } => *radiance * (PI * quad.area()) as f32,
            Self::Parallel(rays) => rays.power(),
        }
    }

    /// Whether the light comes from outside the scene.
    pub(super) fn is_outside(&self) -> bool {
        matches!(self, Self::Parallel(ParallelRays { from_outside: true, .. }))
    }

    /// The center of the light; of a sun, of its disc.
    #[inline]
    pub fn center(&self) -> DVec3 {
        match self {
            Self::Point { position, .. } => *position,
            Self::Sphere { sphere, .. } => sphere.center,
            Self::Quad { quad, .. } => quad.position(0.5, 0.5),
            Self::Parallel(rays) => rays.center,
        }
    }

    /// The radius of a ball around the center that holds the light, in scene units.
    #[inline]
    pub fn bounding_radius(&self) -> f64 {
        match self {
            Self::Point { .. } => 0.0,
            Self::Sphere { sphere, .. } => sphere.radius,
            Self::Quad { quad, .. } => 0.5 * (quad.edges().0.length() + quad.edges().1.length()),
            Self::Parallel(rays) => rays.radius,
        }
    }

    /// The unit normal of an area light at a point of it: to the outside or the front. `None` for other lights.
    #[inline]
    pub fn normal(&self, point: DVec3) -> Option<DVec3> {
        match self {
            Self::Sphere { sphere, .. } => Some(sphere.normal(point)),
            Self::Quad { quad, .. } => Some(quad.normal()),
            Self::Point { .. } | Self::Parallel(_) => None,
        }
    }

    /// Points that tell in which bodies the light is, just off its surface: the center of a point light, some points of an area light or
    /// a beam. None for a sun, which is outside of everything. `precision` is that of the light's surface.
    pub(super) fn test_points(&self, precision: &Precision) -> Vec<DVec3> {
        let off_surface = |point, normal| point + OFF_SURFACE * precision.rounding(point, normal) * normal;
        match self {
            Self::Point { position, .. } => vec![*position],
            Self::Sphere { sphere, .. } => {
                let outward = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
                outward.map(|n| off_surface(sphere.center + sphere.radius * n, n)).collect()
            }
            Self::Quad { quad, .. } => {
                let inset = [(0.5, 0.5), (0.01, 0.01), (0.99, 0.01), (0.99, 0.99), (0.01, 0.99)];
                inset.map(|(u, v)| off_surface(quad.position(u, v), quad.normal())).to_vec()
            }
            Self::Parallel(_) if self.is_outside() => Vec::new(),
            Self::Parallel(rays) => {
                let inset = [DVec2::ZERO, DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y];
                inset.map(|point| rays.point(0.99 * point)).to_vec()
            }
        }
    }

    /// The radiance towards `direction` from a point of an area light with this outward or front normal.
    pub fn emitted(&self, n_geom: DVec3, direction: DVec3) -> Rgb {
        match self {
            Self::Sphere { radiance, .. } | Self::Quad { radiance, .. } if n_geom.dot(direction) > 0.0 => *radiance,
            _ => Rgb::ZERO,
        }
    }
}
