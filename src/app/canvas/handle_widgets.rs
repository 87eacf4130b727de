//! The tooltips and accessible names of handles and gizmo. The pointer acts on the canvas, which knows what hides what; the
//! keyboard and assistive technology act on these widgets.

use super::scenery::{Scenery, Target};
use super::stage::{Look, Stage};
use crate::app::commands::AppCommand;
use egui::{Key, Rect, Response, Role, Sense, Ui, Vec2, WidgetInfo, accesskit};

/// Side of the square that shows the tooltip of a part of the gizmo, screen points.
const GRIP: f32 = 14.0;

/// Adds a widget for each handle and for each part of the gizmo; `hot` is under the pointer.
pub(crate) fn ui(
    ui: &mut Ui,
    stage: &Stage<'_>,
    scenery: &Scenery,
    hot: Option<Target>,
    commands: &mut Vec<AppCommand>,
) {
    for drawn in &scenery.drawn {
        let sense = if drawn.look == Look::Faint { Sense::hover() } else { Sense::focusable_noninteractive() };
        let response = ui.interact(drawn.grab_rect(), ui.scope_id().with(drawn.id), sense);
        let label = || drawn.handle.label(stage.document.scene());
        name(&response, label);
        if is_activated(ui, &response) {
            commands.push(AppCommand::Select(stage.clicked(drawn.handle, false)));
        }
        if hot == Some(Target::Handle(drawn.handle)) {
            response.on_hover_text(label());
        }
    }
    for part in scenery.gizmo.iter().flat_map(|gizmo| &gizmo.parts) {
        let grip = Rect::from_center_size(part.grip(), Vec2::splat(GRIP));
        let response = ui.interact(grip, ui.scope_id().with(part.part), Sense::hover());
        name(&response, || part.part.label().to_owned());
        if hot == Some(Target::Part(part.part)) {
            response.on_hover_text(part.part.label());
        }
    }
}

/// Names a widget for assistive technology; the label is made only where there is such.
fn name(response: &Response, label: impl Fn() -> String) {
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label()));
}

/// Whether the keyboard or assistive technology activates a widget that the pointer passes through.
fn is_activated(ui: &Ui, response: &Response) -> bool {
    ui.ctx().accesskit_node_builder(response.id, |node| node.add_action(accesskit::Action::Click));
    let focused = response.has_focus();
    ui.input(|input| {
        input.has_accesskit_action_request(response.id, accesskit::Action::Click)
            || (focused && (input.key_pressed(Key::Enter) || input.key_pressed(Key::Space)))
    })
}
