//! The numbers of a control net, four side by side.

use crate::math::lanes::Lanes;
use std::ops::{Add, Mul, Sub};
use wide::f64x4;

/// Four numbers.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Row(pub(super) [f64; 4]);

/// Four rows: one coordinate of the control points, `[i][j]` with i along u and j along v.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rows(pub(super) [Row; 4]);

/// The least and the greatest of some numbers.
#[derive(Clone, Copy)]
pub(super) struct Range {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Row {
    pub(super) const ZERO: Self = Self([0.0; 4]);

    #[inline(always)]
    fn zip(self, b: Self, f: impl Fn(f64x4, f64x4) -> f64x4) -> Self {
        Self(f(f64x4::new(self.0), f64x4::new(b.0)).to_array())
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

    /// The lesser ones; no care is taken of what is not a number, which would cost as much again.
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        self.zip(b, f64x4::fast_min)
    }

    /// The greater ones, in the same way.
    #[inline(always)]
    fn max(self, b: Self) -> Self {
        self.zip(b, f64x4::fast_max)
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

impl Mul for Row {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        self.zip(b, |a, b| a * b)
    }
}

impl Mul<f64> for Row {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: f64) -> Self {
        self * Self::splat(s)
    }
}

impl Rows {
    pub(super) const ZERO: Self = Self([Row::ZERO; 4]);

    /// All numbers less one.
    #[inline(always)]
    pub(super) fn less(&self, offset: f64) -> Self {
        let offset = Row::splat(offset);
        let [a, b, c, d] = self.0;
        Self([a - offset, b - offset, c - offset, d - offset])
    }

    /// Columns for rows.
    #[inline(always)]
    pub(super) fn transposed(&self) -> Self {
        let [Row(a), Row(b), Row(c), Row(d)] = self.0;
        Self([
            Row([a[0], b[0], c[0], d[0]]),
            Row([a[1], b[1], c[1], d[1]]),
            Row([a[2], b[2], c[2], d[2]]),
            Row([a[3], b[3], c[3], d[3]]),
        ])
    }

    /// The differences of neighbours along u.
    #[inline(always)]
    pub(super) fn steps(&self) -> [Row; 3] {
        let [a, b, c, d] = self.0;
        [b - a, c - b, d - c]
    }

    /// The second differences along u.
    #[inline(always)]
    pub(super) fn bends(&self) -> [Row; 2] {
        let [a, b, c] = self.steps();
        [b - a, c - b]
    }

    /// The differences along v of the differences along u.
    #[inline(always)]
    pub(super) fn twists(&self) -> [Row; 3] {
        let [a, b, c] = self.steps();
        Self([a, b, c, c]).transposed().steps()
    }

    /// The mean of the four corners.
    #[inline(always)]
    pub(super) fn middle(&self) -> f64 {
        let [Row([a, .., b]), _, _, Row([c, .., d])] = self.0;
        0.25 * ((a + d) + (b + c))
    }

    /// The least and the greatest number.
    #[inline(always)]
    pub(super) fn range(&self) -> Range {
        Range::of(&self.0)
    }

    /// De Casteljau's scheme at 1/2 along u.
    #[inline(always)]
    pub(super) fn halves(&self) -> [Self; 2] {
        let half = Row::splat(0.5);
        let [p, q, r, s] = self.0;
        let (a, b, c) = ((p + q) * half, (q + r) * half, (r + s) * half);
        let (d, e) = ((a + b) * half, (b + c) * half);
        let middle = (d + e) * half;
        [Self([p, a, d, middle]), Self([middle, e, c, s])]
    }

    /// The part from `low` to `high` along u: each control point of the part is the blossom of the curve at three values,
    /// each of them `low` or `high`.
    #[inline(always)]
    pub(super) fn part(&self, low: f64, high: f64) -> Self {
        let (a, b, c) = self.mixes(low);
        let (d, e, f) = self.mixes(high);
        let (ab, bc, de, ef) = (mix(a, b, low), mix(b, c, low), mix(d, e, high), mix(e, f, high));
        Self([mix(ab, bc, low), mix(ab, bc, high), mix(de, ef, low), mix(de, ef, high)])
    }

    #[inline(always)]
    fn mixes(&self, t: f64) -> (Row, Row, Row) {
        let [a, b, c, d] = self.0;
        (mix(a, b, t), mix(b, c, t), mix(c, d, t))
    }
}

#[inline(always)]
fn mix(a: Row, b: Row, t: f64) -> Row {
    a * (1.0 - t) + b * t
}

impl Range {
    /// Of all numbers in these rows.
    #[inline(always)]
    pub(super) fn of<const N: usize>(rows: &[Row; N]) -> Self {
        let (mut low, mut high) = (rows[0], rows[0]);
        for row in &rows[1..] {
            low = row.min(low);
            high = row.max(high);
        }
        let (Row([a, b, c, d]), Row([e, f, g, h])) = (low, high);
        let min = |a, b| if a < b { a } else { b };
        let max = |a, b| if a > b { a } else { b };
        Self { low: min(min(a, b), min(c, d)), high: max(max(e, f), max(g, h)) }
    }

    /// All numbers times a positive one.
    #[inline(always)]
    pub(super) fn scaled(self, factor: f64) -> Self {
        Self { low: factor * self.low, high: factor * self.high }
    }

    /// All numbers less one.
    #[inline(always)]
    pub(super) fn less(self, offset: f64) -> Self {
        Self { low: self.low - offset, high: self.high - offset }
    }

    /// The greatest absolute value.
    #[inline(always)]
    pub(super) fn greatest(self) -> f64 {
        self.high.abs().max(self.low.abs())
    }

    /// From the least to the greatest.
    #[inline(always)]
    pub(super) fn width(self) -> f64 {
        self.high - self.low
    }

    /// Whether all numbers are on one side of zero, by more than this.
    #[inline(always)]
    pub(super) fn excludes_zero(self, slack: f64) -> bool {
        self.low > slack || self.high < -slack
    }
}
