//! The state of light that only mirrors and glass have touched.

use super::signature::Signature;
use crate::math::{Ray, Rgb};
use crate::transport::lights::emission::{self, Emission};
use crate::transport::points::{Continuation, SpecularEvent, Vertex};
use crate::world::{Media, World};

/// One branch of a path of caustic light.
pub(in crate::transport) struct CausticBranch {
    pub(in crate::transport) ray: Ray,
    /// W.
    pub(in crate::transport) flux: Rgb,
    pub(in crate::transport) media: Media,
    /// Mirrors and interfaces so far.
    pub(in crate::transport) bounces: u32,
    /// The surfaces so far.
    pub(in crate::transport) signature: Signature,
}

impl CausticBranch {
    /// The path as it leaves a light.
    pub(in crate::transport) fn from_light(world: &World, light: usize, emission: Emission) -> Self {
        let Emission { origin, direction, flux } = emission;
        let ray = emission::ray_from_light(world, light, origin, direction);
        let media = world.media_at_light(light, ray.at(ray.t_min));
        Self { ray, flux, media, bounces: 0, signature: Signature::default() }
    }

    /// The ways on from a mirror or glass, none from other surfaces.
    pub(in crate::transport) fn ways_on(
        &self,
        world: &World,
        vertex: &Vertex,
    ) -> impl Iterator<Item = (Continuation, Signature)> + use<> {
        let object = world.object_of(vertex.point.hit.primitive).unwrap_or(u32::MAX);
        let (reflected, refracted) = (self.signature.reflected(object), self.signature.refracted(object));
        SpecularEvent::at(world, vertex, &self.media)
            .into_iter()
            .flat_map(move |event| [Some((event.reflected, reflected)), event.refracted.map(|way| (way, refracted))])
            .flatten()
    }

    /// The branch along one of the ways on, with this flux.
    pub(in crate::transport) fn along(
        &self,
        world: &World,
        vertex: &Vertex,
        (next, signature): (Continuation, Signature),
        flux: Rgb,
    ) -> Self {
        Self {
            ray: vertex.ray(world, next.direction),
            flux,
            bounces: next.bounces_after(self.bounces),
            media: next.media,
            signature,
        }
    }
}
