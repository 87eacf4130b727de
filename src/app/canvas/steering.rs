//! The keys that steer a drag of handles, and where it ends.

use super::drag::Constraint;
use egui::{Event, Key, PointerButton, Pos2, Ui};
use glam::DVec3;

/// The keys that steer a drag.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Steering {
    /// The constraint of the axis key that is held down.
    pub(super) axis: Option<Constraint>,
    /// Whether the handles snap to the grid.
    pub(super) snaps: bool,
}

impl Steering {
    /// The steering of the keys that are held down, with the surface normal where there is one.
    pub(super) fn of_keys(ui: &Ui, normal: Option<DVec3>) -> Self {
        Self { axis: axis_key(ui, normal), snaps: ui.input(|input| input.modifiers.command) }
    }
}

/// Where the primary button was released in this frame, screen points; `None` where it was not.
pub(super) fn released_at(ui: &Ui) -> Option<Pos2> {
    let released = |event: &Event| match event {
        Event::PointerButton { pos, button: PointerButton::Primary, pressed: false, .. } => Some(*pos),
        _ => None,
    };
    ui.input(|input| input.events.iter().find_map(released))
}

/// The constraint of the axis key that is held down: X, Y, Z, or N for the surface normal.
fn axis_key(ui: &Ui, normal: Option<DVec3>) -> Option<Constraint> {
    let keys = [(Key::X, Some(DVec3::X)), (Key::Y, Some(DVec3::Y)), (Key::Z, Some(DVec3::Z)), (Key::N, normal)];
    let held = ui.input(|input| keys.into_iter().find(|(key, _)| input.key_down(*key)));
    held.and_then(|(_, axis)| axis).map(Constraint::Axis)
}
