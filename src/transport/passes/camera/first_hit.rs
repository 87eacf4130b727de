//! What the first ray of a pixel meets.

use crate::geometry::Hit;
use crate::math::Ray;
use crate::transport::counters::Counters;
use crate::transport::photons::photon;
use crate::transport::points::{Facet, Vertex};
use crate::world::{Surface, World};

/// Where the first ray of a pixel ended.
#[derive(Clone, Copy, Debug)]
pub struct FirstHit {
    /// The length of the ray, scene units; infinite where it met nothing.
    pub depth: f32,
    /// Whether the surface looks the same from everywhere: it neither mirrors nor refracts, and has no Phong lobe.
    pub is_matte: bool,
    /// The object, by its place in the scene; `None` for a lamp, and where the ray met nothing.
    pub object: Option<u32>,
    /// The surface; `None` for a lamp, and where the ray met nothing.
    pub facet: Option<Facet>,
}

impl FirstHit {
    /// Nothing was met.
    pub(super) const NONE: Self = Self { depth: f32::INFINITY, is_matte: false, object: None, facet: None };

    /// A hit on a surface of the world, of which nothing more is known.
    pub(super) fn new(world: &World, hit: Hit) -> Self {
        let is_matte = !world.is_specular(hit.primitive) && !world.is_glossy(hit.primitive);
        Self { depth: hit.t as f32, is_matte, object: world.object_of(hit.primitive), facet: None }
    }

    /// The hit of a camera ray, with the surface's normal and albedo.
    pub(super) fn with_surface(world: &World, ray: &Ray, hit: Hit) -> Self {
        let met = world.on_opaque(ray, hit);
        let facet = match world.surfaces[met.primitive as usize] {
            Surface::Light(_) => None,
            Surface::Object { front_side, material, .. } => {
                let vertex = Vertex::at_hit(world, ray, met, [front_side, material], &mut Counters::default());
                Some(facet(world, &vertex))
            }
        };
        Self { facet, ..Self::new(world, hit) }
    }
}

/// The shading normal and the albedo at a vertex.
#[inline]
pub(super) fn facet(world: &World, vertex: &Vertex) -> Facet {
    Facet {
        normal: vertex.n_shade.as_vec3(),
        albedo: vertex.scattering.albedo,
        tag: photon::tag(vertex.side, 0),
        position: (vertex.point.position - world.view.origin).as_vec3(),
    }
}
