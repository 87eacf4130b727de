//! The guide: ten minutes from the first start to a caustic, and a section for each task.

use crate::app::commands::{Action, AppCommand};
use egui::{Align2, Context, Id, Key, Rect, ScrollArea, Window};
use egui_commonmark::{CommonMarkCache, CommonMarkViewer};

/// The text of the guide, Markdown.
const TEXT: &str = include_str!("../../../docs/guide.md");
/// Size of the window, screen points.
const WIDTH: f32 = 460.0;
const HEIGHT: f32 = 560.0;

/// Shows the guide in a window of its own, which opens at the left of `canvas`: the picture stays in use.
pub(crate) fn guide_ui(ctx: &Context, canvas: Rect, cache: &mut CommonMarkCache, commands: &mut Vec<AppCommand>) {
    let mut open = true;
    Window::new("Guide")
        .id(Id::unique("guide"))
        .open(&mut open)
        .pivot(Align2::LEFT_TOP)
        .default_pos(canvas.left_top() + egui::vec2(12.0, 12.0))
        .default_size([WIDTH, HEIGHT.min(canvas.height() - 60.0)])
        .show(ctx, |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| CommonMarkViewer::new().show(ui, cache, TEXT));
        });
    // Escape ends a drag first: egui gives it to the dragged widget.
    let escaped = !ctx.egui_is_using_pointer() && ctx.memory(|memory| memory.focused().is_none());
    if !open || (escaped && ctx.input(|input| input.key_pressed(Key::Escape))) {
        commands.push(AppCommand::Do(Action::ToggleGuide));
    }
}
