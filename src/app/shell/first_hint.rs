//! The hint for a first start: what to drag, and where the keys are listed.

use crate::app::commands::{Action, AppCommand};
use crate::app::theme;
use egui::{Align2, Area, Frame, Id, Rect, Stroke, Ui, vec2};

/// Shows the hint at the lower edge of the canvas.
pub(crate) fn first_hint_ui(ui: &Ui, canvas: Rect, commands: &mut Vec<AppCommand>) {
    let at = canvas.center_bottom() - vec2(0.0, 14.0);
    Area::new(Id::unique("first hint")).pivot(Align2::CENTER_BOTTOM).fixed_pos(at).show(ui.ctx(), |ui| {
        let edge = Stroke::new(1.0, theme::palette(ui.visuals().dark_mode).plot);
        Frame::popup(ui.style()).stroke(edge).show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label("Drag a dot of the surface, and watch its light.");
                ui.separator();
                for (action, text) in [(Action::Help, "keys and mouse"), (Action::Palette, "all commands")] {
                    ui.strong(action.shortcut(ui.ctx()));
                    ui.label(text);
                }
                if ui.small_button("✖").accessible_name("Close the hint").on_hover_text("Close the hint").clicked() {
                    commands.push(AppCommand::CloseHint);
                }
            });
        });
    });
}
