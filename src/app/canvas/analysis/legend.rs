//! The legend of the curvature: its colours with their numbers.

use super::choice::Shading;
use super::curvature;
use crate::app::theme::overlay;
use egui::{Align, Label, Layout, Rect, RichText, Ui, UiBuilder, pos2, vec2};

/// Size of the legend, screen points.
const SIZE: egui::Vec2 = vec2(230.0, 66.0);
/// Steps of the bar of colours.
const STEPS: usize = 40;

/// Shows the legend in the upper right corner of the canvas.
pub(super) fn legend_ui(ui: &mut Ui, canvas: Rect, shading: Shading, scale: f64) {
    let title = match shading {
        Shading::MeanCurvature => "Mean curvature, per unit",
        Shading::GaussianCurvature => "Gaussian curvature, per unit²",
        Shading::Zebra => return,
    };
    let rect = Rect::from_min_size(canvas.right_top() + vec2(-SIZE.x - 10.0, 10.0), SIZE);
    if !canvas.contains_rect(rect) {
        return;
    }
    let painter = ui.painter_at(canvas);
    painter.rect_filled(rect, 5.0, overlay::LEGEND);
    let bar = Rect::from_min_max(rect.min + vec2(10.0, 26.0), pos2(rect.max.x - 10.0, rect.min.y + 40.0));
    for step in 0..STEPS {
        let [left, right] = [step, step + 1].map(|k| bar.left() + bar.width() * k as f32 / STEPS as f32);
        let value = 2.0 * (step as f64 + 0.5) / STEPS as f64 - 1.0;
        painter.rect_filled(
            Rect::from_min_max(pos2(left, bar.top()), pos2(right, bar.bottom())),
            0.0,
            curvature::color(value),
        );
    }
    let text = |ui: &mut Ui, text: &str| {
        ui.add(Label::new(RichText::new(text).color(overlay::LEGEND_TEXT)).selectable(false));
    };
    let line =
        |top: f32| Rect::from_min_max(pos2(bar.left(), rect.top() + top), pos2(bar.right(), rect.top() + top + 16.0));
    ui.scope_builder(UiBuilder::new().max_rect(line(5.0)), |ui| text(ui, title));
    let places = [(Align::Min, format!("-{scale}")), (Align::Center, "0".to_owned()), (Align::Max, format!("{scale}"))];
    for (align, number) in places {
        let layout = Layout::top_down(align);
        ui.scope_builder(UiBuilder::new().max_rect(line(44.0)).layout(layout), |ui| text(ui, &number));
    }
}
