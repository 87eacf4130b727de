//! Directed rounding, and bounds of floating-point errors.

use glam::DVec3;

/// The offset of a ray from the surface that it leaves, relative to the coordinates of the surface.
///
/// The position of a hit is exact to some 1e-14 of the coordinates (a few roundings of `f64` and one converged Newton
/// step). With an offset far above this error a ray never hits its own surface again, and the offset is still
/// invisible.
pub const SELF_HIT_OFFSET: f64 = 1e-11;
/// Share of [`SELF_HIT_OFFSET`] that coordinates across the normal have, because the normal is rounded, too.
const NORMAL_ERROR: f64 = 1e-4;

/// How far rounding may move a surface with this unit normal along the normal, with a wide margin; for the largest absolute values of the
/// coordinates that the surface is computed from.
///
/// Each coordinate has an error in proportion to its own magnitude, so that a wide floor is known as well as its height.
#[inline]
pub fn rounding(magnitude: DVec3, normal: DVec3) -> f64 {
    SELF_HIT_OFFSET * (normal.abs() + NORMAL_ERROR).dot(magnitude)
}

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
    fn a_wide_floor_is_known_as_well_as_its_height() {
        let wide = rounding(DVec3::new(1e9, 2.0, 1e9), DVec3::Y);
        assert!((2.0 * SELF_HIT_OFFSET..1e-5).contains(&wide), "{wide}");
        let tilted = rounding(DVec3::new(1e9, 2.0, 1e9), DVec3::new(0.6, 0.8, 0.0));
        assert!(tilted > 0.5e9 * SELF_HIT_OFFSET, "{tilted}");
    }

    #[test]
    fn rounding_encloses() {
        for x in [0.1, -0.1, 1e-50, -1e-50, 1e300, -1e300, 1.0, 0.0, 16_777_217.0] {
            assert!(f64::from(round_down(x)) <= x && x <= f64::from(round_up(x)), "{x} is enclosed");
        }
    }
}
