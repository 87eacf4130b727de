//! Arrow keys move the selection by single screen points.

use super::stage::Stage;
use egui::{Event, InputState, Key, Modifiers};
use glam::DVec3;

/// Screen points of one key press with Shift.
const FAST: f64 = 10.0;
/// The nearest depth that a nudge reaches, as a fraction of the present depth.
const NEAREST: f64 = 0.5;
/// Key presses within this time of each other make one undo step, seconds.
pub(crate) const PAUSE: f64 = 0.8;

/// The way of the keys that were pressed in this frame, in screen points: to the right, upwards, towards the viewer.
pub(crate) fn pressed(input: &InputState) -> DVec3 {
    let presses = input.events.iter().filter_map(|event| match event {
        Event::Key { key, pressed: true, modifiers, .. } => way_of(*key, *modifiers),
        _ => None,
    });
    presses.sum()
}

fn way_of(key: Key, modifiers: Modifiers) -> Option<DVec3> {
    if modifiers.alt {
        return None;
    }
    let way = match key {
        Key::PageUp => DVec3::NEG_Z,
        Key::PageDown => DVec3::Z,
        Key::ArrowUp if modifiers.command => DVec3::NEG_Z,
        Key::ArrowDown if modifiers.command => DVec3::Z,
        Key::ArrowUp => DVec3::Y,
        Key::ArrowDown => DVec3::NEG_Y,
        Key::ArrowRight if !modifiers.command => DVec3::X,
        Key::ArrowLeft if !modifiers.command => DVec3::NEG_X,
        _ => return None,
    };
    Some(if modifiers.shift { FAST * way } else { way })
}

/// The world vector of a way in screen points, from `at`: across the view in the plane that faces the camera, and in depth along
/// the camera ray, by as much as the same points across. `None` behind the camera.
pub(crate) fn world_way(stage: &Stage<'_>, at: DVec3, points: DVec3) -> Option<DVec3> {
    let (film, depth) = (stage.projection.project(at)?, stage.projection.depth(at));
    let pixels = points / f64::from(stage.transform.scale);
    let across = stage.projection.unproject(film + glam::DVec2::new(pixels.x, -pixels.y), depth) - at;
    let away = stage.projection.sight(at).direction;
    let nearer = (points.z / stage.points_per_unit(at) / away.length()).min(1.0 - NEAREST);
    Some(without_rounding(across - nearer * away))
}

/// The way without components that are only rounding: a coordinate of 0 stays 0.
fn without_rounding(way: DVec3) -> DVec3 {
    let least = 1e-9 * way.abs().max_element();
    DVec3::select(way.abs().cmplt(DVec3::splat(least)), DVec3::ZERO, way)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_no_way() {
        assert_eq!(without_rounding(DVec3::new(6.9e-18, 0.01, -2e-12)), DVec3::new(0.0, 0.01, 0.0));
        assert_eq!(without_rounding(DVec3::new(1e-18, 0.0, 2e-18)), DVec3::new(1e-18, 0.0, 2e-18));
    }

    #[test]
    fn keys_give_the_way() {
        let way = |key, modifiers| way_of(key, modifiers);
        assert_eq!(way(Key::ArrowLeft, Modifiers::NONE), Some(DVec3::NEG_X));
        assert_eq!(way(Key::ArrowUp, Modifiers::SHIFT), Some(10.0 * DVec3::Y));
        assert_eq!(way(Key::ArrowUp, Modifiers::COMMAND), Some(DVec3::NEG_Z), "away from the viewer");
        assert_eq!(way(Key::PageDown, Modifiers::SHIFT), Some(10.0 * DVec3::Z));
        assert_eq!(way(Key::ArrowLeft, Modifiers::ALT), None, "belongs to the views");
        assert_eq!(way(Key::A, Modifiers::NONE), None);
    }
}
