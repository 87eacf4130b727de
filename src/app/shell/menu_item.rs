//! The entries of menus: an action with its shortcut and its tooltip.

use crate::app::commands::{Action, AppCommand};
use egui::{Atom, Button, Checkbox, Response, RichText, Ui};

/// An entry that performs an action.
pub(super) fn item_ui(ui: &mut Ui, action: Action, label: &str, enabled: bool, commands: &mut Vec<AppCommand>) {
    let (button, shortcut) = (Button::new(label), action.shortcut(ui.ctx()));
    let button = if shortcut.is_empty() { button } else { button.shortcut_text(shortcut) };
    let response = ui.add_enabled(enabled, button);
    if explained(response, action).clicked() {
        commands.push(AppCommand::Do(action));
    }
}

/// An entry with a check mark, whose action toggles it.
pub(super) fn check_ui(ui: &mut Ui, action: Action, mut on: bool, commands: &mut Vec<AppCommand>) {
    let shortcut = RichText::new(action.shortcut(ui.ctx())).weak();
    let response = ui.add(Checkbox::new(&mut on, (action.label(), Atom::grow(), shortcut)));
    if explained(response, action).clicked() {
        commands.push(AppCommand::Do(action));
    }
}

fn explained(response: Response, action: Action) -> Response {
    if action.tip().is_empty() { response } else { response.on_hover_text(action.tip()) }
}
