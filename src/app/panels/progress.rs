//! The display settings, and the progress of rendering.

use super::error_plot::error_plot_ui;
use super::fields::rows;
use super::glossary::{caption, explained};
use super::numbers::{duration, grouped, percent, short, target_text};
use super::plan::{plan_ui, warnings_ui};
use super::settings::display_rows;
use super::typing::Typing;
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit};
use crate::app::rendering::Rendering;
use crate::engine::{Limits, MOST_ITERATIONS, PassSeconds, Stats, Status};
use egui::{CollapsingHeader, DragValue, Grid, Ui};

/// Longest time limit, seconds: a month.
const MOST_SECONDS: f64 = 2_678_400.0;

/// Width of the exposure slider beside its label and number, screen points.
const SLIDER_WIDTH: f32 = 60.0;

/// Display settings, counts, the target error, the error over time, the time of each pass, the plan.
pub(crate) fn progress_ui(ui: &mut Ui, document: &Document, rendering: &Rendering, commands: &mut Vec<AppCommand>) {
    display_ui(ui, document, commands);
    ui.separator();
    let Some(frame) = rendering.frame() else {
        ui.weak("No picture yet");
        return;
    };
    ui.strong("Progress");
    rows(ui, "progress", |ui| {
        error_rows(ui, &frame.stats);
        time_left_row(ui, rendering);
        target_row(ui, rendering.target(), commands);
        limit_rows(ui, rendering.limits(), commands);
    });
    if let Some(missing) = frame.stats.missing_light {
        ui.weak(missing.to_string());
    }
    ui.add_space(4.0);
    error_plot_ui(ui, rendering.error_curve(), rendering.target());
    if !frame.plan.warnings.is_empty() {
        warnings_ui(ui, &frame.plan, &rendering.renames(document.scene()));
    }
    let statistics = CollapsingHeader::new("Statistics").default_open(false).show(ui, |ui| {
        counts_ui(ui, frame.iteration, &frame.stats);
        ui.add_space(4.0);
        ui.weak("Time per iteration");
        passes_ui(ui, &frame.stats);
    });
    statistics.header_response.on_hover_text("Counts of paths and rays, and the time of each pass");
    let plan = CollapsingHeader::new("Plan").default_open(false).show(ui, |ui| plan_ui(ui, &frame.plan, &frame.stats));
    plan.header_response.on_hover_text("What the renderer does for this scene, and why");
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

/// The estimated error.
fn error_rows(ui: &mut Ui, stats: &Stats) {
    caption(ui, "Error");
    explained(ui.label(stats.error_estimate.map_or("unknown yet".to_owned(), percent)), "Error");
    ui.end_row();
}

/// The time until the error asked for.
fn time_left_row(ui: &mut Ui, rendering: &Rendering) {
    caption(ui, "Time left");
    let left = match (rendering.status(), rendering.target()) {
        (Status::Converged | Status::LimitReached, _) => "none".to_owned(),
        (_, None) => "without end".to_owned(),
        _ => {
            rendering.seconds_left().map_or("unknown yet".to_owned(), |seconds| format!("about {}", duration(seconds)))
        }
    };
    explained(ui.label(left), "Time left");
    ui.end_row();
}

/// The fields of the time and of the number of iterations after which rendering stops; 0 never stops.
fn limit_rows(ui: &mut Ui, limits: Limits, commands: &mut Vec<AppCommand>) {
    let mut changed = limits;
    let seconds = limit_field(ui, "Stop after", limits.seconds.unwrap_or(0.0), MOST_SECONDS, " s");
    changed.seconds = Some(seconds).filter(|seconds| *seconds > 0.0);
    let iterations = limits.iterations.unwrap_or(0) as f64;
    let iterations = limit_field(ui, "Stop at iteration", iterations, MOST_ITERATIONS as f64, "").round() as u64;
    changed.iterations = Some(iterations).filter(|iterations| *iterations > 0);
    if changed != limits {
        commands.push(AppCommand::Limits(changed));
    }
}

/// A field of a limit, with "never" for 0; its number.
fn limit_field(ui: &mut Ui, name: &str, mut value: f64, most: f64, unit: &str) -> f64 {
    let label = ui.label(name);
    let typing = Typing::of_next(ui, value, 0.0..=most);
    let field = DragValue::new(&mut value)
        .range(0.0..=most)
        .speed(1.0)
        .max_decimals(1)
        .update_while_editing(false)
        .custom_formatter(|value, _| if value > 0.0 { format!("{value}{unit}") } else { "never".to_owned() })
        .custom_parser(|text| match text.trim() {
            "never" => Some(0.0),
            number => typing.read(number.trim_end_matches('s').trim()),
        });
    let field = ui.add(field).labelled_by(label.id);
    typing.end(ui.ctx(), name);
    field.on_hover_text("0 never stops");
    ui.end_row();
    value
}

fn counts_ui(ui: &mut Ui, iteration: u64, stats: &Stats) {
    Grid::new("counts").num_columns(2).spacing([12.0, 3.0]).show(ui, |ui| {
        let mut row = |label: &str, value: String, tip: &str| {
            ui.weak(label).on_hover_text(tip);
            ui.label(value).on_hover_text(tip);
            ui.end_row();
        };
        let iterations = if iteration == 0 { "draft".to_owned() } else { grouped(iteration) };
        row("Iterations", iterations, "Passes over the whole picture; their mean is shown");
        row("Time", duration(stats.seconds), "Rendering time of the picture, without pauses");
        row("Photons", grouped(stats.photons_emitted), "Photon paths that the lights have emitted");
        row("Photons per second", short(stats.photons_per_second), "Photon paths over the rendering time");
        row("Rays", short(stats.rays as f64), "Rays of camera and photon paths, and shadow rays");
        let radius = if stats.radius > 0.0 { format!("{:.5}", stats.radius) } else { "–".to_owned() };
        row("Gather radius", radius, "Mean radius of density estimates in the middle of the scene, scene units");
        if stats.dropped_samples > 0 {
            let tip = "Samples left out of the picture, because they were not finite";
            row("Dropped samples", grouped(stats.dropped_samples), tip);
        }
    });
}

/// The field of the target error, percent; 0 never stops.
fn target_row(ui: &mut Ui, target: Option<f64>, commands: &mut Vec<AppCommand>) {
    let mut percent = 100.0 * target.unwrap_or(0.0);
    let label = ui.label("Stop at error");
    let typing = Typing::of_next(ui, percent, 0.0..=100.0);
    let field = DragValue::new(&mut percent)
        .range(0.0..=100.0)
        .speed(0.01)
        .max_decimals(3)
        .update_while_editing(false)
        .custom_formatter(|percent, _| target_text(percent))
        .custom_parser(|text| match text.trim() {
            "never" => Some(0.0),
            percent => typing.read(percent.trim_end_matches('%')),
        });
    let field = ui.add(field).labelled_by(label.id);
    typing.end(ui.ctx(), "Stop at error");
    if field.on_hover_text("Rendering stops when the error is hardly above this; 0 never stops").changed() {
        commands.push(AppCommand::Target((percent > 0.0).then_some(0.01 * percent)));
    }
    ui.end_row();
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
