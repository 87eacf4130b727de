use super::{Material, Scattering, World};
use crate::geometry::Hit;
use crate::math::Ray;
use crate::math::float::SELF_HIT_OFFSET;
use glam::DVec3;

/// What a primitive is a part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// A visible surface.
    Object {
        /// Index in the scene; the patches of a Bezier object share it.
        object: u32,
        /// Index in the scene.
        material: u32,
        /// Edges where the surface goes on into a neighbour.
        shared: SharedEdges,
    },
    /// A light's own surface, by its index in the world.
    Light(u32),
}

/// Which edges of a patch are also edges of another patch of the same object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SharedEdges {
    /// At u = 0 and u = 1.
    pub u: [bool; 2],
    /// At v = 0 and v = 1.
    pub v: [bool; 2],
}

/// A point on a surface as light meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Scene units.
    pub position: DVec3,
    /// Geometric unit normal of the front or the outside, whichever side was hit.
    pub n_geom: DVec3,
    /// Whether the ray came from the side that the normal points to.
    pub front: bool,
    /// Where on which primitive.
    pub hit: Hit,
}

impl SurfacePoint {
    /// The geometric unit normal on the side that the ray came from.
    pub fn n_side(&self) -> DVec3 {
        if self.front { self.n_geom } else { -self.n_geom }
    }
}

impl World {
    /// The point where a ray met a surface.
    pub fn surface_point(&self, ray: &Ray, hit: Hit) -> SurfacePoint {
        let primitive = &self.aggregate.primitives()[hit.primitive as usize];
        let (position, n_geom) = primitive.surface(ray, &hit);
        SurfacePoint { position, n_geom, front: ray.direction.dot(n_geom) < 0.0, hit }
    }

    /// Scattering and unit shading normal (on the side that the ray came from) of a material at a point.
    #[inline]
    pub fn scattering(&self, point: &SurfacePoint, material: u32) -> (Scattering, DVec3) {
        let material = &self.materials[material as usize];
        material.uniform().map_or_else(|| self.varied(point, material), |scattering| (scattering, point.n_side()))
    }

    /// The same where textures tell. Apart, so that the loops of scenes without them stay small.
    #[inline(never)]
    fn varied(&self, point: &SurfacePoint, material: &Material) -> (Scattering, DVec3) {
        let primitive = &self.aggregate.primitives()[point.hit.primitive as usize];
        let tangents = primitive.tangents(&point.hit, point.n_geom);
        let n_front = material.shading_normal(point.n_geom, &tangents);
        // Mirrored in the tangent plane on the back side, so that bumps stay bumps.
        let n_shade = if point.front { n_front } else { n_front - 2.0 * n_front.dot(point.n_geom) * point.n_geom };
        (material.scattering(tangents.uv), n_shade)
    }

    /// Where a ray that leaves a surface point in this direction starts: a little off the surface, on its side.
    pub fn leave(&self, point: &SurfacePoint, direction: DVec3) -> DVec3 {
        let offset = SELF_HIT_OFFSET * (point.position.abs().max_element() + self.radius);
        point.position + point.n_geom * offset.copysign(direction.dot(point.n_geom))
    }
}
