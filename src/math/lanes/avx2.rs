use super::{LANES, Lanes};

/// AVX2 and FMA. A value of this type proves that the processor has them.
pub use pulp::x86::V3 as Avx2;

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
