use crate::math::lanes::Lanes;
use std::ops::{Add, Mul, Sub};

/// Four numbers, which compilers turn into vector instructions of any width.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Row(pub(super) [f64; 4]);

/// Four rows.
pub(super) type Rows = [Row; 4];

impl Row {
    pub(super) const ZERO: Self = Self([0.0; 4]);

    #[inline(always)]
    fn zip(self, b: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self([f(self.0[0], b.0[0]), f(self.0[1], b.0[1]), f(self.0[2], b.0[2]), f(self.0[3], b.0[3])])
    }

    /// The lesser ones; no care is taken of what is not a number, which would cost as much again.
    #[inline(always)]
    pub(super) fn min(self, b: Self) -> Self {
        self.zip(b, |a, b| if a < b { a } else { b })
    }

    /// The greater ones, in the same way.
    #[inline(always)]
    pub(super) fn max(self, b: Self) -> Self {
        self.zip(b, |a, b| if a > b { a } else { b })
    }

    /// Without signs.
    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        Self([self.0[0].abs(), self.0[1].abs(), self.0[2].abs(), self.0[3].abs()])
    }

    /// `self * s + c`.
    #[inline(always)]
    pub(super) fn mul_add(self, l: impl Lanes, s: f64, c: Self) -> Self {
        let [a, b] = [self.0, c.0];
        Self([
            l.mul_add_f64(a[0], s, b[0]),
            l.mul_add_f64(a[1], s, b[1]),
            l.mul_add_f64(a[2], s, b[2]),
            l.mul_add_f64(a[3], s, b[3]),
        ])
    }

    /// The same number four times.
    #[inline(always)]
    pub(super) fn splat(x: f64) -> Self {
        Self([x; 4])
    }

    /// The least of the four.
    #[inline(always)]
    pub(super) fn least(self) -> f64 {
        let [a, b, c, d] = self.0;
        let least = |a, b| if a < b { a } else { b };
        least(least(a, b), least(c, d))
    }

    /// The greatest of the four.
    #[inline(always)]
    pub(super) fn greatest(self) -> f64 {
        let [a, b, c, d] = self.0;
        let greatest = |a, b| if a > b { a } else { b };
        greatest(greatest(a, b), greatest(c, d))
    }
}

impl Add for Row {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        self.zip(b, |a, b| a + b)
    }
}

impl Sub for Row {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        self.zip(b, |a, b| a - b)
    }
}

impl Mul<f64> for Row {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: f64) -> Self {
        self.zip(Self::splat(s), |a, s| a * s)
    }
}

/// Columns for rows.
#[inline(always)]
pub(super) fn transpose([a, b, c, d]: &Rows) -> Rows {
    let column = |k: usize| Row([a.0[k], b.0[k], c.0[k], d.0[k]]);
    [column(0), column(1), column(2), column(3)]
}
