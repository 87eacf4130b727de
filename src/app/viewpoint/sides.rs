//! The camera on a side of its target: front, right, top, opposite.

use super::named_view::Side;
use super::turntable::{POLE, is_usable};
use crate::scene::Camera;
use glam::DVec3;

/// The camera on this side of its target, at its present distance; at distance 1 where it has no usable one.
pub(crate) fn seen_from(camera: &Camera, side: Side) -> Camera {
    let up = camera.up.try_normalize().unwrap_or(DVec3::Y);
    let (front, right) = front_and_right(up);
    let distance = if is_usable(camera) { camera.position.distance(camera.target) } else { 1.0 };
    let direction = match side {
        Side::Front => front,
        Side::Right => right,
        // Exactly above, the up axis would point at the viewer.
        Side::Top => POLE.cos() * up + POLE.sin() * front,
        Side::Opposite => (camera.target - camera.position).try_normalize().unwrap_or(-front),
    };
    let up = if camera.up.try_normalize().is_some() { camera.up } else { up };
    Camera { position: camera.target + distance * direction, up, ..*camera }
}

/// The directions towards the front and to the right, across the up axis.
fn front_and_right(up: DVec3) -> (DVec3, DVec3) {
    let z_is_up = up.z.abs() > up.x.abs().max(up.y.abs());
    let front = if z_is_up { DVec3::NEG_Y } else { DVec3::Z };
    // Across any direction that is not along `up`; the front never is.
    let right = up.cross(front).normalize_or(DVec3::X);
    (right.cross(up), right)
}

#[cfg(test)]
mod tests {
    use super::super::turntable::axes;
    use super::*;

    fn camera(up: DVec3) -> Camera {
        Camera { position: DVec3::new(1.0, 2.0, 3.0), target: DVec3::new(1.0, 1.0, 1.0), up, ..Camera::default() }
    }

    #[test]
    fn sides_lie_on_the_axes() {
        let distance = 5.0_f64.sqrt();
        for (up, side, direction, right) in [
            (DVec3::Y, Side::Front, DVec3::Z, DVec3::X),
            (DVec3::Y, Side::Right, DVec3::X, DVec3::NEG_Z),
            (DVec3::Y, Side::Top, DVec3::Y, DVec3::X),
            (DVec3::Z, Side::Front, DVec3::NEG_Y, DVec3::X),
            (DVec3::Z, Side::Right, DVec3::X, DVec3::Y),
            (DVec3::Z, Side::Top, DVec3::Z, DVec3::X),
        ] {
            let seen = seen_from(&camera(up), side);
            // The top is a pole of the turntable, which the camera does not reach.
            let off = seen.position.distance(seen.target + distance * direction);
            assert!(off <= 1.001 * distance * POLE, "{side:?} with {up} up: {}", seen.position);
            assert!(axes(&seen).unwrap().1.distance(right) < 1e-12, "{side:?} with {up} up shows {right} on the right");
            assert!((seen.position.distance(seen.target) - distance).abs() < 1e-14, "at its distance");
        }
    }

    #[test]
    fn the_opposite_of_the_opposite_is_the_view_itself() {
        let camera = camera(DVec3::Y);
        let opposite = seen_from(&camera, Side::Opposite);
        assert!((opposite.position + camera.position - 2.0 * camera.target).length() < 1e-14, "{opposite:?}");
        assert!(seen_from(&opposite, Side::Opposite).position.distance(camera.position) < 1e-14);
    }

    #[test]
    fn a_camera_without_direction_gets_one() {
        let lost = Camera { target: Camera::default().position, up: DVec3::ZERO, ..Camera::default() };
        for side in [Side::Front, Side::Right, Side::Top, Side::Opposite] {
            assert!(axes(&seen_from(&lost, side)).is_some(), "{side:?}");
        }
    }
}
