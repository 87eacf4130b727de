use glam::DVec3;
use std::f64::consts::TAU;

/// A sequence of random numbers: PCG, XSH-RR.
pub(super) struct Random {
    state: u64,
    increment: u64,
}

impl Random {
    /// The sequence of this number for a seed.
    pub(super) fn new(seed: u64, sequence: u64) -> Self {
        let mut random = Self { state: 0, increment: sequence << 1 | 1 };
        random.next();
        random.state = random.state.wrapping_add(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
        random.next();
        random
    }

    /// The next number, from 0 to below 1.
    pub(super) fn next(&mut self) -> f64 {
        let state = self.state;
        self.state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(self.increment);
        let folded = ((state >> 18 ^ state) >> 27) as u32;
        f64::from(folded.rotate_right((state >> 59) as u32)) * 2f64.powi(-32)
    }

    /// A unit vector, evenly distributed.
    pub(super) fn direction(&mut self) -> DVec3 {
        let z = 1.0 - 2.0 * self.next();
        let (sin, cos) = (TAU * self.next()).sin_cos();
        let ring = (1.0 - z * z).sqrt();
        DVec3::new(ring * cos, ring * sin, z)
    }
}
