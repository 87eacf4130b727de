//! The properties of a surface of revolution: its angle, its caps, its profile.

use super::fields::{Number, number, number_row, unit_ui};
use super::glossary::{caption, explained};
use super::lengths::Lengths;
use crate::app::commands::AppCommand;
use crate::app::document::{Document, PointIndex, Selection, profile};
use crate::scene::Revolution;
use egui::Ui;
use glam::DVec2;

/// The rows of the angle and the caps.
pub(super) fn turn_ui(ui: &mut Ui, revolution: &mut Revolution) {
    let mut angle = revolution.angle();
    number_row(ui, "Angle", &mut angle, &Number::any(0.5).within(0.01..=360.0).unit("°"));
    if angle != revolution.angle() {
        *revolution = revolution.with_angle(angle);
    }
    caption(ui, "Caps");
    let mut caps = revolution.caps();
    if explained(ui.checkbox(&mut caps, "closed by flat caps"), "Caps").changed() {
        *revolution = revolution.with_caps(caps);
    }
    ui.end_row();
}

/// The points of the profile, (r, y) of each, with a button that selects it; and buttons to add and to remove segments.
/// Returns the surface as the user edits it.
pub(super) fn profile_ui(
    ui: &mut Ui,
    document: &Document,
    revolution: &Revolution,
    lengths: &Lengths,
    commands: &mut Vec<AppCommand>,
) -> Revolution {
    let mut points = revolution.profile().to_vec();
    let count = points.len();
    for (index, point) in points.iter_mut().enumerate() {
        ui.horizontal(|ui| {
            point_button_ui(ui, document, PointIndex::of_profile(index, count), index, commands);
            point_ui(ui, index, point, lengths);
        });
    }
    ui.horizontal(|ui| {
        let split = ui.button("Split segment").on_hover_text(
            "Halves the segment of the selected point, or the last one, exactly: the surface stays the same",
        );
        if split.clicked() {
            points = profile::split(&points, chosen_segment(document, count));
        }
        let remove = ui.add_enabled(count > 4, egui::Button::new("Remove segment"));
        let remove = remove.on_hover_text("Removes the segment of the selected point, or the last one");
        if remove.clicked() {
            points = profile::without_segment(&points, chosen_segment(document, count));
        }
    });
    if points == revolution.profile() { revolution.clone() } else { revolution.with_profile(points) }
}

/// The segment of the first selected point; the last one without a selected point.
fn chosen_segment(document: &Document, count: usize) -> usize {
    let last = (count / 3).saturating_sub(1);
    document.selection.points.first().map_or(last, |point| point.patch.min(last))
}

fn point_button_ui(ui: &mut Ui, document: &Document, point: PointIndex, index: usize, commands: &mut Vec<AppCommand>) {
    let selected = document.selection.points.contains(&point);
    let button = egui::Button::selectable(selected, format!("point {index}")).frame_when_inactive(true);
    let tip = if index.is_multiple_of(3) { "A point of the profile" } else { "A control point beside the profile" };
    if ui.add(button).on_hover_text(format!("{tip}\nClick to select, with Shift or Ctrl to add or remove")).clicked() {
        let mut selection: Selection = document.selection.clone();
        selection.click_point(point, ui.input(|input| input.modifiers.shift || input.modifiers.command));
        commands.push(AppCommand::Select(selection));
    }
}

fn point_ui(ui: &mut Ui, index: usize, point: &mut DVec2, lengths: &Lengths) {
    ui.spacing_mut().item_spacing.x = 3.0;
    let unitless = |spec: Number| Number { unit: "", ..spec };
    ui.weak("r");
    let radius = unitless(lengths.positive()).tip("Distance from the axis, before the object's transform");
    number(ui, &format!("Point {index} r"), &mut point.x, &radius);
    ui.weak("y");
    let height = unitless(lengths.coordinate()).tip("Height along the axis, before the object's transform");
    number(ui, &format!("Point {index} y"), &mut point.y, &height);
    unit_ui(ui, lengths.unit.suffix());
}
