//! What the user must know now, above the picture: why it is not the scene's, what the window waits for.

use crate::app::commands::AppCommand;
use crate::app::editor::Editor;
use crate::app::theme;
use crate::engine::Status;
use egui::{Color32, Frame, ScrollArea, Ui};

/// Of a long list of problems, screen points: the picture stays in sight.
const MAX_HEIGHT: f32 = 120.0;

/// Nothing where all is well.
pub(crate) fn notices_ui(ui: &mut Ui, editor: &Editor, commands: &mut Vec<AppCommand>) {
    let palette = theme::palette(ui.visuals().dark_mode);
    if let Status::Failed(message) = editor.rendering.status() {
        notice_ui(ui, palette.error, |ui| {
            ui.colored_label(palette.error, format!("⚠ Rendering failed: {message}"));
            ui.label("The scene is unharmed: change it, or restart.");
        });
    }
    if !editor.problems.is_empty() {
        notice_ui(ui, palette.warning, |ui| {
            ui.colored_label(
                palette.warning,
                "⚠ This scene cannot be rendered; the picture shows the last one that could:",
            );
            ScrollArea::vertical().max_height(MAX_HEIGHT).show(ui, |ui| {
                for problem in &editor.problems {
                    ui.label(problem.to_string());
                }
            });
        });
    }
    if let Some(request) = editor.chooser.pending().filter(|_| editor.chooser.is_slow(ui.ctx())) {
        notice_ui(ui, palette.plot, |ui| {
            ui.horizontal(|ui| {
                ui.label(format!("Waiting for the file dialog \"{}\".", request.purpose.title()));
                if ui.button("Type the path instead").clicked() {
                    commands.push(AppCommand::TypePath);
                }
            });
        });
    }
}

fn notice_ui(ui: &mut Ui, edge: Color32, content: impl FnOnce(&mut Ui)) {
    let frame =
        Frame::group(ui.style()).fill(ui.visuals().panel_fill).stroke(egui::Stroke::new(1.0, edge)).outer_margin(4.0);
    frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        content(ui);
    });
}
