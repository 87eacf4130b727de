//! The list of undo steps: a click goes back or forward to the state after a step.

use crate::app::commands::{Action, AppCommand};
use crate::app::document::Document;
use egui::{Align, Align2, Context, Id, Key, Rect, RichText, ScrollArea, Ui, Window};

/// Size of the list, screen points.
const WIDTH: f32 = 230.0;
const HEIGHT: f32 = 280.0;

/// Shows the list of undo steps in a small window, which opens at the top right of `canvas`.
pub(crate) fn history_ui(ctx: &Context, canvas: Rect, document: &Document, commands: &mut Vec<AppCommand>) {
    let mut open = true;
    Window::new("History")
        .id(Id::unique("history"))
        .open(&mut open)
        .pivot(Align2::RIGHT_TOP)
        .default_pos(canvas.right_top() + egui::vec2(-12.0, 12.0))
        .default_size([WIDTH, HEIGHT])
        .show(ctx, |ui| ScrollArea::vertical().auto_shrink(false).show(ui, |ui| steps_ui(ui, document, commands)));
    // Escape ends a drag first: egui gives it to the dragged widget.
    let escaped = !ctx.egui_is_using_pointer() && ctx.memory(|memory| memory.focused().is_none());
    if !open || (escaped && ctx.input(|input| input.key_pressed(Key::Escape))) {
        commands.push(AppCommand::Do(Action::ToggleHistory));
    }
}

/// One row for the oldest state, and one for the state after each step; undone steps are weak.
fn steps_ui(ui: &mut Ui, document: &Document, commands: &mut Vec<AppCommand>) {
    let present = document.done_steps();
    let rows = std::iter::once("Start").chain(document.steps());
    for (done, name) in rows.enumerate() {
        let text = if done > present { RichText::new(name).weak() } else { RichText::new(name) };
        let row = ui.selectable_label(done == present, text);
        if row.clicked() {
            commands.push(AppCommand::GoTo(done));
        }
        if done == present && is_new(ui, present, document.steps().count()) {
            row.scroll_to_me(Some(Align::Center));
        }
    }
}

/// Whether the list or its present step has changed since the last frame: the list then scrolls to the present step.
fn is_new(ui: &Ui, present: usize, steps: usize) -> bool {
    let id = Id::unique("history position");
    ui.data_mut(|data| {
        let before = data.get_temp(id);
        data.insert_temp(id, (present, steps));
        before != Some((present, steps))
    })
}
