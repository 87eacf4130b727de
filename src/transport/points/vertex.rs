use super::bsdf;
use crate::math::{Ray, Rgb};
use crate::transport::counters::Counters;
use crate::world::{Material, Scattering, SurfacePoint, World};
use glam::DVec3;

/// A vertex of a light or camera path: a surface point with its scattering function.
#[derive(Clone, Copy, Debug)]
pub(in crate::transport) struct Vertex {
    /// Where the path met the surface.
    pub(in crate::transport) point: SurfacePoint,
    /// Index of the object in the scene.
    pub(in crate::transport) object: u32,
    /// Index of the material in the world.
    pub(in crate::transport) material: u32,
    /// Scattering function at the point, its textures looked up.
    pub(in crate::transport) scattering: Scattering,
    /// Geometric unit normal on the side that the path came from.
    pub(in crate::transport) n_side: DVec3,
    /// Shading unit normal on that side.
    pub(in crate::transport) n_shade: DVec3,
    /// Unit direction back along the path.
    pub(in crate::transport) wo: DVec3,
}

impl Vertex {
    /// The vertex at a point where a path that came from `wo` met an object.
    #[inline]
    pub(in crate::transport) fn new(
        world: &World,
        point: SurfacePoint,
        [object, material]: [u32; 2],
        wo: DVec3,
        counters: &mut Counters,
    ) -> Self {
        let (scattering, n_shade) = world.scattering(&point, material);
        counters.texture_lookups += u64::from(world.materials[material as usize].lookups());
        Self { point, object, material, scattering, n_side: point.n_side(), n_shade, wo }
    }

    /// The material, whose textures gave the scattering function.
    #[inline]
    pub(in crate::transport) fn material<'w>(&self, world: &'w World) -> &'w Material {
        &world.materials[self.material as usize]
    }

    /// Whether the surface has a diffuse or glossy part here.
    #[inline]
    pub(in crate::transport) fn scatters(&self) -> bool {
        bsdf::scatters(&self.scattering)
    }

    /// The scattering function towards `wo` for light from `wi`, per steradian, without mirrors and glass.
    #[inline]
    pub(in crate::transport) fn eval(&self, wi: DVec3) -> Rgb {
        bsdf::eval(&self.scattering, self.n_shade, self.wo, wi)
    }

    /// The ray that leaves the vertex in this direction.
    #[inline]
    pub(in crate::transport) fn ray(&self, world: &World, direction: DVec3) -> Ray {
        Ray::new(world.leave(&self.point, direction), direction)
    }
}
