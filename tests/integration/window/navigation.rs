//! Drags that move the camera.

use super::session::{DISTANCE, Session};
use glam::DVec3;
use patchlight::scene::{Camera, Scene};

/// Angle of an orbit per pixel of the drag, radians.
const SPEED: f64 = 0.007;

#[test]
fn an_alt_drag_turns_the_camera_around_the_selection_and_a_key_brings_the_view_back() {
    let session = Session::start();
    let start = session.in_file().camera;
    let corner = session.pixel(DVec3::new(-1.3, 1.3, 0.0));
    let left = |scene: &Scene| scene.camera != start;

    session.drag(corner, (100, 0), &["alt"]);
    let aside = session.saved("camera that moved aside", left).camera;
    let turn = 100.0 * SPEED;
    let expected = DISTANCE * DVec3::new(-turn.sin(), 0.0, turn.cos());
    // The steps of the drag round.
    assert!(aside.position.distance(expected) < 1e-9, "{} is not {expected}", aside.position);
    assert!(aside.target.length() < 1e-9, "the centre of the patches stays in the middle: {}", aside.target);

    session.drag(corner, (0, 80), &["alt"]);
    let above = session.saved("camera that moved up", |scene| scene.camera != aside).camera;
    assert!((above.position.length() - DISTANCE).abs() < 1e-9, "it stays on the sphere: {}", above.position);
    let height = (above.position.y / DISTANCE).asin();
    assert!((height - 80.0 * SPEED).abs() < 1e-9, "80 pixels are an angle of {height}");
    let azimuth = |camera: &Camera| camera.position.x.atan2(camera.position.z);
    assert!((azimuth(&above) - azimuth(&aside)).abs() < 1e-9, "it stays above the same place");

    session.key("alt+Left");
    session.saved("camera of the view before", |scene| scene.camera == aside);
    session.key("alt+Left");
    session.saved("camera of the start", |scene| scene.camera == start);
    session.key("alt+Right");
    session.saved("camera of the view after", |scene| scene.camera == aside);
}
