//! A second picture to the right of a line, which the pointer drags.

use super::view::ScreenTransform;
use crate::app::commands::{AppCommand, SnapshotCommand};
use crate::app::theme::overlay;
use egui::{Color32, CursorIcon, Id, Pos2, Rect, Role, Sense, Stroke, TextureHandle, Ui, WidgetInfo, pos2};

/// Width of the strip around the line that takes the pointer, screen points.
const GRIP: f32 = 12.0;
/// Radius of the disc on the line, screen points.
const DISC: f32 = 7.0;

/// Paints the second picture to the right of the line at this part of the picture's width.
pub(super) fn paint_beside(ui: &Ui, transform: &ScreenTransform, texture: &TextureHandle, split: f32) {
    let picture = transform.picture();
    let right = Rect::from_min_max(pos2(line_x(picture, split), picture.top()), picture.max);
    let part = Rect::from_min_max(pos2(split, 0.0), Pos2::new(1.0, 1.0));
    ui.painter_at(transform.canvas).image(texture.id(), right, part, Color32::WHITE);
}

/// Shows the line, and moves it with the pointer. Call it after the widget of the canvas, over which it lies.
pub(super) fn split_ui(ui: &Ui, transform: &ScreenTransform, split: f32, commands: &mut Vec<AppCommand>) {
    let picture = transform.picture();
    let visible = picture.intersect(transform.canvas);
    // The part of a magnified picture may have the line outside: then the line waits at the border.
    let x = line_x(picture, split).clamp(visible.left(), visible.right());
    let grip = Rect::from_center_size(pos2(x, visible.center().y), egui::vec2(GRIP, visible.height()));
    let response = ui.interact(grip, Id::unique("split"), Sense::drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Splitter, true, "Line between two pictures"));
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        let split = ((pointer.x - picture.left()) / picture.width()).clamp(0.0, 1.0);
        commands.push(AppCommand::Snapshot(SnapshotCommand::Split(split)));
    }
    let is_held = response.dragged() || response.hovered();
    if is_held {
        ui.set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    let painter = ui.painter_at(transform.canvas);
    let color = if is_held { overlay::HOVERED } else { overlay::HANDLE };
    for (width, color) in [(4.0, overlay::OUTLINE), (1.5, color)] {
        painter.vline(x, visible.y_range(), Stroke::new(width, color));
    }
    painter.circle(pos2(x, visible.center().y), DISC, color, Stroke::new(1.5, overlay::OUTLINE));
}

fn line_x(picture: Rect, split: f32) -> f32 {
    picture.left() + split * picture.width()
}
