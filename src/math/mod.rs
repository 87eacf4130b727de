//! Rays, boxes, frames, error bounds, sampling warps and index-based random streams.
//!
//! Geometry is computed in `f64`, colour in `f32`: a ray's start must be exact to a small fraction of the
//! offset that keeps it off its own surface, at any distance from the world's origin.

mod aabb;
pub mod float;
pub mod lanes;
pub mod octahedral;
mod orthonormal_basis;
mod ray;
pub mod sobol;
pub mod warp;

pub use aabb::Aabb;
pub use lanes::{LANES, Lanes};
pub use orthonormal_basis::OrthonormalBasis;
pub use ray::Ray;
pub use sobol::{Sampler, Stream};

/// A linear Rec.709 colour, radiance, flux or weight: one value a channel.
pub type Rgb = glam::Vec3;
