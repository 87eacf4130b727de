//! The strip of snapshots: thumbnails, and how two pictures are compared.

use super::snapshots::Snapshots;
use crate::app::commands::{Action, AppCommand, Comparison, SnapshotCommand};
use crate::film::{FULL_DIFFERENCE, LinearImage, difference_color};
use egui::{Button, Color32, ComboBox, Frame, Image, Rect, RichText, ScrollArea, Sense, Stroke, Ui, Vec2, pos2, vec2};
use std::sync::Arc;

/// Most characters of a name under a thumbnail.
const NAME_LENGTH: usize = 20;
/// The name of the picture that is rendered, in lists.
const PRESENT: &str = "Present picture";

/// Shows the snapshots, and pushes the user's requests. `present` is the present picture.
pub(crate) fn strip_ui(
    ui: &mut Ui,
    snapshots: &Snapshots,
    present: Option<&Arc<LinearImage>>,
    commands: &mut Vec<AppCommand>,
) {
    ui.horizontal_wrapped(|ui| {
        let take = ui.button("Take snapshot").on_hover_text(Action::TakeSnapshot.shortcut(ui.ctx()));
        if take.clicked() {
            commands.push(AppCommand::Do(Action::TakeSnapshot));
        }
        ui.separator();
        comparison_ui(ui, snapshots, commands);
        let mut keep = snapshots.are_kept_with_scene();
        if ui.checkbox(&mut keep, "Save with the scene").clicked() {
            commands.push(AppCommand::Snapshot(SnapshotCommand::KeepWithScene(keep)));
        }
    });
    if snapshots.comparison() == Comparison::Difference {
        ui.horizontal_wrapped(|ui| numbers_ui(ui, snapshots, present));
    }
    ScrollArea::horizontal().auto_shrink([false, true]).show(ui, |ui| {
        ui.horizontal(|ui| {
            for index in 0..snapshots.iter().len() {
                thumbnail_ui(ui, snapshots, index, commands);
            }
        });
    });
}

/// The pictures that are compared, and how.
fn comparison_ui(ui: &mut Ui, snapshots: &Snapshots, commands: &mut Vec<AppCommand>) {
    let name =
        |place: Option<usize>| place.and_then(|place| snapshots.get(place)).map(|snapshot| short(&snapshot.name));
    let [first, second] = snapshots.places();
    let mut send = |command| commands.push(AppCommand::Snapshot(command));
    ui.label("Compare");
    ComboBox::from_id_salt("first picture").selected_text(name(first).unwrap_or_else(|| PRESENT.to_owned())).show_ui(
        ui,
        |ui| {
            if ui.selectable_label(first.is_none(), PRESENT).clicked() {
                send(SnapshotCommand::First(None));
            }
            for (index, snapshot) in snapshots.iter().enumerate() {
                if ui.selectable_label(first == Some(index), short(&snapshot.name)).clicked() {
                    send(SnapshotCommand::First(Some(index)));
                }
            }
        },
    );
    ui.label("with");
    ComboBox::from_id_salt("second picture").selected_text(name(second).unwrap_or_default()).show_ui(ui, |ui| {
        for (index, snapshot) in snapshots.iter().enumerate() {
            if ui.selectable_label(second == Some(index), short(&snapshot.name)).clicked() {
                send(SnapshotCommand::Second(index));
            }
        }
    });
    for comparison in Comparison::ALL {
        let tip = match comparison {
            Comparison::Off => String::new(),
            Comparison::Flip => Action::CompareFlip.shortcut(ui.ctx()),
            Comparison::Split => Action::CompareSplit.shortcut(ui.ctx()),
            Comparison::Difference => Action::CompareDifference.shortcut(ui.ctx()),
        };
        let button = ui.add(Button::selectable(snapshots.comparison() == comparison, comparison.label()));
        if button.on_hover_text(tip).clicked() {
            send(SnapshotCommand::Compare(comparison));
        }
    }
}

/// The colours of the difference, and its numbers.
fn numbers_ui(ui: &mut Ui, snapshots: &Snapshots, present: Option<&Arc<LinearImage>>) {
    if let Some(obstacle) = snapshots.obstacle(present) {
        ui.label(format!("{obstacle}: no difference is shown"));
        return;
    }
    ui.label(format!("darker -{:.0} %", 100.0 * FULL_DIFFERENCE));
    legend_ui(ui);
    ui.label(format!("brighter +{:.0} %", 100.0 * FULL_DIFFERENCE));
    ui.separator();
    let Some(numbers) = snapshots.numbers(present) else {
        ui.label("…");
        return;
    };
    let errors = numbers.errors;
    ui.monospace(format!("RMSE {:.3e}", errors.rmse)).on_hover_text("Root of the mean squared difference, radiance");
    ui.monospace(format!("relMSE {:.3e}", errors.rel_mse)).on_hover_text("Mean of (x - r)² / (r² + 0.01)");
    match numbers.flip {
        Some(flip) => ui.monospace(format!("FLIP {flip:.4}")).on_hover_text("Mean perceived difference, from 0 to 1"),
        None => ui.weak("FLIP: not built in").on_hover_text("Build the program with --features flip for it"),
    };
    let [red, green, blue] = errors.mean_ratio;
    let brightness = format!("brightness {red:.4} {green:.4} {blue:.4}");
    ui.monospace(brightness).on_hover_text("Mean of the first picture over that of the second, of red, green and blue");
}

/// A bar of the colours.
fn legend_ui(ui: &mut Ui) {
    const STEPS: usize = 32;
    let (rect, _) = ui.allocate_exact_size(vec2(96.0, 10.0), Sense::hover());
    for step in 0..STEPS {
        let [left, right] = [step, step + 1].map(|k| rect.left() + rect.width() * k as f32 / STEPS as f32);
        let part = Rect::from_min_max(pos2(left, rect.top()), pos2(right, rect.bottom()));
        let [red, green, blue] = difference_color(2.0 * (step as f32 + 0.5) / STEPS as f32 - 1.0);
        ui.painter().rect_filled(part, 0.0, Color32::from_rgb(red, green, blue));
    }
}

/// A snapshot: a click compares with it, its menu restores, renames and deletes it.
fn thumbnail_ui(ui: &mut Ui, snapshots: &Snapshots, index: usize, commands: &mut Vec<AppCommand>) {
    let (Some(snapshot), Some(texture)) = (snapshots.get(index), snapshots.thumbnail(index)) else { return };
    let is_chosen = snapshots.places()[1] == Some(index);
    let stroke = if is_chosen { ui.visuals().selection.stroke } else { Stroke::new(1.0, ui.visuals().faint_bg_color) };
    let mut send = |command| commands.push(AppCommand::Snapshot(command));
    Frame::new().stroke(stroke).inner_margin(3.0).show(ui, |ui| {
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing = Vec2::splat(2.0);
            let image = Image::new(texture).alt_text(snapshot.name.as_str());
            let picture = ui.add(Button::image(image).frame(false)).on_hover_text(format!(
                "{}\n{} iterations, {}\nClick to compare with it; click with the right button for more",
                snapshot.name,
                snapshot.iterations,
                snapshot.caption()
            ));
            if picture.clicked() {
                send(SnapshotCommand::Second(index));
            }
            picture.context_menu(|ui| {
                // Places change when a snapshot before is deleted: the text belongs to the name.
                let id = ui.scope_id().with((index, snapshot.name.as_str()));
                let mut name = ui.data_mut(|data| data.get_temp(id).unwrap_or_else(|| snapshot.name.clone()));
                let field = ui.text_edit_singleline(&mut name);
                if field.lost_focus() && !name.trim().is_empty() {
                    send(SnapshotCommand::Rename(index, name.trim().to_owned()));
                }
                ui.data_mut(|data| data.insert_temp(id, name));
                let restore = ui.add_enabled(snapshot.file.is_some(), Button::new("Restore its scene"));
                if restore.on_disabled_hover_text("This picture came without a scene").clicked() {
                    send(SnapshotCommand::Restore(index));
                    ui.close();
                }
                if ui.button("Compare from it").clicked() {
                    send(SnapshotCommand::First(Some(index)));
                    ui.close();
                }
                if ui.button("Delete").clicked() {
                    send(SnapshotCommand::Remove(index));
                    ui.close();
                }
            });
            ui.label(RichText::new(short(&snapshot.name)).small());
            ui.label(RichText::new(snapshot.caption()).small().weak());
        });
    });
}

/// The beginning of a long name.
fn short(name: &str) -> String {
    if name.chars().count() <= NAME_LENGTH {
        return name.to_owned();
    }
    name.chars().take(NAME_LENGTH - 1).chain(['…']).collect()
}
