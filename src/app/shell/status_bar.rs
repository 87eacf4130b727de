//! The status bar: the engine's status and counts, the pixel under the pointer, the zoom.

use crate::app::canvas::Canvas;
use crate::app::panels::{duration, grouped};
use crate::app::rendering::Rendering;
use crate::app::theme;
use crate::engine::{Frame, Status};
use crate::math::Rgb;
use crate::scene::Film;
use egui::{Align, Color32, Layout, Ui};

/// The status bar: status and counts on the left, pixel and zoom on the right.
pub(crate) fn status_bar_ui(ui: &mut Ui, film: &Film, rendering: &Rendering, canvas: &Canvas) {
    ui.horizontal(|ui| {
        let (text, color) = status_text(ui, rendering);
        ui.colored_label(color, text);
        if let Some(frame) = rendering.frame() {
            ui.separator();
            ui.label(progress_text(frame));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let zoom = canvas.transform.map_or(1.0, |transform| transform.scale * ui.ctx().pixels_per_point());
            ui.label(format!("{} × {} at {:.0} %", film.width, film.height, 100.0 * zoom));
            if let Some(text) = canvas.pixel.and_then(|pixel| pixel_text(pixel, film, rendering.frame()?)) {
                ui.separator();
                ui.monospace(text);
            }
        });
    });
}

fn status_text(ui: &Ui, rendering: &Rendering) -> (&'static str, Color32) {
    let palette = theme::palette(ui.visuals().dark_mode);
    match rendering.status() {
        Status::Failed(_) => ("Failed", palette.error),
        // The engine still renders the last valid scene.
        _ if !rendering.problems().is_empty() => ("Waiting for a valid scene", palette.warning),
        Status::Idle => ("Idle", ui.visuals().weak_text_color()),
        Status::Preparing => ("Preparing", palette.warning),
        Status::Rendering if rendering.is_paused() => ("Pausing after this iteration", palette.warning),
        Status::Rendering => ("Rendering", palette.success),
        Status::Paused => ("Paused", palette.warning),
        Status::Converged => ("Converged", palette.success),
        Status::LimitReached => ("Stopped at the limit", palette.success),
    }
}

fn progress_text(frame: &Frame) -> String {
    let smoothed = if frame.smoothed { ", smoothed" } else { "" };
    if frame.draft {
        return format!("draft{smoothed}");
    }
    let stats = &frame.stats;
    let missing = stats.missing_light.map_or(String::new(), |missing| format!("; {missing}"));
    format!(
        "iteration {}, {}, {} photons{smoothed}{missing}",
        grouped(frame.iteration),
        duration(stats.seconds),
        grouped(stats.photons_emitted)
    )
}

/// Column, row and linear RGB of a film pixel. A draft may have fewer pixels than the film.
fn pixel_text((x, y): (u32, u32), film: &Film, frame: &Frame) -> Option<String> {
    let image = &frame.image;
    let column = u64::from(x) * u64::from(image.width) / u64::from(film.width.max(1));
    let row = u64::from(y) * u64::from(image.height) / u64::from(film.height.max(1));
    let Rgb { x: red, y: green, z: blue } = *image.pixels.get((row * u64::from(image.width) + column) as usize)?;
    Some(format!("pixel ({x}, {y})  RGB {red:.4} {green:.4} {blue:.4}"))
}
