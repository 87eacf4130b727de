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
pub use sobol::{Sampler, Stream, mix64};

/// The index of a cell along the Z-order curve of the plane: the bits of its coordinates, below 2^16, in turn \[Morton66\].
pub fn morton_2d(cell: glam::UVec2) -> u32 {
    let spread = |x: u32| {
        let x = (x | x << 8) & 0x00ff_00ff;
        let x = (x | x << 4) & 0x0f0f_0f0f;
        let x = (x | x << 2) & 0x3333_3333;
        (x | x << 1) & 0x5555_5555
    };
    spread(cell.x) | spread(cell.y) << 1
}

/// A linear Rec.709 colour, radiance, flux or weight: one value a channel.
pub type Rgb = glam::Vec3;

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec2;

    #[test]
    fn the_z_order_curve_goes_square_by_square() {
        let curve = [[0, 0], [1, 0], [0, 1], [1, 1], [2, 0]];
        assert_eq!(curve.map(|cell| morton_2d(UVec2::from(cell))), [0, 1, 2, 3, 4]);
        assert_eq!(morton_2d(UVec2::new(0xffff, 0)), 0x5555_5555);
    }
}
