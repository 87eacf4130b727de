//! The legend of light paths: the colours of the curves; or why there are none.

use super::paint::{EDGES, LINES, Look, WAYS};
use crate::app::theme::overlay;
use egui::{Label, Rect, RichText, Ui, UiBuilder, vec2};

/// Width of the legend, screen points.
const WIDTH: f32 = 210.0;
/// Width of a message, screen points.
const MESSAGE_WIDTH: f32 = 330.0;
/// Height of a row, screen points.
const ROW: f32 = 18.0;
/// Length of the sample of a curve, screen points.
const SAMPLE: f32 = 22.0;
/// The space between the legend and the edges of the canvas, and between its rows and its edges, screen points.
const MARGIN: f32 = 10.0;

/// The curves with what they show.
const ROWS: [(Look, &str); 4] = [
    (LINES[0], "Images of lines of equal u"),
    (LINES[1], "Images of lines of equal v"),
    (EDGES, "Edges of the caustic"),
    (WAYS, "Ways of light"),
];

/// Shows the legend in the upper left corner of the canvas, or in its place a message.
pub(super) fn legend_ui(ui: &mut Ui, canvas: Rect, message: Option<&str>) {
    let rows = if message.is_some() { 1 } else { ROWS.len() };
    let width = if message.is_some() { MESSAGE_WIDTH } else { WIDTH };
    let size = vec2(width, ROW * (rows + 1) as f32 + MARGIN);
    let rect = Rect::from_min_size(canvas.left_top() + vec2(MARGIN, MARGIN), size);
    if !canvas.contains_rect(rect) {
        return;
    }
    ui.painter_at(canvas).rect_filled(rect, 5.0, overlay::LEGEND);
    let inner = rect.shrink2(vec2(MARGIN, 0.5 * MARGIN));
    let row = |k: usize, indent: f32| {
        let left_top = inner.left_top() + vec2(indent, ROW * k as f32);
        Rect::from_min_size(left_top, vec2(inner.width() - indent, ROW))
    };
    text_ui(ui, row(0, 0.0), "Light paths");
    if let Some(message) = message {
        return text_ui(ui, row(1, 0.0), message);
    }
    for (k, (look, text)) in (1..).zip(ROWS) {
        let sample = row(k, 0.0).with_max_x(inner.left() + SAMPLE);
        let color = look.color.to_opaque();
        ui.painter_at(canvas).hline(sample.x_range(), sample.center().y, (look.width, color));
        text_ui(ui, row(k, SAMPLE + 8.0), text);
    }
}

fn text_ui(ui: &mut Ui, rect: Rect, text: &str) {
    ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
        ui.add(Label::new(RichText::new(text).color(overlay::LEGEND_TEXT)).selectable(false));
    });
}
