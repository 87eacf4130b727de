//! Four numbers of double precision at a time, as [`Lanes`](super::Lanes) are eight of single precision.

#[cfg(target_arch = "x86_64")]
use super::lanes::Avx2;
use super::lanes::Portable;
use wide::f64x4;

/// Numbers in a vector.
pub const DOUBLES: usize = 4;

/// A set of vector instructions. Comparisons give masks: all bits of a number where it holds, else none.
pub trait Doubles: Copy {
    /// [`DOUBLES`] numbers or masks.
    type Vector: Copy;

    /// The same number four times.
    fn splat(self, x: f64) -> Self::Vector;
    /// Numbers from memory.
    fn load(self, x: &[f64; DOUBLES]) -> Self::Vector;
    /// Numbers to memory.
    fn store(self, v: Self::Vector) -> [f64; DOUBLES];
    /// `a + b`.
    fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// `a - b`.
    fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// `a b`.
    fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// `a / b`.
    fn div(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// `a b + c`.
    fn mul_add(self, a: Self::Vector, b: Self::Vector, c: Self::Vector) -> Self::Vector;
    /// The square root; not a number of what is negative.
    fn sqrt(self, a: Self::Vector) -> Self::Vector;
    /// `a` with the sign of `b`; `a` is not negative.
    fn with_sign(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// Mask of `a < b`.
    fn less(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// Both masks.
    fn and(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// `a` where the mask holds, else `b`.
    fn select(self, mask: Self::Vector, a: Self::Vector, b: Self::Vector) -> Self::Vector;
    /// Whether the mask holds anywhere.
    fn any(self, mask: Self::Vector) -> bool;

    /// Vectors from memory.
    #[inline(always)]
    fn load3(self, [x, y, z]: &[[f64; DOUBLES]; 3]) -> [Self::Vector; 3] {
        [self.load(x), self.load(y), self.load(z)]
    }

    /// The same vector four times.
    #[inline(always)]
    fn splat3(self, v: glam::DVec3) -> [Self::Vector; 3] {
        [self.splat(v.x), self.splat(v.y), self.splat(v.z)]
    }

    /// `a - b` of vectors.
    #[inline(always)]
    fn sub3(self, a: [Self::Vector; 3], b: [Self::Vector; 3]) -> [Self::Vector; 3] {
        [self.sub(a[0], b[0]), self.sub(a[1], b[1]), self.sub(a[2], b[2])]
    }

    /// `s a + b` of vectors.
    #[inline(always)]
    fn mul_add3(self, s: Self::Vector, a: [Self::Vector; 3], b: [Self::Vector; 3]) -> [Self::Vector; 3] {
        [self.mul_add(s, a[0], b[0]), self.mul_add(s, a[1], b[1]), self.mul_add(s, a[2], b[2])]
    }

    /// `ax bx + ay by + az bz`.
    #[inline(always)]
    fn dot(self, a: [Self::Vector; 3], b: [Self::Vector; 3]) -> Self::Vector {
        self.mul_add(a[0], b[0], self.mul_add(a[1], b[1], self.mul(a[2], b[2])))
    }
}

impl Doubles for Portable {
    type Vector = f64x4;

    #[inline(always)]
    fn splat(self, x: f64) -> f64x4 {
        f64x4::splat(x)
    }
    #[inline(always)]
    fn load(self, x: &[f64; DOUBLES]) -> f64x4 {
        f64x4::new(*x)
    }
    #[inline(always)]
    fn store(self, v: f64x4) -> [f64; DOUBLES] {
        v.to_array()
    }
    #[inline(always)]
    fn add(self, a: f64x4, b: f64x4) -> f64x4 {
        a + b
    }
    #[inline(always)]
    fn sub(self, a: f64x4, b: f64x4) -> f64x4 {
        a - b
    }
    #[inline(always)]
    fn mul(self, a: f64x4, b: f64x4) -> f64x4 {
        a * b
    }
    #[inline(always)]
    fn div(self, a: f64x4, b: f64x4) -> f64x4 {
        a / b
    }
    #[inline(always)]
    fn mul_add(self, a: f64x4, b: f64x4, c: f64x4) -> f64x4 {
        a * b + c
    }
    #[inline(always)]
    fn sqrt(self, a: f64x4) -> f64x4 {
        a.sqrt()
    }
    #[inline(always)]
    fn with_sign(self, a: f64x4, b: f64x4) -> f64x4 {
        a | (b & f64x4::splat(-0.0))
    }
    #[inline(always)]
    fn less(self, a: f64x4, b: f64x4) -> f64x4 {
        a.simd_lt(b)
    }
    #[inline(always)]
    fn and(self, a: f64x4, b: f64x4) -> f64x4 {
        a & b
    }
    #[inline(always)]
    fn select(self, mask: f64x4, a: f64x4, b: f64x4) -> f64x4 {
        mask.select(a, b)
    }
    #[inline(always)]
    fn any(self, mask: f64x4) -> bool {
        mask.any()
    }
}

#[cfg(target_arch = "x86_64")]
impl Doubles for Avx2 {
    type Vector = std::arch::x86_64::__m256d;

    #[inline(always)]
    fn splat(self, x: f64) -> Self::Vector {
        self.avx._mm256_set1_pd(x)
    }
    #[inline(always)]
    fn load(self, x: &[f64; DOUBLES]) -> Self::Vector {
        pulp::cast(*x)
    }
    #[inline(always)]
    fn store(self, v: Self::Vector) -> [f64; DOUBLES] {
        pulp::cast(v)
    }
    #[inline(always)]
    fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_add_pd(a, b)
    }
    #[inline(always)]
    fn sub(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_sub_pd(a, b)
    }
    #[inline(always)]
    fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_mul_pd(a, b)
    }
    #[inline(always)]
    fn div(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_div_pd(a, b)
    }
    #[inline(always)]
    fn mul_add(self, a: Self::Vector, b: Self::Vector, c: Self::Vector) -> Self::Vector {
        self.fma._mm256_fmadd_pd(a, b, c)
    }
    #[inline(always)]
    fn sqrt(self, a: Self::Vector) -> Self::Vector {
        self.avx._mm256_sqrt_pd(a)
    }
    #[inline(always)]
    fn with_sign(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_or_pd(a, self.avx._mm256_and_pd(b, self.splat(-0.0)))
    }
    #[inline(always)]
    fn less(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_cmp_pd::<{ std::arch::x86_64::_CMP_LT_OQ }>(a, b)
    }
    #[inline(always)]
    fn and(self, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_and_pd(a, b)
    }
    #[inline(always)]
    fn select(self, mask: Self::Vector, a: Self::Vector, b: Self::Vector) -> Self::Vector {
        self.avx._mm256_blendv_pd(b, a, mask)
    }
    #[inline(always)]
    fn any(self, mask: Self::Vector) -> bool {
        self.avx._mm256_movemask_pd(mask) != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<D: Doubles>(d: D) {
        let (x, y) = ([1.0, -2.0, 3.0, 0.0], [2.0, -3.0, 3.0, -1.0]);
        let (a, b) = (d.load(&x), d.load(&y));
        let by_number = |f: fn(f64, f64) -> f64| std::array::from_fn(|k| f(x[k], y[k]));
        assert_eq!(d.store(d.add(a, b)), by_number(|x, y| x + y));
        assert_eq!(d.store(d.sub(a, b)), by_number(|x, y| x - y));
        assert_eq!(d.store(d.mul(a, b)), by_number(|x, y| x * y));
        assert_eq!(d.store(d.div(a, b)), by_number(|x, y| x / y));
        assert_eq!(d.store(d.mul_add(a, b, d.splat(1.0))), by_number(|x, y| x * y + 1.0));
        assert_eq!(d.store(d.sqrt(d.mul(a, a))), by_number(|x, _| x.abs()));
        assert_eq!(d.store(d.with_sign(d.mul(a, a), b)), by_number(|x, y| (x * x).copysign(y)));
        let less = d.less(a, b);
        assert_eq!(d.store(d.select(less, a, b)), by_number(f64::min));
        assert!(d.any(less) && !d.any(d.and(less, d.less(b, a))));
        assert_eq!(d.store(d.dot([a, a, a], [b, b, d.splat(1.0)])), by_number(|x, y| 2.0 * x * y + x));
        assert_eq!(d.store(d.mul_add3(a, [b; 3], [a; 3])[2]), by_number(|x, y| x * y + x));
    }

    #[test]
    fn all_sets_of_instructions_agree() {
        check(Portable);
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = Avx2::try_new() {
            check(avx2);
        }
    }
}
