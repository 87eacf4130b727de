//! SIMD vectors of eight `f32`. Functions are compiled for AVX2 and for the baseline instructions of the target; the
//! processor decides at run time. (The crate `wide` decides at compile time, for vectors of four.)

use wide::{f32x8, u32x8};

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

/// Evaluates an expression with the widest [`Lanes`] that the processor has, under the name that stands before `=>`.
#[cfg(target_arch = "x86_64")]
macro_rules! with_lanes {
    ($l:ident => $body:expr) => {
        if let Some($l) = $crate::math::lanes::Avx2::try_new() {
            $body
        } else {
            let $l = $crate::math::lanes::Portable;
            $body
        }
    };
}
/// Evaluates an expression with the widest [`Lanes`] that the processor has, under the name that stands before `=>`.
#[cfg(not(target_arch = "x86_64"))]
macro_rules! with_lanes {
    ($l:ident => $body:expr) => {{
        let $l = $crate::math::lanes::Portable;
        $body
    }};
}
pub(crate) use with_lanes;

/// Compiles a function once per instruction set; calls choose among the versions at run time. A first parameter
/// `l: impl Lanes` is not an argument of the function: the body gets the widest lanes that the processor has.
macro_rules! simd_dispatch {
    ($(#[$meta:meta])* $vis:vis fn $name:ident($l:ident: impl Lanes, $($arg:tt)*) $(-> $ret:ty)? $body:block) => {
        $crate::math::lanes::simd_dispatch! {
            $(#[$meta])* $vis fn $name($($arg)*) $(-> $ret)? { $crate::math::lanes::with_lanes!($l => $body) }
        }
    };
    ($(#[$meta:meta])* $vis:vis fn $name:ident($($arg:tt)*) $(-> $ret:ty)? $body:block) => {
        $(#[$meta])*
        #[::multiversion::multiversion(targets("x86_64+avx2+fma", "aarch64+neon"))]
        $vis fn $name($($arg)*) $(-> $ret)? $body
    };
}
pub(crate) use simd_dispatch;

/// The vectors that every processor of the target has.
#[derive(Clone, Copy, Debug)]
pub struct Portable;

impl Lanes for Portable {
    type Vector = f32x8;
    type Simd = pulp::Scalar256b;

    #[inline(always)]
    fn simd(self) -> pulp::Scalar256b {
        pulp::Scalar256b
    }

    #[inline(always)]
    fn splat(self, x: f32) -> f32x8 {
        f32x8::splat(x)
    }
    #[inline(always)]
    fn load(self, x: &[f32; LANES]) -> f32x8 {
        f32x8::new(*x)
    }
    #[inline(always)]
    fn store(self, v: f32x8) -> [f32; LANES] {
        v.to_array()
    }
    #[inline(always)]
    fn add(self, a: f32x8, b: f32x8) -> f32x8 {
        a + b
    }
    #[inline(always)]
    fn sub(self, a: f32x8, b: f32x8) -> f32x8 {
        a - b
    }
    #[inline(always)]
    fn mul(self, a: f32x8, b: f32x8) -> f32x8 {
        a * b
    }
    #[inline(always)]
    fn div(self, a: f32x8, b: f32x8) -> f32x8 {
        a / b
    }
    #[inline(always)]
    fn mul_add(self, a: f32x8, b: f32x8, c: f32x8) -> f32x8 {
        a * b + c
    }
    #[inline(always)]
    fn mul_add_f64(self, a: f64, b: f64, c: f64) -> f64 {
        a * b + c
    }
    #[inline(always)]
    fn max(self, a: f32x8, b: f32x8) -> f32x8 {
        a.fast_max(b)
    }
    #[inline(always)]
    fn min(self, a: f32x8, b: f32x8) -> f32x8 {
        a.fast_min(b)
    }
    #[inline(always)]
    fn abs(self, a: f32x8) -> f32x8 {
        a.abs()
    }
    #[inline(always)]
    fn sqrt(self, a: f32x8) -> f32x8 {
        a.sqrt()
    }
    #[inline(always)]
    fn sign(self, a: f32x8) -> f32x8 {
        f32x8::ONE | (a & f32x8::splat(-0.0))
    }
    #[inline(always)]
    fn less(self, a: f32x8, b: f32x8) -> f32x8 {
        a.simd_lt(b)
    }
    #[inline(always)]
    fn in_range(self, x: &[u32; LANES], first: u32, count: u32) -> f32x8 {
        f32x8::from_bits((u32x8::new(*x) - u32x8::splat(first)).simd_le(u32x8::splat(count - 1)))
    }
    #[inline(always)]
    fn and(self, a: f32x8, b: f32x8) -> f32x8 {
        a & b
    }
    #[inline(always)]
    fn bits(self, mask: f32x8) -> u32 {
        mask.to_bitmask()
    }
}

/// AVX2 and FMA. A value of this type proves that the processor has them.
#[cfg(target_arch = "x86_64")]
pub use pulp::x86::V3 as Avx2;

#[cfg(target_arch = "x86_64")]
impl Lanes for Avx2 {
    type Vector = std::arch::x86_64::__m256;
    type Simd = Self;

    #[inline(always)]
    fn simd(self) -> Self {
        self
    }

    #[inline(always)]
    fn splat(self, x: f32) -> Self::Vector {
        self.avx._mm256_set1_ps(x)
    }
    #[inline(always)]
    fn load(self, x: &[f32; LANES]) -> Self::Vector {
        pulp::cast(*x)
    }
    #[inline(always)]
    fn store(self, v: Self::Vector) -> [f32; LANES] {
        pulp::cast(v)
    }
    #[inline(always)]
    fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_add_ps(a, b)
    }
    #[inline(always)]
    fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_sub_ps(a, b)
    }
    #[inline(always)]
    fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_mul_ps(a, b)
    }
    #[inline(always)]
    fn div(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_div_ps(a, b)
    }
    #[inline(always)]
    fn mul_add(self, a: Self::Vector, b: Self::Vector, c: Self::Vector) -> Self::Vector {
        self.fma._mm256_fmadd_ps(a, b, c)
    }
    #[inline(always)]
    fn mul_add_f64(self, a: f64, b: f64, c: f64) -> f64 {
        a.mul_add(b, c)
    }
    #[inline(always)]
    fn max(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_max_ps(a, b)
    }
    #[inline(always)]
    fn min(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_min_ps(a, b)
    }
    #[inline(always)]
    fn abs(self, a: Self::Vector) -> Self::Vector {
        self.avx._mm256_andnot_ps(self.splat(-0.0), a)
    }
    #[inline(always)]
    fn sqrt(self, a: Self::Vector) -> Self::Vector {
        self.avx._mm256_sqrt_ps(a)
    }
    #[inline(always)]
    fn sign(self, a: Self::Vector) -> Self::Vector {
        self.avx._mm256_or_ps(self.splat(1.0), self.avx._mm256_and_ps(self.splat(-0.0), a))
    }
    #[inline(always)]
    fn less(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_cmp_ps::<{ std::arch::x86_64::_CMP_LT_OQ }>(a, b)
    }
    #[inline(always)]
    fn in_range(self, x: &[u32; LANES], first: u32, count: u32) -> Self::Vector {
        let broadcast = |x: u32| self.avx._mm256_set1_epi32(x.cast_signed());
        let offset = self.avx2._mm256_sub_epi32(pulp::cast(*x), broadcast(first));
        let least = self.avx2._mm256_min_epu32(offset, broadcast(count - 1));
        pulp::cast(self.avx2._mm256_cmpeq_epi32(least, offset))
    }
    #[inline(always)]
    fn and(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_and_ps(a, b)
    }
    #[inline(always)]
    fn bits(self, mask: Self::Vector) -> u32 {
        self.avx._mm256_movemask_ps(mask).cast_unsigned()
    }
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
