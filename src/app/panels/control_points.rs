//! The 4 x 4 control points of a patch, as fields.

use super::fields::{Number, length_speed, vector};
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit, PointIndex, Selection};
use crate::geometry::bezier::ControlNet;
use crate::scene::Bezier;
use egui::{Button, DragValue, Grid, RichText, Ui};

/// The choice of a patch, and its 16 control points in object space.
pub(super) fn control_points_ui(
    ui: &mut Ui,
    document: &Document,
    object: usize,
    bezier: &Bezier,
    commands: &mut Vec<AppCommand>,
) {
    let patch = document.selection.patch;
    let Some(net) = bezier.patches.get(patch) else { return };
    if bezier.patches.len() > 1 {
        patch_ui(ui, document, bezier.patches.len(), commands);
    }
    net_ui(ui, document, (object, patch), *net, commands);
}

fn patch_ui(ui: &mut Ui, document: &Document, count: usize, commands: &mut Vec<AppCommand>) {
    let mut patch = document.selection.patch;
    ui.horizontal(|ui| {
        if ui.add_enabled(patch > 0, Button::new("<")).on_hover_text("Previous patch").clicked() {
            patch -= 1;
        }
        let number = DragValue::new(&mut patch).range(0..=count - 1).prefix("patch ").speed(0.1);
        ui.add(number).accessible_name("Patch");
        if ui.add_enabled(patch + 1 < count, Button::new(">")).on_hover_text("Next patch").clicked() {
            patch += 1;
        }
        ui.weak(format!("from 0 to {}", count - 1));
    });
    if patch != document.selection.patch {
        commands.push(AppCommand::Select(Selection { patch, ..document.selection.clone() }));
    }
}

fn net_ui(
    ui: &mut Ui,
    document: &Document,
    (object, patch): (usize, usize),
    net: ControlNet,
    commands: &mut Vec<AppCommand>,
) {
    let spec = Number::any(length_speed(&document.scene().camera));
    Grid::new("control points").num_columns(2).spacing([6.0, 2.0]).show(ui, |ui| {
        for (i, row) in net.points.into_iter().enumerate() {
            for (j, position) in row.into_iter().enumerate() {
                let (point, name) = (PointIndex { patch, i, j }, format!("P[{i}][{j}]"));
                label_ui(ui, document, point, &name, commands);
                let mut placed = position;
                ui.horizontal(|ui| vector(ui, &name, &mut placed, &spec));
                if placed != position {
                    commands.push(AppCommand::Edit(Edit::Place(object, point, placed)));
                }
                ui.end_row();
            }
        }
    });
}

/// The name of a control point: a click selects the control point.
fn label_ui(ui: &mut Ui, document: &Document, point: PointIndex, name: &str, commands: &mut Vec<AppCommand>) {
    let selected = document.selection.points.contains(&point);
    let label = ui.selectable_label(selected, RichText::new(name).monospace());
    if label.on_hover_text("Select this control point; Shift adds it to the selection").clicked() {
        let mut selection = document.selection.clone();
        selection.click_point(point, ui.input(|input| input.modifiers.shift));
        commands.push(AppCommand::Select(selection));
    }
}
