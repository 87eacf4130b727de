//! The first button of a dialog.

use egui::{Button, Key, RichText, Ui};

/// The first button of a dialog. Whether the user pressed it, or Enter while no widget has the keyboard.
pub(super) fn primary_ui(ui: &mut Ui, label: &str) -> bool {
    let unfocused = ui.memory(|memory| memory.focused().is_none());
    let selection = ui.visuals().selection;
    let button = Button::new(RichText::new(label).color(selection.stroke.color)).fill(selection.bg_fill);
    ui.add(button).clicked() || (unfocused && ui.input(|input| input.key_pressed(Key::Enter)))
}
