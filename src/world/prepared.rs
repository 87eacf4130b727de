use super::texture::TextureKey;
use super::{Camera, Image, Light, Material, Scattering, Surface, SurfacePoint};
use crate::geometry::{Aggregate, Hit};
use crate::math::float::SELF_HIT_OFFSET;
use crate::math::{Ray, Rgb};
use glam::DVec3;
use std::sync::Arc;

/// A scene as the renderer reads it.
#[derive(Clone, Debug)]
pub struct World {
    /// All surfaces, area lights included.
    pub aggregate: Aggregate,
    /// For each primitive of the aggregate, the object or light that it belongs to.
    pub surfaces: Vec<Surface>,
    /// The materials, in the order of the scene.
    pub materials: Vec<Material>,
    /// The lights with power above zero, in the order of the scene.
    pub lights: Vec<Light>,
    /// The camera, with the pixel grid of the film.
    pub camera: Camera,
    /// The radiance along rays that leave the scene.
    pub background: Rgb,
    /// The greatest number of scattering events on a path between light and camera.
    pub max_bounces: u32,
    /// The center of the box of all bounded surfaces and lights.
    pub center: DVec3,
    /// Half the diagonal of that box, in scene units; above 0.
    pub radius: f64,
    /// The decoded images, for the next world.
    pub(super) textures: Vec<(TextureKey, Arc<Image>)>,
}

impl World {
    /// The decoded images of textures and maps, each once, in the order in which materials first use them.
    pub fn images(&self) -> impl Iterator<Item = &Arc<Image>> {
        self.textures.iter().map(|(_, image)| image)
    }

    /// The surface point of a ray's hit.
    pub fn surface_point(&self, ray: &Ray, hit: Hit) -> SurfacePoint {
        let primitive = &self.aggregate.primitives()[hit.primitive as usize];
        let (position, n_geom) = primitive.surface(ray, &hit);
        SurfacePoint { position, n_geom, front: ray.direction.dot(n_geom) < 0.0, hit }
    }

    /// The scattering of a material at a point, and the unit shading normal on the side that the ray came from.
    #[inline]
    pub fn scattering(&self, point: &SurfacePoint, material: u32) -> (Scattering, DVec3) {
        let material = &self.materials[material as usize];
        material
            .uniform()
            .map_or_else(|| self.textured_scattering(point, material), |scattering| (scattering, point.n_side()))
    }

    /// The scattering and the shading normal of a material with textures. Not inlined, so that the loops of scenes without
    /// textures stay small.
    #[inline(never)]
    fn textured_scattering(&self, point: &SurfacePoint, material: &Material) -> (Scattering, DVec3) {
        let primitive = &self.aggregate.primitives()[point.hit.primitive as usize];
        let tangents = primitive.tangents(&point.hit, point.n_geom);
        let n_front = material.shading_normal(point.n_geom, &tangents);
        // On the back side mirrored in the tangent plane, so that bumps stay bumps.
        let n_shade = if point.front { n_front } else { n_front - 2.0 * n_front.dot(point.n_geom) * point.n_geom };
        (material.scattering(tangents.uv), n_shade)
    }

    /// The origin of a ray that leaves a surface point in this direction: offset from the surface, to the side of the
    /// direction, by more than rounding.
    pub fn leave(&self, point: &SurfacePoint, direction: DVec3) -> DVec3 {
        let offset = SELF_HIT_OFFSET * (point.position.abs().max_element() + self.radius);
        point.position + point.n_geom * offset.copysign(direction.dot(point.n_geom))
    }
}
