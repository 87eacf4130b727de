//! The control points of a patch: a button for each, and the coordinates of the selected ones.

use super::fields::{count, vector};
use super::lengths::Lengths;
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit, PointIndex, Selection};
use crate::geometry::bezier::ControlNet;
use crate::scene::{Bezier, Transform};
use egui::{Button, Grid, RichText, Ui, vec2};
use glam::DVec3;

/// The choice of a patch, its 16 control points, and the coordinates of the selected control points in object space.
pub(super) fn control_points_ui(
    ui: &mut Ui,
    document: &Document,
    object: usize,
    bezier: &Bezier,
    lengths: &Lengths,
    commands: &mut Vec<AppCommand>,
) {
    let Some(net) = bezier.patches.get(document.selection.patch) else { return };
    if bezier.patches.len() > 1 {
        patch_ui(ui, document, bezier.patches.len(), commands);
    }
    net_ui(ui, document, net, commands);
    position_ui(ui, document, object, bezier, lengths, commands);
    if bezier.transform != Transform::default() {
        ui.weak("Coordinates before the object's transform; handles move along the axes of the world");
    }
}

fn patch_ui(ui: &mut Ui, document: &Document, patches: usize, commands: &mut Vec<AppCommand>) {
    let mut patch = document.selection.patch;
    ui.horizontal(|ui| {
        ui.label("Patch");
        if ui.add_enabled(patch > 0, Button::new("<")).on_hover_text("Previous patch").clicked() {
            patch -= 1;
        }
        count(ui, "Patch", &mut patch, 0..=patches - 1, 0.1);
        if ui.add_enabled(patch + 1 < patches, Button::new(">")).on_hover_text("Next patch").clicked() {
            patch += 1;
        }
        ui.weak(format!("from 0 to {}", patches - 1));
    });
    if patch != document.selection.patch {
        commands.push(AppCommand::Select(Selection { patch, ..document.selection.clone() }));
    }
}

/// A button for each control point: rows along u, columns along v.
fn net_ui(ui: &mut Ui, document: &Document, net: &ControlNet, commands: &mut Vec<AppCommand>) {
    let patch = document.selection.patch;
    Grid::new("control net").num_columns(4).spacing([3.0, 3.0]).show(ui, |ui| {
        for (i, row) in net.points.iter().enumerate() {
            for (j, position) in row.iter().enumerate() {
                point_ui(ui, document, PointIndex { patch, i, j }, *position, commands);
            }
            ui.end_row();
        }
    });
}

/// The button of a control point: a click selects the control point.
fn point_ui(ui: &mut Ui, document: &Document, point: PointIndex, at: DVec3, commands: &mut Vec<AppCommand>) {
    let name = point_name(point);
    let selected = document.selection.points.contains(&point);
    let button = Button::selectable(selected, RichText::new(&name).monospace()).frame_when_inactive(true);
    let response = ui.add(button.min_size(vec2(76.0, 20.0)));
    let DVec3 { x, y, z } = at;
    let place = format!("{name} at {x:.4}, {y:.4}, {z:.4}\nClick to select, with Shift or Ctrl to add or remove");
    if response.on_hover_text(place).clicked() {
        let mut selection = document.selection.clone();
        selection.click_point(point, ui.input(|input| input.modifiers.shift || input.modifiers.command));
        commands.push(AppCommand::Select(selection));
    }
}

fn point_name(point: PointIndex) -> String {
    format!("P[{}][{}]", point.i, point.j)
}

/// The coordinates of the selected control point, or of the centre of several: a typed number moves all.
fn position_ui(
    ui: &mut Ui,
    document: &Document,
    object: usize,
    bezier: &Bezier,
    lengths: &Lengths,
    commands: &mut Vec<AppCommand>,
) {
    let points = positions(document, bezier);
    let Some((first, position)) = points.first() else {
        ui.weak("Select control points here or in the picture to edit their coordinates");
        return;
    };
    let distinct = distinct(&points);
    let center = if distinct.len() > 1 { mean(&distinct) } else { *position };
    let (title, edit) = match distinct.len() {
        1 => (point_name(*first), "move control point"),
        several => (format!("Centre of {several} points"), "move control points"),
    };
    let mut placed = center;
    let title = ui.strong(title);
    let row = ui.horizontal(|ui| vector(ui, "Position", &mut placed, &lengths.coordinate()));
    if is_new_selection(ui, document) {
        title.union(row.response).scroll_to_me(None);
    }
    if placed != center {
        // The centre's own place is exact, so a typed number is the coordinate of a single point to the last digit.
        let to = |at: DVec3| if distinct.len() > 1 { at + (placed - center) } else { placed };
        let points = points.iter().map(|(point, at)| (*point, to(*at))).collect();
        commands.push(AppCommand::Edit(Edit::Place(object, points, edit)));
    }
}

/// The selected control points with their positions.
fn positions(document: &Document, bezier: &Bezier) -> Vec<(PointIndex, DVec3)> {
    let position = |point: &PointIndex| bezier.patches.get(point.patch)?.points.get(point.i)?.get(point.j).copied();
    document.selection.points.iter().filter_map(|point| Some((*point, position(point)?))).collect()
}

/// The different positions: control points at one position count once.
fn distinct(points: &[(PointIndex, DVec3)]) -> Vec<DVec3> {
    let mut positions: Vec<DVec3> = points.iter().map(|(_, at)| *at).collect();
    positions.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
    positions.dedup();
    positions
}

fn mean(positions: &[DVec3]) -> DVec3 {
    positions.iter().sum::<DVec3>() / positions.len() as f64
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
