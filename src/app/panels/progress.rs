//! The display settings, and the progress of rendering.

use super::error_plot::error_plot_ui;
use super::expression;
use super::fields::rows;
use super::numbers::{duration, grouped, percent, short, target_text};
use super::plan::{plan_ui, warnings_ui};
use super::settings::display_rows;
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit};
use crate::app::rendering::Rendering;
use crate::engine::{PassSeconds, Stats};
use egui::{CollapsingHeader, DragValue, Grid, Ui};

/// Width of the exposure slider beside its label and number, screen points.
const SLIDER_WIDTH: f32 = 76.0;

/// Display settings, counts, the target error, the error over time, the time of each pass, the plan.
pub(crate) fn progress_ui(ui: &mut Ui, document: &Document, rendering: &Rendering, commands: &mut Vec<AppCommand>) {
    display_ui(ui, document, commands);
    ui.separator();
    let Some(frame) = rendering.frame() else {
        ui.weak("No picture yet");
        return;
    };
    counts_ui(ui, frame.iteration, &frame.stats);
    target_ui(ui, rendering.target(), commands);
    ui.add_space(4.0);
    error_plot_ui(ui, rendering.error_curve(), rendering.target());
    CollapsingHeader::new("Time per iteration").default_open(true).show(ui, |ui| passes_ui(ui, &frame.stats));
    warnings_ui(ui, &frame.plan);
    CollapsingHeader::new("Plan").default_open(false).show(ui, |ui| plan_ui(ui, &frame.plan));
}

fn display_ui(ui: &mut Ui, document: &Document, commands: &mut Vec<AppCommand>) {
    let mut film = document.scene().film;
    ui.strong("Display");
    rows(ui, "display", |ui| {
        ui.spacing_mut().slider_width = SLIDER_WIDTH;
        display_rows(ui, &mut film);
    });
    if film != document.scene().film {
        commands.push(AppCommand::Edit(Edit::Film(film)));
    }
}

fn counts_ui(ui: &mut Ui, iteration: u64, stats: &Stats) {
    ui.strong("Progress");
    Grid::new("counts").num_columns(2).spacing([12.0, 3.0]).show(ui, |ui| {
        let mut row = |label: &str, value: String| {
            ui.weak(label);
            ui.label(value);
            ui.end_row();
        };
        row("Iteration", if iteration == 0 { "draft".to_owned() } else { grouped(iteration) });
        row("Time", duration(stats.seconds));
        row("Photons", grouped(stats.photons_emitted));
        row("Photons per second", short(stats.photons_per_second));
        row("Rays", short(stats.rays as f64));
        row("Gather radius", if stats.radius > 0.0 { format!("{:.5}", stats.radius) } else { "–".to_owned() });
        row("Error estimate", stats.error_estimate.map_or("unknown yet".to_owned(), percent));
        if let Some(missing) = stats.missing_light {
            row("Missing light", missing.to_string());
        }
        if stats.dropped_samples > 0 {
            row("Dropped samples", grouped(stats.dropped_samples));
        }
    });
}

/// The field of the target error, percent; 0 never stops.
fn target_ui(ui: &mut Ui, target: Option<f64>, commands: &mut Vec<AppCommand>) {
    let mut percent = 100.0 * target.unwrap_or(0.0);
    ui.horizontal(|ui| {
        let label = ui.weak("Target error");
        let field = DragValue::new(&mut percent)
            .range(0.0..=100.0)
            .speed(0.01)
            .max_decimals(3)
            .update_while_editing(false)
            .custom_formatter(|percent, _| target_text(percent))
            .custom_parser(|text| expression::value_of(text.trim().trim_end_matches('%')));
        let field = ui.add(field).labelled_by(label.id);
        if field.on_hover_text("Rendering stops when the error is hardly above this; 0 never stops").changed() {
            commands.push(AppCommand::Target((percent > 0.0).then_some(0.01 * percent)));
        }
    });
}

/// The mean time of each pass per iteration, and the time of preparing the scene.
fn passes_ui(ui: &mut Ui, stats: &Stats) {
    let PassSeconds { prepare, camera, photons, map, gather, commit } = stats.passes;
    let passes = [
        ("Camera pass", camera),
        ("Photon pass", photons),
        ("Photon map", map),
        ("Gather", gather),
        ("Commit", commit),
    ];
    let (total, count) = (camera + photons + map + gather + commit, stats.iterations.max(1) as f64);
    Grid::new("passes").num_columns(3).spacing([12.0, 3.0]).show(ui, |ui| {
        for (label, seconds) in passes {
            ui.weak(label);
            ui.label(format!("{:.1} ms", 1e3 * seconds / count));
            ui.weak(format!("{:.0} %", 100.0 * seconds / total.max(f64::MIN_POSITIVE)));
            ui.end_row();
        }
        ui.weak("Preparation");
        ui.label(format!("{:.1} ms", 1e3 * prepare));
        ui.end_row();
    });
}
