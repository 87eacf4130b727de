//! Rays, boxes, orthonormal bases, error bounds, sampling warps, random streams and SIMD.
//!
//! | file | holds |
//! |---|---|
//! | `ray`, `aabb` | [`Ray`], [`Aabb`] |
//! | `orthonormal_basis` | [`OrthonormalBasis`] around a normal |
//! | [`float`] | directed rounding, the offset of rays from surfaces |
//! | [`warp`] | from the unit square to directions and discs, with densities |
//! | [`octahedral`] | the equal-area map between square and sphere |
//! | [`sobol`] | [`Sampler`]: Owen-scrambled Sobol points by index |
//! | [`lanes`] | [`Lanes`]: SIMD vectors of eight `f32`, and the choice of instructions at run time |
//!
//! Geometry is computed in `f64`, colour in `f32`: the origin of a ray must be exact to a small fraction of the offset that
//! keeps it off its own surface, at any distance from the world's origin.

mod aabb;
#[cfg(test)]
pub(crate) mod chi_square;
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
