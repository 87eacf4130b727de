//! One coordinate of a control net, its Bezier ordinates, in vectors of four \[Farin02\].

use crate::math::lanes::Lanes;
use std::ops::{Add, Mul, Sub};
use wide::f64x4;

/// Four numbers: the ordinates of one row of a control net, or a vector of four coordinates.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(crate) struct Row(pub(crate) [f64; 4]);

/// The Bezier ordinates of a bicubic polynomial, which is one coordinate of a patch: `[i][j]`, i along u, j along v.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ordinates(pub(crate) [Row; 4]);

/// A closed interval.
#[derive(Clone, Copy)]
pub(crate) struct Interval {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

impl Row {
    pub(crate) const ZERO: Self = Self([0.0; 4]);

    #[inline(always)]
    fn zip(self, b: Self, f: impl Fn(f64x4, f64x4) -> f64x4) -> Self {
        Self(f(f64x4::new(self.0), f64x4::new(b.0)).to_array())
    }

    /// `self * s + c`.
    #[inline(always)]
    pub(crate) fn mul_add(self, l: impl Lanes, s: f64, c: Self) -> Self {
        let [a, b] = [self.0, c.0];
        Self([
            l.mul_add_f64(a[0], s, b[0]),
            l.mul_add_f64(a[1], s, b[1]),
            l.mul_add_f64(a[2], s, b[2]),
            l.mul_add_f64(a[3], s, b[3]),
        ])
    }

    /// A row of four times `x`.
    #[inline(always)]
    pub(crate) fn splat(x: f64) -> Self {
        Self([x; 4])
    }

    /// The minimum of each pair. The result is unspecified where a number is NaN: a check would double the cost.
    #[inline(always)]
    fn min(self, b: Self) -> Self {
        self.zip(b, f64x4::fast_min)
    }

    /// The maximum of each pair, unspecified where a number is NaN.
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

impl Ordinates {
    pub(crate) const ZERO: Self = Self([Row::ZERO; 4]);

    /// All ordinates minus `offset`.
    #[inline(always)]
    pub(crate) fn minus(&self, offset: f64) -> Self {
        let offset = Row::splat(offset);
        let [a, b, c, d] = self.0;
        Self([a - offset, b - offset, c - offset, d - offset])
    }

    /// The polynomial with u and v exchanged.
    #[inline(always)]
    pub(crate) fn transposed(&self) -> Self {
        let [Row(a), Row(b), Row(c), Row(d)] = self.0;
        Self([
            Row([a[0], b[0], c[0], d[0]]),
            Row([a[1], b[1], c[1], d[1]]),
            Row([a[2], b[2], c[2], d[2]]),
            Row([a[3], b[3], c[3], d[3]]),
        ])
    }

    /// The differences of neighbours along u: the derivative by u has 3 times these ordinates.
    #[inline(always)]
    pub(crate) fn differences(&self) -> [Row; 3] {
        let [a, b, c, d] = self.0;
        [b - a, c - b, d - c]
    }

    /// The second differences along u.
    #[inline(always)]
    pub(crate) fn second_differences(&self) -> [Row; 2] {
        let [a, b, c] = self.differences();
        [b - a, c - b]
    }

    /// The mixed differences, along u and v.
    #[inline(always)]
    pub(crate) fn mixed_differences(&self) -> [Row; 3] {
        let [a, b, c] = self.differences();
        Self([a, b, c, c]).transposed().differences()
    }

    /// The mean of the four corner ordinates.
    #[inline(always)]
    pub(crate) fn corner_mean(&self) -> f64 {
        let [Row([a, .., b]), _, _, Row([c, .., d])] = self.0;
        0.25 * ((a + d) + (b + c))
    }

    /// The interval of the ordinates. It holds all values of the polynomial over the unit square (convex hull property).
    #[inline(always)]
    pub(crate) fn range(&self) -> Interval {
        Interval::of(&self.0)
    }

    /// The polynomial over `u <= 1/2` and over `u >= 1/2`, by de Casteljau's algorithm.
    #[inline(always)]
    pub(crate) fn halves(&self) -> [Self; 2] {
        let half = Row::splat(0.5);
        let [p, q, r, s] = self.0;
        let (a, b, c) = ((p + q) * half, (q + r) * half, (r + s) * half);
        let (d, e) = ((a + b) * half, (b + c) * half);
        let middle = (d + e) * half;
        [Self([p, a, d, middle]), Self([middle, e, c, s])]
    }

    /// The polynomial over `low <= u <= high`. Each new ordinate is the blossom of the curve at three arguments, `low` or
    /// `high` \[Ramshaw89\].
    #[inline(always)]
    pub(crate) fn restricted(&self, low: f64, high: f64) -> Self {
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

impl Interval {
    /// The smallest interval that holds all numbers of `rows`.
    #[inline(always)]
    pub(crate) fn of<const N: usize>(rows: &[Row; N]) -> Self {
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

    /// The interval times a positive factor.
    #[inline(always)]
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self { low: factor * self.low, high: factor * self.high }
    }

    /// The interval shifted by `-offset`.
    #[inline(always)]
    pub(crate) fn minus(self, offset: f64) -> Self {
        Self { low: self.low - offset, high: self.high - offset }
    }

    /// The greatest absolute value in the interval.
    #[inline(always)]
    pub(crate) fn magnitude(self) -> f64 {
        self.high.abs().max(self.low.abs())
    }

    /// `high - low`.
    #[inline(always)]
    pub(crate) fn width(self) -> f64 {
        self.high - self.low
    }

    /// Whether the interval lies on one side of zero, farther from it than `slack`.
    #[inline(always)]
    pub(crate) fn excludes_zero(self, slack: f64) -> bool {
        self.low > slack || self.high < -slack
    }
}
