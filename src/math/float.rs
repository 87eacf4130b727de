//! Directed rounding, and bounds of floating-point errors.

/// The offset of a ray from the surface that it leaves, relative to the largest coordinate.
///
/// The position of a hit is exact to some 1e-14 of the coordinates (a few roundings of `f64` and one converged Newton
/// step). With an offset far above this error a ray never hits its own surface again, and the offset is still
/// invisible.
pub const SELF_HIT_OFFSET: f64 = 1e-11;

/// The largest `f32` that is at most `x`.
pub fn round_down(x: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) > x { rounded.next_down() } else { rounded }
}

/// The smallest `f32` that is at least `x`.
pub fn round_up(x: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) < x { rounded.next_up() } else { rounded }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_encloses() {
        for x in [0.1, -0.1, 1e-50, -1e-50, 1e300, -1e300, 1.0, 0.0, 16_777_217.0] {
            assert!(f64::from(round_down(x)) <= x && x <= f64::from(round_up(x)), "{x} is enclosed");
        }
    }
}
