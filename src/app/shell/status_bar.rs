//! The line at the bottom: what the engine does, what is under the pointer.

use crate::app::editor::Editor;
use crate::app::panels::{duration, grouped};
use crate::app::rendering::Rendering;
use crate::app::theme;
use crate::engine::{Frame, Status};
use crate::math::Rgb;
use egui::{Align, Color32, Layout, Ui};

/// Status and counts on the left, pixel and zoom on the right.
pub(crate) fn status_bar_ui(ui: &mut Ui, editor: &Editor) {
    ui.horizontal(|ui| {
        let (text, color) = status_text(ui, &editor.rendering);
        ui.colored_label(color, text);
        if let Some(frame) = editor.rendering.frame() {
            ui.separator();
            ui.label(progress_text(frame));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let film = editor.document.scene().film;
            let zoom = editor.canvas.placement.map_or(1.0, |placement| placement.scale * ui.ctx().pixels_per_point());
            ui.label(format!("{} × {} at {:.0} %", film.width, film.height, 100.0 * zoom));
            if let Some(text) = pixel_text(editor) {
                ui.separator();
                ui.monospace(text);
            }
        });
    });
}

fn status_text(ui: &Ui, rendering: &Rendering) -> (&'static str, Color32) {
    let palette = theme::palette(ui.visuals().dark_mode);
    match rendering.status() {
        Status::Idle => ("Idle", ui.visuals().weak_text_color()),
        Status::Preparing => ("Preparing", palette.warning),
        Status::Rendering if rendering.paused => ("Pausing after this iteration", palette.warning),
        Status::Rendering => ("Rendering", palette.success),
        Status::Paused => ("Paused", palette.warning),
        Status::Converged => ("Converged", palette.success),
        Status::Failed(_) => ("Failed", palette.error),
    }
}

fn progress_text(frame: &Frame) -> String {
    if frame.draft {
        return "draft".to_owned();
    }
    let stats = &frame.stats;
    format!(
        "iteration {}, {}, {} photons",
        grouped(frame.iteration),
        duration(stats.seconds),
        grouped(stats.photons_emitted)
    )
}

/// Place and linear value of the pixel under the pointer. A draft may have fewer pixels than the film.
fn pixel_text(editor: &Editor) -> Option<String> {
    let ((x, y), film) = (editor.canvas.pixel?, editor.document.scene().film);
    let image = &editor.rendering.frame()?.image;
    let column = u64::from(x) * u64::from(image.width) / u64::from(film.width.max(1));
    let row = u64::from(y) * u64::from(image.height) / u64::from(film.height.max(1));
    let Rgb { x: red, y: green, z: blue } = *image.pixels.get((row * u64::from(image.width) + column) as usize)?;
    Some(format!("pixel ({x}, {y})  RGB {red:.4} {green:.4} {blue:.4}"))
}
