//! Orbit, pan and dolly of a camera on a turntable: its up axis stays. Knows no pointer.

use crate::scene::{Camera, MAX_LENGTH, MIN_LENGTH};
use glam::{DQuat, DVec3};
use std::f64::consts::PI;

/// Smallest angle between the view direction and the up axis, radians. Along the axis, left and right would be undefined;
/// this angle moves no point of a picture of 1000 pixels by more than a fifth of a pixel.
pub(super) const POLE: f64 = 1e-4;
/// Smallest distance to the target or to a pivot, over the camera's largest coordinate: below it, rounding would shake the
/// view direction.
const NEAREST: f64 = 1e-9;

/// The camera after a turn about `pivot`, which keeps its place in the picture and its distance. `yaw` turns about the up
/// axis, counter-clockwise from above; `pitch` raises the camera, up to the pole above the pivot. Angles in radians.
pub(crate) fn orbited(camera: &Camera, pivot: DVec3, yaw: f64, pitch: f64) -> Camera {
    let Some((forward, right, up)) = axes(camera) else { return *camera };
    let polar = forward.cross(up).length().atan2(forward.dot(up));
    let raised = (polar + pitch).clamp(POLE, PI - POLE) - polar;
    let turn = DQuat::from_axis_angle(up, yaw) * DQuat::from_axis_angle(right, -raised);
    with(camera, |point| pivot + turn * (point - pivot))
}

/// The camera after a move by a vector in world space.
pub(crate) fn moved(camera: &Camera, by: DVec3) -> Camera {
    with(camera, |point| point + by)
}

/// The camera at `factor` times its distance from `pivot`, which keeps its place in the picture. A positive factor keeps the
/// camera on its side of the pivot.
pub(crate) fn dollied(camera: &Camera, pivot: DVec3, factor: f64) -> Camera {
    let near = camera.position.distance(pivot) * factor < least_distance(camera.position);
    if near && factor < 1.0 { *camera } else { with(camera, |point| pivot + factor * (point - pivot)) }
}

/// Unit vectors of the view direction, to the right in the picture and along the up axis; `None` for a camera without
/// direction or up axis. The renderer shows a camera that looks along its up axis with the same right.
pub(super) fn axes(camera: &Camera) -> Option<(DVec3, DVec3, DVec3)> {
    let forward = (camera.target - camera.position).try_normalize()?;
    let up = camera.up.try_normalize()?;
    let right = forward.cross(up).try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
    Some((forward, right, up))
}

/// The camera with its position and target mapped; the camera itself where the result would be no valid camera.
fn with(camera: &Camera, map: impl Fn(DVec3) -> DVec3) -> Camera {
    let mapped = Camera { position: map(camera.position), target: map(camera.target), ..*camera };
    if is_usable(&mapped) { mapped } else { *camera }
}

/// Whether a scene may hold the camera, and its view direction is exact.
pub(super) fn is_usable(camera: &Camera) -> bool {
    let within = |point: DVec3| point.is_finite() && point.abs().max_element() <= MAX_LENGTH;
    let distance = camera.position.distance(camera.target);
    within(camera.position) && within(camera.target) && distance >= least_distance(camera.position)
}

fn least_distance(position: DVec3) -> f64 {
    MIN_LENGTH.max(NEAREST * position.abs().max_element())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::canvas::Projection;
    use crate::scene::Film;
    use glam::DVec2;

    /// A camera above, before and beside the target, in a scene of this size, with a pivot beside the target.
    fn view(size: f64) -> (Camera, DVec3) {
        let position = size * DVec3::new(1.0, 2.0, 4.0);
        let target = size * DVec3::new(0.1, 0.2, -0.3);
        (Camera { position, target, ..Camera::default() }, size * DVec3::new(0.4, -0.2, 0.3))
    }

    fn film_point(camera: &Camera, point: DVec3) -> DVec2 {
        Projection::new(camera, &Film::default()).unwrap().project(point).unwrap()
    }

    #[test]
    fn an_orbit_keeps_the_film_point_and_the_distance_of_the_pivot() {
        for size in [1e-6, 1.0, 1e6] {
            let (camera, pivot) = view(size);
            for (yaw, pitch) in [(0.3, 0.0), (0.0, 0.4), (-2.0, -0.9), (7.0, 0.1)] {
                let turned = orbited(&camera, pivot, yaw, pitch);
                // Film coordinates of size 500 after some fifty roundings.
                let off = film_point(&turned, pivot).distance(film_point(&camera, pivot));
                assert!(off < 1e-10, "{yaw}, {pitch} at size {size}: {off} pixels");
                let (before, after) = (camera.position.distance(pivot), turned.position.distance(pivot));
                assert!((after / before - 1.0).abs() < 1e-14, "{yaw}, {pitch} at size {size}");
                assert_eq!(turned.up, camera.up, "up stays");
            }
        }
    }

    #[test]
    fn a_turn_to_the_left_and_upwards_is_the_rotation_about_the_axes() {
        let (camera, pivot) = (Camera { position: 2.0 * DVec3::Z, ..Camera::default() }, DVec3::ZERO);
        let left = orbited(&camera, pivot, -0.5, 0.0).position;
        assert!(left.distance(2.0 * DVec3::new(-0.5_f64.sin(), 0.0, 0.5_f64.cos())) < 1e-15, "{left}");
        let above = orbited(&camera, pivot, 0.0, 0.5).position;
        assert!(above.distance(2.0 * DVec3::new(0.0, 0.5_f64.sin(), 0.5_f64.cos())) < 1e-15, "{above}");
    }

    #[test]
    fn an_orbit_ends_at_the_poles_without_a_flip() {
        let (camera, pivot) = view(1.0);
        let (_, right, up) = axes(&camera).unwrap();
        for (pitch, pole) in [(100.0, PI - POLE), (-100.0, POLE)] {
            let mut turned = camera;
            for _ in 0..3 {
                turned = orbited(&turned, pivot, 0.0, pitch);
                let (forward, still_right, _) = axes(&turned).unwrap();
                // Of the cross product of vectors that are 1e-4 apart.
                assert!((forward.angle_between(up) - pole).abs() < 1e-7, "{pitch}: {}", forward.angle_between(up));
                assert!(still_right.distance(right) < 1e-10, "{pitch}: {still_right} is not {right}");
            }
            assert!(Projection::new(&turned, &Film::default()).is_some(), "the pole has a picture");
        }
    }

    #[test]
    fn a_camera_that_looks_along_its_up_axis_leaves_it() {
        let camera = Camera { up: DVec3::Z, ..Camera::default() };
        let turned = orbited(&camera, DVec3::ZERO, 0.0, -0.1);
        assert!(turned.position.distance(camera.position) > 0.1 && turned.position.is_finite(), "{turned:?}");
    }

    #[test]
    fn a_dolly_keeps_the_film_point_of_the_pivot_and_the_view_direction() {
        for size in [1e-6, 1.0, 1e6] {
            let (camera, pivot) = view(size);
            for factor in [0.5, 0.9, 3.0] {
                let near = dollied(&camera, pivot, factor);
                let off = film_point(&near, pivot).distance(film_point(&camera, pivot));
                assert!(off < 1e-10, "{factor} at size {size}: {off} pixels");
                let ratio = near.position.distance(pivot) / camera.position.distance(pivot);
                assert!((ratio / factor - 1.0).abs() < 1e-14, "{ratio} is not {factor}");
                let forward = |camera: &Camera| (camera.target - camera.position).normalize();
                assert!(forward(&near).distance(forward(&camera)) < 1e-14, "the direction stays");
            }
        }
    }

    #[test]
    fn no_dolly_passes_the_pivot_or_leaves_the_range_of_a_scene() {
        for size in [1e-6, 1.0, 1e6] {
            let (start, pivot) = view(size);
            for factor in [0.7, 1.4] {
                let mut camera = start;
                for _ in 0..2000 {
                    camera = dollied(&camera, pivot, factor);
                    let (before, after) = (start.position - pivot, camera.position - pivot);
                    assert!(before.dot(after) > 0.0, "{after} is on the other side");
                    assert!(is_usable(&camera), "{camera:?}");
                }
            }
        }
    }

    #[test]
    fn a_camera_without_direction_stays() {
        let camera = Camera { target: Camera::default().position, ..Camera::default() };
        assert_eq!(orbited(&camera, DVec3::ZERO, 1.0, 1.0), camera);
        let (camera, _) = view(1.0);
        assert_eq!(moved(&camera, DVec3::splat(f64::NAN)), camera);
        assert_eq!(moved(&camera, DVec3::splat(2e9)), camera, "beyond the range of a scene");
        assert_eq!(moved(&camera, DVec3::X).target, camera.target + DVec3::X);
    }
}
