//! The 4 x 4 control points of a patch, as fields.

use super::fields::{Number, length_speed, vector};
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit, PointIndex, Selection};
use crate::geometry::bezier::ControlNet;
use crate::scene::{Bezier, Shape};
use egui::{Button, DragValue, Grid, Ui};
use std::sync::Arc;

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
    let mut edited = *net;
    net_ui(ui, document, patch, &mut edited, commands);
    if edited != *net {
        commands.extend(replaced(document, object, patch, edited).map(AppCommand::Edit));
    }
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

fn net_ui(ui: &mut Ui, document: &Document, patch: usize, net: &mut ControlNet, commands: &mut Vec<AppCommand>) {
    let spec = Number::any(length_speed(&document.scene().camera));
    Grid::new("control points").num_columns(2).spacing([6.0, 2.0]).show(ui, |ui| {
        for (i, row) in net.points.iter_mut().enumerate() {
            for (j, position) in row.iter_mut().enumerate() {
                let point = PointIndex { patch, i, j };
                let name = format!("P[{i}][{j}]");
                let selected = document.selection.points.contains(&point);
                let label = ui.selectable_label(selected, egui::RichText::new(&name).monospace());
                if label.on_hover_text("Select this control point; Shift adds it to the selection").clicked() {
                    let mut selection = document.selection.clone();
                    selection.click_point(point, ui.input(|input| input.modifiers.shift));
                    commands.push(AppCommand::Select(selection));
                }
                ui.horizontal(|ui| vector(ui, &name, position, &spec));
                ui.end_row();
            }
        }
    });
}

/// The edit that replaces the control net of a patch; `None` where the object or patch does not exist.
fn replaced(document: &Document, object: usize, patch: usize, net: ControlNet) -> Option<Edit> {
    let mut edited = document.scene().objects.get(object)?.clone();
    if let Shape::Bezier(bezier) = &mut edited.shape {
        *Arc::make_mut(&mut bezier.patches).get_mut(patch)? = net;
        // The patches now differ from the `.bpt` file.
        bezier.file = None;
    }
    Some(Edit::Object(object, edited))
}
