//! Values of two halves of the iterations.

use crate::math::Rgb;
use std::ops::{Add, Mul, Sub};

/// A value of each half of the iterations: independent estimates of one quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Halves(pub(super) [Rgb; 2]);

impl Halves {
    /// The mean for halves of these weights, whose sum is 1.
    pub(super) fn mean(self, weights: [f32; 2]) -> Rgb {
        weights[0] * self.0[0] + weights[1] * self.0[1]
    }
}

impl Add for Halves {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self([self.0[0] + other.0[0], self.0[1] + other.0[1]])
    }
}

impl Sub for Halves {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self([self.0[0] - other.0[0], self.0[1] - other.0[1]])
    }
}

impl Mul<f32> for Halves {
    type Output = Self;

    fn mul(self, factor: f32) -> Self {
        Self([self.0[0] * factor, self.0[1] * factor])
    }
}
