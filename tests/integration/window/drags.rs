//! Drags that move control points.

use super::desktop::Desktop;
use super::session::{Session, moved, point};
use glam::DVec3;

/// A control point apart from all others and from the seam.
const POINT: (usize, usize) = (3, 2);

#[test]
fn a_drag_along_the_view_direction_goes_as_far_as_the_same_pixels_sideways() {
    let session = Session::start();
    let start = session.in_file();
    // Almost in the middle of the picture, where the camera sees the axis z end-on.
    let at = session.pixel(point(&start, 1, (0, 2)));
    let expected = 60.0 / Session::pixels_per_unit();
    for (way, key, direction) in
        [((60, 0), &[][..], DVec3::X), ((0, 60), &["z"], DVec3::Z), ((0, -60), &["z"], -DVec3::Z)]
    {
        session.drag(at, way, key);
        let after = session.saved("point that moved", |scene| *scene != start);
        let [(0, (3, 2), one), (1, (0, 2), other)] = moved(&start, &after)[..] else {
            panic!("one point: {:?}", moved(&start, &after))
        };
        assert_eq!(one, other, "the seam stays closed");
        assert!((one - expected * direction).length() < 1e-4, "{way:?} pixels are {one}, not {expected}");
        session.key("ctrl+z");
        session.saved("point at its start", |scene| *scene == start);
    }
}

#[test]
fn an_arrow_of_the_gizmo_moves_along_its_axis_alone() {
    let session = Session::start();
    let start = session.in_file();
    let at = session.pixel(point(&start, 1, POINT));
    session.click(at);
    for (grip, way, axis) in [((54, 0), (60, -40), DVec3::X), ((0, -54), (40, -60), DVec3::Y)] {
        session.drag((at.0 + grip.0, at.1 + grip.1), way, &[]);
        let after = session.saved("point that moved", |scene| *scene != start);
        let [(1, POINT, way)] = moved(&start, &after)[..] else { panic!("one point: {:?}", moved(&start, &after)) };
        let expected = 60.0 / Session::pixels_per_unit() * axis;
        assert_eq!(way - way.dot(axis) * axis, DVec3::ZERO, "it moves along {axis} alone");
        assert!((way - expected).length() < 1e-4, "60 pixels along {axis} are {way}, not {expected}");
        session.key("ctrl+z");
        session.saved("point at its start", |scene| *scene == start);
    }
}

#[test]
fn a_drag_ends_where_the_button_is_released_even_without_a_frame_in_between() {
    let session = Session::start();
    let start = session.in_file();
    let at = session.pixel(point(&start, 1, POINT));
    session.desktop.drag(at, (20, 0));
    let [x, y] = [at.0 + 90, at.1].map(|pixel| pixel.to_string());
    session.desktop.xdotool(&["mousemove", &x, &y, "mouseup", "1"]);
    let after = session.saved("point that moved", |scene| *scene != start);
    let [(1, POINT, way)] = moved(&start, &after)[..] else { panic!("one point: {:?}", moved(&start, &after)) };
    let expected = 90.0 / Session::pixels_per_unit();
    assert!((way.x - expected).abs() < 1e-4, "90 pixels are {way}, not {expected}");
}

#[test]
fn a_drag_moves_a_point_by_the_same_way_on_a_display_with_small_pixels() {
    let session = Session::start_on(Desktop::start_scaled(2));
    let start = session.in_file();
    session.drag(session.pixel(point(&start, 1, POINT)), (60, -30), &[]);
    let after = session.saved("point that moved", |scene| *scene != start);
    let [(1, POINT, way)] = moved(&start, &after)[..] else { panic!("one point: {:?}", moved(&start, &after)) };
    // One screen pixel shows one film pixel here, too.
    let expected = DVec3::new(60.0, 30.0, 0.0) / Session::pixels_per_unit();
    assert!((way - expected).length() < 1e-4, "(60, -30) pixels are {way}, not {expected}");
}
