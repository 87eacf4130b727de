//! The menu of operations on the patches of the selected object.

use super::menu_item::{check_ui, item_ui};
use crate::app::commands::{Action, AppCommand};
use crate::app::document::Document;
use egui::Ui;

/// The operations, and which control points move together.
pub(super) fn surface_menu_ui(ui: &mut Ui, document: &Document, commands: &mut Vec<AppCommand>) {
    let enabled = document.selection.bezier(document.scene()).is_some();
    let is_revolution = document.selection.revolution(document.scene()).is_some();
    if !enabled && !is_revolution {
        ui.weak("Select an object of patches");
    }
    for action in [Action::SplitU, Action::SplitV, Action::SplitBoth] {
        item_ui(ui, action, action.label(), enabled, commands);
    }
    ui.separator();
    for action in [Action::Flatten, Action::Smooth, Action::ResetPoints] {
        item_ui(ui, action, action.label(), enabled, commands);
    }
    ui.separator();
    check_ui(ui, Action::ToggleTangents, document.coupling.tangents, commands);
    let mirror = document.coupling.mirror.map_or("off", |mirror| ["x", "y", "z"][mirror.axis]);
    let label = format!("{}: {mirror}", Action::NextMirror.label());
    item_ui(ui, Action::NextMirror, &label, enabled, commands);
    ui.separator();
    item_ui(ui, Action::Thicken, Action::Thicken.label(), enabled, commands);
    item_ui(ui, Action::ConvertToPatches, Action::ConvertToPatches.label(), is_revolution, commands);
}
