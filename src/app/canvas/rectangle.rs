//! Selection of control points by a rectangle.

use super::stage::{Look, ScreenHandle, Stage};
use crate::app::document::{Handle, Selection};
use crate::app::theme::overlay;
use egui::{Painter, Rect, Stroke, StrokeKind};

/// The selection with the control points in a rectangle of the screen; with `extend` the selected points stay selected. Hidden
/// points stay out.
pub(crate) fn selected(stage: &Stage<'_>, drawn: &[ScreenHandle], within: Rect, extend: bool) -> Selection {
    let mut selection = stage.document.selection.clone();
    if !extend {
        selection.points.clear();
    }
    let inside = drawn.iter().filter(|drawn| drawn.look != Look::Hidden && within.contains(drawn.screen));
    let points = inside.filter_map(|drawn| match drawn.handle {
        Handle::Point { point, .. } => Some(point),
        Handle::Object(_) | Handle::Light(_) => None,
    });
    selection.points.extend(points);
    selection
}

/// Paints the rectangle while the pointer draws it.
pub(crate) fn paint(painter: &Painter, rect: Rect) {
    painter.rect_filled(rect, 0.0, overlay::HOVERED.gamma_multiply(0.12));
    painter.rect_stroke(rect, 0.0, Stroke::new(3.0, overlay::OUTLINE), StrokeKind::Middle);
    painter.rect_stroke(rect, 0.0, Stroke::new(1.0, overlay::HOVERED), StrokeKind::Middle);
}
