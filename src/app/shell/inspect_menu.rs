//! The menu "Inspect": what the canvas shows of the scene, profiles, and comparisons.

use super::menu_item::item_ui;
use crate::app::commands::{Action, AppCommand, COMPONENTS, PictureView};
use crate::transport::Component;
use egui::Ui;

/// The entries of the menu, for the present view and the component of the light that is rendered.
pub(super) fn inspect_menu_ui(ui: &mut Ui, view: PictureView, only: Option<Component>, commands: &mut Vec<AppCommand>) {
    for of in PictureView::ALL {
        if ui.radio(view == of, of.label()).on_hover_text(of.tip()).clicked() {
            commands.push(AppCommand::Show(of));
        }
    }
    for action in [Action::DrawProfile, Action::ExportProfile] {
        item_ui(ui, action, action.label(), true, commands);
    }
    ui.separator();
    for (component, label) in COMPONENTS {
        if ui.radio(only == component, label).on_hover_text("Begins the picture anew").clicked() {
            commands.push(AppCommand::Only(component));
        }
    }
    ui.separator();
    for action in [
        Action::TakeSnapshot,
        Action::OpenReference,
        Action::CompareFlip,
        Action::CompareSplit,
        Action::CompareDifference,
    ] {
        item_ui(ui, action, action.label(), true, commands);
    }
}
