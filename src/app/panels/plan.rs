//! The rendered and the skipped items of the plan with reasons, and warnings about the scene.

use crate::app::rendering::Renames;
use crate::app::theme;
use crate::engine::{PlanItem, PlanSummary, Stats};
use egui::Ui;

/// The plan, one line per note, and how the caustics divide between light sheets and photons.
pub(super) fn plan_ui(ui: &mut Ui, plan: &PlanSummary, stats: &Stats) {
    let palette = theme::palette(ui.visuals().dark_mode);
    for note in &plan.notes {
        ui.horizontal_wrapped(|ui| {
            let (mark, color) = if note.rendered { ("✔", palette.success) } else { ("–", palette.warning) };
            ui.colored_label(color, mark);
            ui.label(note.item.to_string());
            let how = if note.rendered { "" } else { "skipped: " };
            let share = stats.light_sheets().filter(|_| note.item == PlanItem::Caustics);
            let share = share.map_or_else(String::new, |share| format!("; {share}"));
            ui.weak(format!("{how}{}{share}", note.reason));
        });
    }
}

/// The warnings about the scene, one paragraph each, with the present names of its items.
pub(super) fn warnings_ui(ui: &mut Ui, plan: &PlanSummary, renames: &Renames<'_>) {
    let palette = theme::palette(ui.visuals().dark_mode);
    for warning in &plan.warnings {
        ui.horizontal_wrapped(|ui| {
            ui.colored_label(palette.warning, "⚠");
            ui.label(renames.apply(&format!("{} {}.", warning.subject, warning.fault)));
            ui.weak(renames.apply(&format!("To mend it: {}.", warning.remedy)));
        });
    }
}
