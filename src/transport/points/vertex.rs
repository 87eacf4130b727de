use super::bsdf;
use crate::geometry::Hit;
use crate::math::{Ray, Rgb};
use crate::transport::counters::Counters;
use crate::world::{Material, Scattering, SurfacePoint, World};
use glam::DVec3;

/// A vertex of a light or camera path: a surface point with its scattering function.
#[derive(Clone, Copy, Debug)]
pub(in crate::transport) struct Vertex {
    /// Where the path met the surface.
    pub(in crate::transport) point: SurfacePoint,
    /// The side of a sheet that the path came to: the `front_side` of its [`crate::world::Surface`], or the other side.
    pub(in crate::transport) side: u32,
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
    /// The vertex of a path whose ray met an object, given by the side of a sheet to which its normal points, and
    /// by the material's index. Camera paths, photons and caustic
    /// photons make their vertices here.
    #[inline(always)]
    pub(in crate::transport) fn at_hit(
        world: &World,
        ray: &Ray,
        hit: Hit,
        [front_side, material]: [u32; 2],
        counters: &mut Counters,
    ) -> Self {
        let point = world.surface_point(ray, hit);
        let (scattering, n_shade) = world.scattering(&point, material);
        counters.texture_lookups += u64::from(world.materials[material as usize].lookups());
        let side = front_side ^ u32::from(!point.front);
        Self { point, side, material, scattering, n_side: point.n_side(), n_shade, wo: -ray.direction }
    }

    /// The material, whose textures gave the scattering function.
    #[inline]
    pub(in crate::transport) fn material<'w>(&self, world: &'w World) -> &'w Material {
        &world.materials[self.material as usize]
    }

    /// Whether the surface scatters light diffusely or in a Phong lobe here.
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
