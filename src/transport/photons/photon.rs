use crate::math::Rgb;
use crate::transport::points::Vertex;
use crate::world::World;
use glam::Vec3;

/// Flux that arrived at a point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Photon {
    /// Position relative to [`View::origin`](crate::world::View::origin), about which `f32` has 24 bits for what the camera sees.
    pub position: Vec3,
    /// Flux, W.
    pub flux: Rgb,
    /// Unit direction towards where the photon came from.
    pub wi: Vec3,
    /// Cosine between `wi` and the surface's normal; positive.
    pub cos: f32,
    /// Side of a sheet and number of scattering events so far, in one sortable number.
    pub tag: u32,
}

impl Photon {
    /// The photon that a light path leaves at a vertex after `bounces` scattering events.
    #[inline]
    pub(in crate::transport) fn arrived(world: &World, vertex: &Vertex, flux: Rgb, bounces: u32) -> Self {
        Self {
            position: (vertex.point.position - world.view.origin).as_vec3(),
            flux,
            wi: vertex.wo.as_vec3(),
            // Rounding must not make it 0: density estimates divide by it.
            cos: (vertex.wo.dot(vertex.n_side) as f32).max(f32::MIN_POSITIVE),
            tag: tag(vertex.side, bounces),
        }
    }
}

/// Greatest number of scattering events that a tag holds.
pub(in crate::transport) const MAX_TAG_BOUNCES: u32 = 255;

/// A number that orders photons by the side of a sheet that they arrived at ([`Vertex::side`]), then by scattering events since the light.
#[inline]
pub(in crate::transport) fn tag(side: u32, bounces: u32) -> u32 {
    side << 8 | bounces.min(MAX_TAG_BOUNCES)
}
