//! Navigation: drags and the wheel orbit, pan and dolly the camera.

use super::stage::Stage;
use crate::app::commands::AppCommand;
use crate::app::theme::overlay;
use crate::app::viewpoint::{center, dollied, moved, of_selection, orbited};
use crate::scene::Camera;
use egui::{CursorIcon, Key, Modifiers, PointerButton, Pos2, Response, Stroke, Ui, Vec2};
use glam::DVec3;

/// Angle of an orbit per screen point of the drag, radians: 180 degrees are 450 points.
const ORBIT_SPEED: f64 = 0.007;
/// Logarithm of the distance's ratio per screen point of a dolly drag.
const DOLLY_SPEED: f64 = 0.006;
/// Logarithm of the distance's ratio per screen point of scrolling.
const WHEEL_SPEED: f64 = 0.003;
/// Wheel steps within this time of each other are one gesture, seconds.
const WHEEL_PAUSE: f64 = 0.5;

/// How a drag moves the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Motion {
    /// Around the pivot.
    Orbit,
    /// Across the view direction: the pivot stays under the pointer.
    Pan,
    /// Towards the pivot or away from it.
    Dolly,
}

impl Motion {
    /// The name of the motion, in the history.
    fn name(self) -> &'static str {
        match self {
            Self::Orbit => "orbit view",
            Self::Pan => "pan view",
            Self::Dolly => "move view nearer or farther",
        }
    }
}

/// A drag that moves the camera.
#[derive(Clone, Copy, Debug)]
struct CameraDrag {
    motion: Motion,
    pivot: DVec3,
    /// The pointer when the camera moved last, screen points.
    pointer: Pos2,
}

/// A turn of the wheel that moves the camera.
#[derive(Clone, Copy, Debug)]
struct WheelTurn {
    pivot: DVec3,
    pointer: Pos2,
    /// Time of the last step, seconds.
    time: f64,
}

/// Navigation with the mouse.
#[derive(Debug, Default)]
pub(crate) struct Navigation {
    /// Whether plain drags and the wheel move the camera, not only with Alt held.
    pub(crate) always: bool,
    drag: Option<CameraDrag>,
    wheel: Option<WheelTurn>,
}

impl Navigation {
    /// Whether the pointer moves the camera now, so that handles do not take it.
    pub(crate) fn takes_pointer(&self, ui: &Ui) -> bool {
        self.always || self.drag.is_some() || ui.input(|input| input.modifiers.alt)
    }

    /// Whether the wheel has turned within the last moment: a next step belongs to the same gesture.
    pub(crate) fn is_wheel_turning(&self, time: f64) -> bool {
        self.wheel.is_some_and(|turn| time < turn.time + WHEEL_PAUSE)
    }

    /// Moves the camera by drags and the wheel on the canvas. Returns whether it took the pointer.
    pub(super) fn navigate(
        &mut self,
        ui: &Ui,
        stage: &Stage<'_>,
        camera: &Camera,
        canvas: &Response,
        commands: &mut Vec<AppCommand>,
    ) -> bool {
        if !ui.is_enabled() {
            *self = Self { always: self.always, ..Self::default() };
            return false;
        }
        self.begin(ui, stage, camera, canvas);
        if self.drag.is_some() && ui.input(|input| input.key_pressed(Key::Escape)) {
            self.drag = None;
            commands.push(AppCommand::CancelDrag);
        }
        if let Some(drag) = &mut self.drag {
            if let Some(pointer) = canvas.interact_pointer_pos() {
                let next = drag.camera(stage, camera, pointer);
                drag.pointer = pointer;
                commands.extend((next != *camera).then_some(AppCommand::View(next, drag.motion.name())));
            }
            drag.show(ui, stage);
        }
        if canvas.drag_stopped() {
            self.drag = None;
        }
        self.turn(ui, stage, camera, canvas, commands) || self.drag.is_some()
    }

    fn begin(&mut self, ui: &Ui, stage: &Stage<'_>, camera: &Camera, canvas: &Response) {
        let buttons = [PointerButton::Primary, PointerButton::Middle, PointerButton::Secondary];
        let Some(button) = buttons.into_iter().find(|button| canvas.drag_started_by(*button)) else { return };
        let (modifiers, origin) = ui.input(|input| (input.modifiers, input.pointer.press_origin()));
        let Some((motion, pointer)) = motion(button, modifiers, self.always).zip(origin) else { return };
        let selected = (motion == Motion::Orbit).then(|| selection_center(stage)).flatten();
        let pivot = selected.unwrap_or_else(|| match motion {
            Motion::Orbit => picked(stage, pointer).unwrap_or(camera.target),
            Motion::Pan | Motion::Dolly => point_under(stage, camera, pointer),
        });
        self.drag = Some(CameraDrag { motion, pivot, pointer });
    }

    /// Dollies towards the pointer with the wheel. Returns whether it took the wheel.
    fn turn(
        &mut self,
        ui: &Ui,
        stage: &Stage<'_>,
        camera: &Camera,
        canvas: &Response,
        commands: &mut Vec<AppCommand>,
    ) -> bool {
        let (scroll, time, pointer, alt) = ui
            .input(|input| (input.smooth_scroll_delta().y, input.time, input.pointer.hover_pos(), input.modifiers.alt));
        let Some(pointer) = pointer.filter(|_| canvas.contains_pointer() && scroll != 0.0) else { return false };
        // The wheel scrolls smoothly over some frames; Alt may be released before the last.
        let goes_on = self.wheel.filter(|turn| turn.pointer == pointer && self.is_wheel_turning(time));
        if !(alt || self.always || goes_on.is_some()) {
            return false;
        }
        let pivot = goes_on.map_or_else(|| point_under(stage, camera, pointer), |turn| turn.pivot);
        self.wheel = Some(WheelTurn { pivot, pointer, time });
        let next = dollied(camera, pivot, (-WHEEL_SPEED * f64::from(scroll)).exp());
        commands.extend((next != *camera).then_some(AppCommand::View(next, Motion::Dolly.name())));
        // The gesture ends by a frame after the pause.
        ui.request_repaint_after_secs(WHEEL_PAUSE as f32);
        true
    }
}

impl CameraDrag {
    /// The camera after the pointer moved to `pointer`.
    fn camera(&self, stage: &Stage<'_>, camera: &Camera, pointer: Pos2) -> Camera {
        let Vec2 { x, y } = pointer - self.pointer;
        let (x, y) = (f64::from(x), f64::from(y));
        match self.motion {
            Motion::Orbit => orbited(camera, self.pivot, -ORBIT_SPEED * x, ORBIT_SPEED * y),
            Motion::Dolly => dollied(camera, self.pivot, (DOLLY_SPEED * (y - x)).exp()),
            Motion::Pan => {
                let depth = stage.projection.depth(self.pivot);
                let at = |screen| stage.projection.unproject(stage.transform.to_film(screen), depth);
                moved(camera, at(self.pointer) - at(pointer))
            }
        }
    }

    /// Marks the pivot.
    fn show(&self, ui: &Ui, stage: &Stage<'_>) {
        ui.set_cursor_icon(match self.motion {
            Motion::Orbit => CursorIcon::AllScroll,
            Motion::Pan => CursorIcon::Grabbing,
            Motion::Dolly => CursorIcon::ZoomIn,
        });
        if let Some(at) = stage.screen(self.pivot) {
            let painter = ui.painter_at(stage.transform.canvas);
            painter.circle_stroke(at, 6.0, Stroke::new(3.5, overlay::OUTLINE));
            painter.circle_stroke(at, 6.0, Stroke::new(1.5, overlay::HOVERED));
            painter.circle_filled(at, 1.5, overlay::HOVERED);
        }
    }
}

/// The motion that a drag with this button starts; `None` for a drag that does not move the camera.
fn motion(button: PointerButton, modifiers: Modifiers, always: bool) -> Option<Motion> {
    match button {
        _ if !(modifiers.alt || always) => None,
        PointerButton::Primary if modifiers.shift => Some(Motion::Pan),
        PointerButton::Primary => Some(Motion::Orbit),
        PointerButton::Middle => Some(Motion::Pan),
        PointerButton::Secondary if modifiers.alt => Some(Motion::Dolly),
        PointerButton::Secondary => Some(Motion::Pan),
        _ => None,
    }
}

/// The centre of the selection; `None` behind the camera and for a selection without extent.
fn selection_center(stage: &Stage<'_>) -> Option<DVec3> {
    let center = center(&of_selection(stage.document.scene(), &stage.document.selection))?;
    stage.projection.project(center).map(|_| center)
}

/// The nearest surface point under the pointer; `None` beside all objects.
fn picked(stage: &Stage<'_>, pointer: Pos2) -> Option<DVec3> {
    let ray = stage.projection.ray(stage.transform.to_film(pointer));
    stage.sight.surfaces.nearest(&ray).map(|pick| ray.at(pick.distance))
}

/// The nearest surface point under the pointer; beside all objects, the point in the target's depth.
fn point_under(stage: &Stage<'_>, camera: &Camera, pointer: Pos2) -> DVec3 {
    let in_depth = || {
        let depth = stage.projection.depth(camera.target);
        stage.projection.unproject(stage.transform.to_film(pointer), depth)
    };
    picked(stage, pointer).unwrap_or_else(in_depth)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buttons_and_keys_choose_the_motion() {
        use PointerButton::{Middle, Primary, Secondary};
        let alt_shift = Modifiers::ALT | Modifiers::SHIFT;
        for (button, modifiers, with_alt, always) in [
            (Primary, Modifiers::NONE, None, Some(Motion::Orbit)),
            (Middle, Modifiers::NONE, None, Some(Motion::Pan)),
            (Secondary, Modifiers::NONE, None, Some(Motion::Pan)),
            (Primary, Modifiers::SHIFT, None, Some(Motion::Pan)),
            (Primary, Modifiers::ALT, Some(Motion::Orbit), Some(Motion::Orbit)),
            (Primary, alt_shift, Some(Motion::Pan), Some(Motion::Pan)),
            (Middle, Modifiers::ALT, Some(Motion::Pan), Some(Motion::Pan)),
            (Secondary, Modifiers::ALT, Some(Motion::Dolly), Some(Motion::Dolly)),
        ] {
            assert_eq!(motion(button, modifiers, false), with_alt, "{button:?} with {modifiers:?}");
            assert_eq!(motion(button, modifiers, true), always, "{button:?} with {modifiers:?}, navigating");
        }
    }
}
