//! Which control points move together: the tangents across seams, and the mirror symmetry.

use super::fields::number;
use super::lengths::Lengths;
use crate::app::commands::{Action, AppCommand};
use crate::app::document::Document;
use crate::app::document::surface::{Coupling, Mirror};
use crate::scene::Bezier;
use egui::Ui;

/// The tangents across seams, and the plane of symmetry. The settings belong to the window: the scene file does not hold them.
pub(super) fn coupling_ui(
    ui: &mut Ui,
    document: &Document,
    bezier: &Bezier,
    lengths: &Lengths,
    commands: &mut Vec<AppCommand>,
) {
    let mut coupling = document.coupling;
    let tip = format!("{} ({})", Action::ToggleTangents.tip(), Action::ToggleTangents.shortcut(ui.ctx()));
    ui.checkbox(&mut coupling.tangents, Action::ToggleTangents.label()).on_hover_text(tip);
    ui.horizontal(|ui| mirror_ui(ui, bezier, lengths, &mut coupling));
    if let Some(mirror) = coupling.mirror {
        let (matched, count) = mirror.matched(bezier);
        ui.weak(format!("{matched} of {count} positions have a mirror image"));
    }
    if coupling != document.coupling {
        commands.push(AppCommand::Couple(coupling));
    }
}

fn mirror_ui(ui: &mut Ui, bezier: &Bezier, lengths: &Lengths, coupling: &mut Coupling) {
    let tip = format!("{} ({})", Action::NextMirror.tip(), Action::NextMirror.shortcut(ui.ctx()));
    ui.label("Mirror").on_hover_text(&tip);
    if ui.selectable_label(coupling.mirror.is_none(), "off").on_hover_text("No symmetry").clicked() {
        coupling.mirror = None;
    }
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let selected = coupling.mirror.is_some_and(|mirror| mirror.axis == axis);
        let tip = format!("Mirror {name} through the centre of the object");
        if ui.selectable_label(selected, name).on_hover_text(tip).clicked() {
            coupling.mirror = Some(Mirror::through_center(bezier, axis));
        }
    }
    if let Some(mirror) = &mut coupling.mirror {
        ui.label("at");
        let spec = lengths.coordinate().tip("The plane's coordinate, in the object's axes");
        number(ui, "Mirror plane", &mut mirror.at, &spec);
    }
}
