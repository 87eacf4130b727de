//! Reflection lines (zebra): the stripes that a mirror of the surface's shape would show in a room of black and white stripes.

use glam::DVec3;
use std::f64::consts::PI;

/// Pairs of a black and a white stripe over half a turn.
const STRIPES: f64 = 16.0;

/// The place of the reflected view ray among the stripes: stripe pairs are 1 apart. The stripes are parallels around `axis`, a unit
/// vector; `view` is the direction from the camera, and the side of the normal does not matter.
pub(super) fn phase(normal: DVec3, view: DVec3, axis: DVec3) -> f64 {
    let reflected = view - 2.0 * view.dot(normal) * normal;
    STRIPES * reflected.normalize_or_zero().dot(axis).clamp(-1.0, 1.0).acos() / PI
}

/// How white a pixel is, from 0 to 1, where the phase changes by `change` over the pixel. Stripes narrower than a pixel are grey.
pub(super) fn whiteness(phase: f64, change: f64) -> f64 {
    // 0 in the middle of a white stripe, 1 in the middle of a black one.
    let distance = (2.0 * phase.rem_euclid(1.0) - 1.0).abs();
    let sharp = ((0.5 - distance) / (2.0 * change).max(f64::MIN_POSITIVE) + 0.5).clamp(0.0, 1.0);
    let greyness = (4.0 * change - 1.0).clamp(0.0, 1.0);
    sharp + greyness * (0.5 - sharp)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_of_a_surface_reflect_alike() {
        let (normal, view) = (DVec3::new(0.3, 0.8, 0.5).normalize(), DVec3::new(0.1, -0.2, -1.0).normalize());
        assert_eq!(phase(normal, view, DVec3::Y), phase(-normal, view, DVec3::Y));
        // A mirror across the view sends the ray back.
        let back = phase(DVec3::Z, DVec3::NEG_Z, DVec3::Y);
        assert!((back - 0.5 * STRIPES).abs() < 1e-12, "{back}: a right angle to the axis");
    }

    #[test]
    fn stripes_alternate_and_narrow_ones_are_grey() {
        assert_eq!([0.5, 1.0, 1.5, 7.0].map(|phase| whiteness(phase, 0.01)), [1.0, 0.0, 1.0, 0.0]);
        assert_eq!(whiteness(0.25, 0.01), 0.5, "the edge of a stripe");
        assert_eq!([0.5, 1.0].map(|phase| whiteness(phase, 0.6)), [0.5, 0.5]);
    }
}
