//! What a pixel or a block of pixels shows, and how alike two of them are.

use crate::transport::SeenSurface;
use glam::Vec3;

/// Power of the cosine between two normals, as repeated squaring: 2^5 = 32. Half of the weight is left at 12 degrees.
const NORMAL_SQUARINGS: u32 = 5;
/// Distance of a point from the tangent plane of another one, over the distance between their pixels, from which on the weight falls below a
/// half.
const OFF_PLANE: f32 = 0.25;

/// What a pixel or a block of pixels shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guide {
    pub(super) position: Vec3,
    pub(super) normal: Vec3,
    /// Side of a pixel on the surface, scene units.
    pub(super) footprint: f32,
    /// Equal for points of one surface that are seen in the same way.
    pub(super) surface: u32,
}

impl Guide {
    /// Nothing to filter.
    pub(super) const NONE: Self = Self { position: Vec3::ZERO, normal: Vec3::ZERO, footprint: 0.0, surface: u32::MAX };

    /// The guide of a pixel.
    pub(super) fn new(seen: Option<SeenSurface>) -> Self {
        let of_surface = |SeenSurface { position, normal, footprint, tag, seen_directly }| {
            // The lowest bits of a tag count scattering events, which points have none of.
            Self { position, normal, footprint, surface: tag | u32::from(!seen_directly) }
        };
        seen.map_or(Self::NONE, of_surface)
    }

    /// The distance from the tangent plane at which half of the weight is left for points this many pixels away; its inverse.
    #[inline]
    pub(super) fn flatness(&self, pixels: f32) -> f32 {
        1.0 / (OFF_PLANE * self.footprint * pixels)
    }

    /// How alike the light at two points can be expected to be, from 0 to 1: 0 on different surfaces, less for different normals and where
    /// one point lies off the tangent plane of the other, given the [`Self::flatness`] for the distance between their pixels.
    #[inline]
    pub(super) fn likeness(&self, other: &Self, flatness: f32) -> f32 {
        if self.surface != other.surface {
            return 0.0;
        }
        let mut by_normal = self.normal.dot(other.normal).max(0.0);
        for _ in 0..NORMAL_SQUARINGS {
            by_normal *= by_normal;
        }
        let off_plane = self.normal.dot(other.position - self.position) * flatness;
        by_normal / (1.0 + off_plane * off_plane)
    }
}
