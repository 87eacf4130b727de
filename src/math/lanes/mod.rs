//! SIMD vectors of eight `f32`. Functions are compiled for AVX2 and for the instructions that the target always has; the processor decides
//! at run time. (The crate `wide` decides at compile time, and so for vectors of four.)
//!
//! | file | holds |
//! |---|---|
//! | `dispatch` | macros that choose the instructions at run time |
//! | `portable` | the vectors that every processor of the target has |
//! | `avx2` | AVX2 and FMA |

#[cfg(target_arch = "x86_64")]
mod avx2;
mod dispatch;
mod portable;

#[cfg(target_arch = "x86_64")]
pub use avx2::Avx2;
pub(crate) use dispatch::{simd_dispatch, with_lanes};
pub use portable::Portable;

/// Numbers in a vector.
pub const LANES: usize = 8;

/// A set of vector instructions. Comparisons return masks: all bits of a lane are set where the comparison holds; else
/// all bits are clear.
pub trait Lanes: Copy {
    /// [`LANES`] numbers or masks.
    type Vector: Copy;
    /// The token of the crate `pulp` for the same instruction set: vectors of four `f64`.
    type Simd: pulp::Simd;

    /// The token, see [`Lanes::Simd`].
    fn simd(self) -> Self::Simd;

    /// A number in every lane.
    fn splat(self, x: f32) -> Self::Vector;
    /// Loads numbers from memory.
    fn load(self, x: &[f32; LANES]) -> Self::Vector;
    /// Stores numbers to memory.
    fn store(self, v: Self::Vector) -> [f32; LANES];
    /// `a + b`.
    fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// `a - b`.
    fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// `a b`.
    fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// `a / b`.
    fn div(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// `a b + c`, fused where the instructions are.
    fn mul_add(self, a: Self::Vector, b: Self::Vector, c: Self::Vector) -> Self::Vector;
    /// The greater number of each lane; unspecified for NaN.
    fn max(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// The lesser number of each lane; unspecified for NaN.
    fn min(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// The absolute value.
    fn abs(self, a: Self::Vector) -> Self::Vector;
    /// The square root; NaN for negative numbers.
    fn sqrt(self, a: Self::Vector) -> Self::Vector;
    /// 1 with the sign of `a`.
    fn sign(self, a: Self::Vector) -> Self::Vector;
    /// Mask of `a < b`.
    fn less(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// Mask of `first <= x < first + count`, of unsigned integers; `count` is not 0.
    fn in_range(self, x: &[u32; LANES], first: u32, count: u32) -> Self::Vector;
    /// The bitwise and: of two masks, or of a mask and numbers, which become 0 where the mask is not set.
    fn and(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// `a b + c` of scalars in double precision, fused where the instructions are.
    fn mul_add_f64(self, a: f64, b: f64, c: f64) -> f64;
    /// The mask as a bit for each lane, lane 0 in the lowest bit.
    fn bits(self, mask: Self::Vector) -> u32;

    /// The sum of the lanes.
    #[inline(always)]
    fn sum(self, v: Self::Vector) -> f32 {
        let [a, b, c, d, e, f, g, h] = self.store(v);
        ((a + e) + (c + g)) + ((b + f) + (d + h))
    }

    /// Loads three vectors, the coordinates of eight points.
    #[inline(always)]
    fn load3(self, [x, y, z]: &[[f32; LANES]; 3]) -> [Self::Vector; 3] {
        [self.load(x), self.load(y), self.load(z)]
    }

    /// A point in every lane.
    #[inline(always)]
    fn splat3(self, [x, y, z]: [f32; 3]) -> [Self::Vector; 3] {
        [self.splat(x), self.splat(y), self.splat(z)]
    }

    /// `a` times a scalar.
    #[inline(always)]
    fn scale(self, factor: f32, a: Self::Vector) -> Self::Vector {
        self.mul(self.splat(factor), a)
    }

    /// `ax bx + ay by + az bz`.
    #[inline(always)]
    fn dot(self, a: [Self::Vector; 3], b: [Self::Vector; 3]) -> Self::Vector {
        self.mul_add(a[0], b[0], self.mul_add(a[1], b[1], self.mul(a[2], b[2])))
    }
}

/// The indices of the set bits, in ascending order.
#[inline(always)]
pub fn set_bits(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = (mask != 0).then(|| mask.trailing_zeros() as usize);
        mask &= mask.wrapping_sub(1);
        bit
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<L: Lanes>(l: L) {
        let (x, y) = ([1.0, -2.0, 3.0, 0.0, 5.5, -6.0, 7.0, 8.0], [2.0, -3.0, 3.0, -1.0, 9.0, 6.0, 0.5, 1.0]);
        let (a, b) = (l.load(&x), l.load(&y));
        let by_lane = |f: fn(f32, f32) -> f32| std::array::from_fn(|k| f(x[k], y[k]));
        assert_eq!(l.store(l.add(a, b)), by_lane(|x, y| x + y));
        assert_eq!(l.store(l.sub(a, b)), by_lane(|x, y| x - y));
        assert_eq!(l.store(l.mul(a, b)), by_lane(|x, y| x * y));
        assert_eq!(l.store(l.div(a, b)), by_lane(|x, y| x / y));
        assert_eq!(l.store(l.max(a, b)), by_lane(f32::max));
        assert_eq!(l.store(l.min(a, b)), by_lane(f32::min));
        assert_eq!(l.store(l.abs(a)), by_lane(|x, _| x.abs()));
        assert_eq!(l.store(l.sqrt(l.abs(a))), by_lane(|x, _| x.abs().sqrt()));
        assert_eq!(l.store(l.sign(a)), by_lane(|x, _| 1f32.copysign(x)));
        assert_eq!(l.store(l.mul_add(a, b, l.splat(1.0))), by_lane(|x, y| x * y + 1.0));
        assert_eq!(l.mul_add_f64(2.0, 3.0, 1.0), 7.0);
        assert_eq!(l.store(l.and(a, l.less(a, b))), by_lane(|x, y| if x < y { x } else { 0.0 }));
        assert_eq!(l.bits(l.less(a, b)), 0b0011_0001);
        assert_eq!(l.bits(l.in_range(&[0, 5, 6, 7, 8, u32::MAX, 4, 1 << 31], 5, 3)), 0b0000_1110);
        assert_eq!(l.sum(a), 16.5);
        assert_eq!(l.store(l.dot([a, a, a], [b, b, l.splat(1.0)])), by_lane(|x, y| 2.0 * x * y + x));
    }

    #[test]
    fn set_bits_come_in_rising_order() {
        assert_eq!(set_bits(0b1000_0000_0000_0000_0000_0000_0001_0010).collect::<Vec<_>>(), [1, 4, 31]);
        assert_eq!(set_bits(0).count(), 0);
    }

    #[test]
    fn all_sets_of_instructions_agree() {
        check(Portable);
        with_lanes!(l => check(l));
    }
}
