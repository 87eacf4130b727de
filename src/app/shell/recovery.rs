//! The dialog about unsaved changes of windows that ended without saving.

use super::primary::primary_ui;
use crate::app::commands::{AppCommand, Next};
use crate::app::keeping::LeftOverRow;
use crate::app::theme;
use egui::{ScrollArea, Ui};

/// Shows the unsaved changes, each with its buttons. Enter recovers the newest ones.
pub(super) fn recovery_ui(ui: &mut Ui, rows: &[LeftOverRow], commands: &mut Vec<AppCommand>) {
    ui.heading("Recover unsaved changes?");
    ui.label("patchlight ended without saving:");
    let first = rows.iter().position(|row| row.damage.is_none());
    ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
        for (index, row) in rows.iter().enumerate() {
            ui.separator();
            row_ui(ui, index, row, first == Some(index), commands);
        }
    });
    ui.separator();
    ui.horizontal(|ui| {
        if ui.button("Later").on_hover_text("Asks again at the next start").clicked() {
            commands.push(AppCommand::CloseDialog);
        }
        if rows.len() > 1 {
            ui.weak("What you do not recover now is kept for the next start.");
        }
    });
}

fn row_ui(ui: &mut Ui, index: usize, row: &LeftOverRow, is_first: bool, commands: &mut Vec<AppCommand>) {
    ui.strong(&row.name);
    ui.weak(&row.details);
    if let Some(damage) = &row.damage {
        let color = theme::palette(ui.visuals().dark_mode).warning;
        ui.colored_label(color, format!("This file stays, but cannot be recovered: {damage}"));
    }
    ui.horizontal(|ui| {
        let recovers = match (&row.damage, is_first) {
            (Some(_), _) => false,
            (None, true) => primary_ui(ui, "Recover"),
            (None, false) => ui.button("Recover").clicked(),
        };
        if recovers {
            commands.push(AppCommand::Leave(Next::Recover(index)));
        }
        if ui.button("Discard").clicked() {
            commands.push(AppCommand::DiscardLeftOver(index));
        }
    });
}
