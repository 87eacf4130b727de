use super::SharedEdges;
use crate::geometry::Hit;
use glam::DVec3;

/// The object or light that a primitive belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// An object of the scene.
    Object {
        /// Index of the object in the scene; patches of a Bezier object share its index.
        object: u32,
        /// Index of the material in the scene.
        material: u32,
        /// The rank of the body that it bounds, if it is of glass.
        body: Option<u32>,
        /// The side of its sheet to which its normal points: a number in the world, whose last bit tells the sides of one sheet apart.
        /// A sheet is a smooth surface of an object; photons of other sheets lie across a crease or a gap.
        front_side: u32,
        /// Edges across which the sheet continues in another patch.
        shared: SharedEdges,
    },
    /// The surface of an area light, by the index of the light in the world.
    Light(u32),
}

/// A point on a surface, as a ray hits it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The position, in scene units.
    pub position: DVec3,
    /// The geometric unit normal of the front or the outside, independent of the side of the hit.
    pub n_geom: DVec3,
    /// Whether the ray came from the side that the normal points to.
    pub front: bool,
    /// The hit on the primitive.
    pub hit: Hit,
}

impl SurfacePoint {
    /// The geometric unit normal on the side that the ray came from.
    pub fn n_side(&self) -> DVec3 {
        if self.front { self.n_geom } else { -self.n_geom }
    }
}
