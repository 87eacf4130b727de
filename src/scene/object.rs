use super::{Bezier, Revolution};
use glam::DVec3;

/// An object: a shape with a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// The name, unique among objects.
    pub name: String,
    /// The name of its material.
    pub material: String,
    /// The shape.
    pub shape: Shape,
    /// The piece of glass that it bounds, together with all objects of the same body; `None` for the body that all objects of the
    /// same glass material without a body bound.
    pub body: Option<String>,
}

/// Key of a body: objects with equal keys bound one body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyKey<'a> {
    /// The body that the objects name.
    Named(&'a str),
    /// The material of objects that name no body.
    Material(&'a str),
}

impl<'a> BodyKey<'a> {
    /// The name of the body or of the material.
    pub fn name(&self) -> &'a str {
        match self {
            Self::Named(name) | Self::Material(name) => name,
        }
    }
}

impl Object {
    /// The body that the object bounds if it is of glass.
    pub fn body_key(&self) -> BodyKey<'_> {
        self.body.as_deref().map_or(BodyKey::Material(&self.material), BodyKey::Named)
    }
}

/// The shape of an object.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A parallelogram.
    Quad {
        /// The corner at (u, v) = (0, 0), scene units.
        corner: DVec3,
        /// The edge along u, scene units.
        edge_u: DVec3,
        /// The edge along v, scene units.
        edge_v: DVec3,
    },
    /// A sphere.
    Sphere {
        /// The center, scene units.
        center: DVec3,
        /// The radius, scene units, above 0.
        radius: f64,
    },
    /// An unbounded plane.
    Plane {
        /// A point of the plane, scene units.
        point: DVec3,
        /// The normal on the front side; any length but 0.
        normal: DVec3,
        /// The direction of u, projected into the plane; `None` for the x axis, or z if the normal is along x.
        u_axis: Option<DVec3>,
    },
    /// Bicubic Bezier patches.
    Bezier(Bezier),
    /// A surface of revolution, rendered as the patches that its profile sweeps.
    Revolution(Revolution),
}

impl Shape {
    /// The patches of the shape: given ones, or those of a surface of revolution; `None` for a shape without patches.
    pub fn surface(&self) -> Option<&Bezier> {
        match self {
            Self::Bezier(bezier) => Some(bezier),
            Self::Revolution(revolution) => Some(revolution.surface()),
            Self::Quad { .. } | Self::Sphere { .. } | Self::Plane { .. } => None,
        }
    }
}
