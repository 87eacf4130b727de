use super::Bezier;
use glam::DVec3;

/// A surface with a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Unique among objects.
    pub name: String,
    /// Name of its material.
    pub material: String,
    /// Its form.
    pub shape: Shape,
}

/// The kinds of surfaces.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A parallelogram.
    Quad {
        /// (u, v) = (0, 0).
        corner: DVec3,
        /// Where u runs.
        edge_u: DVec3,
        /// Where v runs.
        edge_v: DVec3,
    },
    /// A sphere.
    Sphere {
        /// Scene units.
        center: DVec3,
        /// Scene units, above 0.
        radius: f64,
    },
    /// An unbounded plane.
    Plane {
        /// Any point of it.
        point: DVec3,
        /// Points to its front; any length but 0.
        normal: DVec3,
        /// Where u runs; `None`: the x axis laid into the plane, or z where the normal is along x.
        u_axis: Option<DVec3>,
    },
    /// Bicubic Bezier patches that move together.
    Bezier(Bezier),
}
