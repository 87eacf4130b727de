//! The 4 x 4 control points of a patch, as fields.

use super::fields::{Number, length_speed, vector};
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit, PointIndex, Selection};
use crate::geometry::bezier::ControlNet;
use crate::scene::{Bezier, Transform};
use egui::{Button, DragValue, Grid, Response, RichText, Ui};

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
    if bezier.transform != Transform::default() {
        ui.weak("Coordinates before the object's transform; handles move along the axes of the world");
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
    let revealed = is_new_selection(ui, document).then(|| document.selection.points.last().copied()).flatten();
    Grid::new("control points").num_columns(2).spacing([6.0, 2.0]).show(ui, |ui| {
        for (i, row) in net.points.into_iter().enumerate() {
            for (j, position) in row.into_iter().enumerate() {
                let (point, name) = (PointIndex { patch, i, j }, format!("P[{i}][{j}]"));
                let label = label_ui(ui, document, point, &name, commands);
                if revealed == Some(point) {
                    label.scroll_to_me(None);
                }
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

/// Whether the selection differs from the selection of the last frame.
fn is_new_selection(ui: &Ui, document: &Document) -> bool {
    let (id, present) = (ui.make_persistent_id("shown selection"), &document.selection);
    let is_new = ui.data(|data| data.get_temp::<Selection>(id)).as_ref() != Some(present);
    if is_new {
        ui.data_mut(|data| data.insert_temp(id, present.clone()));
    }
    is_new
}

/// The name of a control point: a click selects the control point.
fn label_ui(
    ui: &mut Ui,
    document: &Document,
    point: PointIndex,
    name: &str,
    commands: &mut Vec<AppCommand>,
) -> Response {
    let selected = document.selection.points.contains(&point);
    let label = ui.selectable_label(selected, RichText::new(name).monospace());
    let label = label.on_hover_text("Select this control point; Shift adds it to the selection");
    if label.clicked() {
        let mut selection = document.selection.clone();
        selection.click_point(point, ui.input(|input| input.modifiers.shift));
        commands.push(AppCommand::Select(selection));
    }
    label
}
