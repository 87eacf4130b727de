//! Patches that stay together.

use super::session::{Session, moved, patches, point};
use glam::DVec3;
use patchlight::scene::Scene;

/// The upper end of the seam: P[3][3] of the first patch and P[0][3] of the second.
const CORNERS: [(usize, (usize, usize)); 2] = [(0, (3, 3)), (1, (0, 3))];

fn assert_closed(scene: &Scene) {
    for j in 0..4 {
        assert_eq!(patches(scene)[0].points[3][j], patches(scene)[1].points[0][j], "the seam is closed at {j}");
    }
}

#[test]
fn a_seam_stays_closed_under_the_mouse_and_under_keys() {
    let session = Session::start();
    let start = session.in_file();
    let corner = point(&start, 1, (0, 3));
    session.drag(session.pixel(corner), (30, -50), &[]);
    let dragged = session.saved("corner that moved", |scene| *scene != start);
    assert_closed(&dragged);
    let way = DVec3::new(30.0, 50.0, 0.0) / Session::pixels_per_unit();
    let both = moved(&start, &dragged);
    assert_eq!(both.iter().map(|(patch, index, _)| (*patch, *index)).collect::<Vec<_>>(), CORNERS);
    assert!(both.iter().all(|(.., by)| by.distance(way) < 1e-4), "{both:?} is not {way}");

    session.key("shift+Right");
    let nudged = session.saved("corner that keys moved", |scene| *scene != dragged);
    assert_closed(&nudged);
    let both = moved(&dragged, &nudged);
    assert_eq!(both.len(), 2, "both corners: {both:?}");
    let step = 10.0 / Session::pixels_per_unit();
    assert!(both.iter().all(|(.., by)| by.distance(step * DVec3::X) < 1e-4), "{both:?} are not ten pixels");
}
