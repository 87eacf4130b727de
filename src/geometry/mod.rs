//! Shapes, and the intersection of rays with them. Knows no material.
//!
//! | file | holds |
//! |---|---|
//! | `sphere`, `quad`, `plane` | [`Sphere`], [`Quad`], [`Plane`]: intersection, parameters, distance |
//! | [`bezier`] | bicubic Bezier patches |
//! | `primitive` | [`Primitive`], one of these shapes; [`Hit`], [`Tangents`] |
//! | `blocks` | four quads or spheres at a time |
//! | `bvh` | [`Bvh`]: a bounding volume hierarchy over boxes |
//! | `aggregate` | [`Aggregate`]: all primitives of a scene |
//!
//! # References
//!
//! \[DHK08\] and \[KayKajiya86\] are in the list of [`bezier`].
//!
//! - \[Ize13\] T. Ize, Robust BVH Ray Traversal, JCGT 2(2), 2013.
//! - \[Wald07\] I. Wald, On Fast Construction of SAH-based Bounding Volume Hierarchies, IEEE Symposium on Interactive Ray
//!   Tracing 2007.

mod aggregate;
pub mod bezier;
mod blocks;
mod bvh;
mod plane;
mod primitive;
mod quad;
mod sphere;

pub use aggregate::Aggregate;
pub use bvh::Bvh;
pub use plane::Plane;
pub use primitive::{Hit, Primitive, Tangents};
pub use quad::Quad;
pub use sphere::Sphere;
