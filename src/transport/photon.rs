use crate::math::Rgb;
use crate::world::{SurfacePoint, World};
use glam::{DVec3, Vec3};

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

impl Photon {
    /// Flux that reached a point of an object from the direction `wi` after so many scattering events.
    pub(super) fn arrived(
        world: &World,
        point: &SurfacePoint,
        object: u32,
        wi: DVec3,
        flux: Rgb,
        bounces: u32,
    ) -> Self {
        Self {
            position: (point.position - world.center).as_vec3(),
            flux,
            wi: wi.as_vec3(),
            // Not 0 by rounding: it is divided by.
            cos: (wi.dot(point.n_side()) as f32).max(f32::MIN_POSITIVE),
            tag: tag(object, point.front, bounces),
        }
    }
}

/// Scattering events that a tag can tell apart.
pub(super) const MAX_TAG_BOUNCES: u32 = 255;

/// A number that orders photons first by surface and side, then by their scattering events since the light.
pub(super) fn tag(object: u32, front: bool, bounces: u32) -> u32 {
    (object << 1 | u32::from(front)) << 8 | bounces.min(MAX_TAG_BOUNCES)
}
