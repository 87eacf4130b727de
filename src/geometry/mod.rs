//! Shapes and what a ray meets: sphere, quad, plane, Bezier patches, and the tree over them. Knows no material.

mod aggregate;
pub mod bezier;
mod bvh;
mod packets;
mod plane;
mod quad;
mod sphere;

pub use aggregate::{Aggregate, Hit, Primitive, Tangents};
pub use bvh::Bvh;
pub use plane::Plane;
pub use quad::Quad;
pub use sphere::Sphere;
