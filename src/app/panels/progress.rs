//! How far the picture is.

use super::fields::rows;
use super::plan::plan_ui;
use super::settings::display_rows;
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit};
use crate::app::rendering::Rendering;
use crate::app::theme;
use crate::engine::{PassSeconds, Stats};
use egui::{CollapsingHeader, DragValue, Grid, Ui};
use egui_plot::{GridInput, GridMark, HLine, Line, Plot, PlotPoints, Points};

/// Points of the curve kept at most; then every second goes.
const CURVE_POINTS: usize = 512;

/// Of the exposure, beside its label and its number, screen points.
const SLIDER_WIDTH: f32 = 76.0;

/// The error estimate over time, of one generation.
#[derive(Clone, Debug, Default)]
pub(crate) struct ErrorCurve {
    generation: u64,
    /// Decimal logarithms of seconds and error: the error falls with a power of time, which is a straight line.
    points: Vec<[f64; 2]>,
}

impl ErrorCurve {
    /// Begins anew where the generation is another one.
    pub(crate) fn begin(&mut self, generation: u64) {
        if self.generation != generation {
            *self = Self { generation, points: Vec::new() };
        }
    }

    /// Takes another measurement.
    pub(crate) fn push(&mut self, generation: u64, seconds: f64, error: f64) {
        self.begin(generation);
        let later = self.points.last().is_none_or(|last| last[0] < seconds.log10());
        if later && seconds > 0.0 && error > 0.0 {
            self.points.push([seconds.log10(), error.log10()]);
        }
        if self.points.len() > CURVE_POINTS {
            let mut keep = false;
            self.points.retain(|_| {
                keep = !keep;
                keep
            });
        }
    }
}

/// Display, status, counts, the error over time, the time of each pass, the plan.
pub(crate) fn progress_ui(ui: &mut Ui, document: &Document, rendering: &Rendering, commands: &mut Vec<AppCommand>) {
    display_ui(ui, document, commands);
    ui.separator();
    let Some(frame) = rendering.frame() else {
        ui.weak("No picture yet");
        return;
    };
    counts_ui(ui, frame.iteration, &frame.stats);
    target_ui(ui, rendering.target, commands);
    ui.add_space(4.0);
    curve_ui(ui, rendering.error_curve(), rendering.target);
    CollapsingHeader::new("Time per iteration").default_open(true).show(ui, |ui| passes_ui(ui, &frame.stats));
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
        row("Error estimate", stats.error_estimate.map_or("not known yet".to_owned(), percent));
        if stats.dropped_samples > 0 {
            row("Dropped samples", grouped(stats.dropped_samples));
        }
    });
}

/// In percent; 0 is none.
fn target_ui(ui: &mut Ui, target: Option<f64>, commands: &mut Vec<AppCommand>) {
    let mut percent = 100.0 * target.unwrap_or(0.0);
    ui.horizontal(|ui| {
        let label = ui.weak("Rest at");
        let field = DragValue::new(&mut percent)
            .range(0.0..=100.0)
            .speed(0.01)
            .max_decimals(3)
            .update_while_editing(false)
            .custom_formatter(|percent, _| target_text(percent))
            .custom_parser(|text| text.trim().trim_end_matches('%').trim().parse().ok());
        let field = ui.add(field).labelled_by(label.id);
        if field.on_hover_text("Rendering rests once the error estimate is no more than this; 0: never").changed() {
            commands.push(AppCommand::Target((percent > 0.0).then_some(0.01 * percent)));
        }
    });
}

fn curve_ui(ui: &mut Ui, curve: &ErrorCurve, target: Option<f64>) {
    let known = !curve.points.is_empty();
    let color = theme::palette(ui.visuals().dark_mode).plot;
    let target_color = ui.visuals().weak_text_color();
    let line = Line::new("error", PlotPoints::from(curve.points.clone())).color(color).width(2.0);
    // The first measurement is no line yet.
    let newest = PlotPoints::from(curve.points.last().copied().into_iter().collect::<Vec<_>>());
    let newest = Points::new("newest error", newest).color(color).radius(3.0);
    let plot = Plot::new("error curve")
        .height(130.0)
        .show_axes(known)
        .show_grid(known)
        .x_grid_spacer(round_marks)
        .y_grid_spacer(round_marks)
        .allow_scroll(false)
        .allow_zoom(false)
        .allow_drag(false)
        .allow_boxed_zoom(false)
        .x_axis_formatter(|mark, _| format!("{} s", two_digits(10_f64.powf(mark.value))))
        .y_axis_formatter(|mark, _| format!("{} %", two_digits(100.0 * 10_f64.powf(mark.value))))
        .label_formatter(|_| None);
    plot.show(ui, |plot| {
        plot.line(line);
        plot.points(newest);
        // Only where it is near: else it would press the curve flat.
        let lowest = curve.points.last().map(|point| point[1]);
        if let (Some(lowest), Some(target)) = (lowest, target.map(f64::log10).filter(|target| target.is_finite()))
            && target > lowest - 0.5
        {
            plot.hline(HLine::new("target", target).color(target_color).width(1.0));
        }
    });
    ui.weak(if known { "Error over time, logarithmic" } else { "No error estimate yet" });
}

/// Marks at round numbers, of which there are fewer the more powers of ten the axis holds.
fn round_marks(input: GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let digits: &[f64] = match high - low {
        span if span > 2.5 => &[1.0],
        span if span > 0.7 => &[1.0, 2.0, 5.0],
        _ => &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0],
    };
    let decades = (low.floor() as i32)..=(high.ceil() as i32);
    // One at the very edge would lose half of its label.
    let inset = 0.08 * (high - low);
    let marks = decades.flat_map(|decade| digits.iter().map(move |digit| f64::from(decade) + digit.log10()));
    // One size for all, for the plot fades the marks of smaller steps.
    let inner = (low + inset)..=(high - inset);
    marks.filter(|value| inner.contains(value)).map(|value| GridMark { value, step_size: 1.0 }).collect()
}

/// Of one iteration, on the average; and of the preparation before them.
fn passes_ui(ui: &mut Ui, stats: &Stats) {
    let PassSeconds { prepare, camera, photons, map, gather, commit } = stats.passes;
    let passes = [("Camera", camera), ("Photons", photons), ("Map", map), ("Gather", gather), ("Commit", commit)];
    let (whole, count) = (camera + photons + map + gather + commit, stats.iterations.max(1) as f64);
    Grid::new("passes").num_columns(3).spacing([12.0, 3.0]).show(ui, |ui| {
        for (label, seconds) in passes {
            ui.weak(label);
            ui.label(format!("{:.1} ms", 1e3 * seconds / count));
            ui.weak(format!("{:.0} %", 100.0 * seconds / whole.max(f64::MIN_POSITIVE)));
            ui.end_row();
        }
        ui.weak("Preparation");
        ui.label(format!("{:.1} ms", 1e3 * prepare));
        ui.end_row();
    });
}

/// To a thousandth, without the rounding of the conversion from parts to percent.
fn target_text(percent: f64) -> String {
    if percent > 0.0 { format!("{} %", (1e3 * percent).round() / 1e3) } else { "never".to_owned() }
}

/// A positive number to two significant digits.
fn two_digits(number: f64) -> String {
    let decimals = (1.0 - number.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{number:.decimals$}");
    if decimals > 0 { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// 1234567 as "1 234 567".
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// 1234567 as "1.23 M".
fn short(number: f64) -> String {
    let steps = [(1e12, " T"), (1e9, " G"), (1e6, " M"), (1e3, " k")];
    match steps.into_iter().find(|(size, _)| number >= *size) {
        Some((size, unit)) => format!("{:.2}{unit}", number / size),
        None => format!("{number:.0}"),
    }
}

/// Seconds as "12.3 s", "2:05" or "1:02:05".
pub(crate) fn duration(seconds: f64) -> String {
    let whole = seconds.max(0.0) as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, _) => format!("{seconds:.1} s"),
        (0, minutes, seconds) => format!("{minutes}:{seconds:02}"),
        (hours, minutes, seconds) => format!("{hours}:{minutes:02}:{seconds:02}"),
    }
}

fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    if percent >= 10.0 { format!("{percent:.0} %") } else { format!("{percent:.2} %") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_readable() {
        assert_eq!([grouped(7), grouped(1234), grouped(1_234_567)], ["7", "1 234", "1 234 567"]);
        assert_eq!([short(999.0), short(1234.0), short(2.5e6)], ["999", "1.23 k", "2.50 M"]);
        assert_eq!(
            [two_digits(0.0316), two_digits(1.6), two_digits(10.0), two_digits(251.0)],
            ["0.032", "1.6", "10", "251"]
        );
        assert_eq!([target_text(100.0 * (0.01 * 7.0)), target_text(0.0)], ["7 %", "never"]);
        assert_eq!([duration(5.04), duration(125.9), duration(3725.0)], ["5.0 s", "2:05", "1:02:05"]);
    }

    #[test]
    fn another_generation_begins_the_curve_anew() {
        let mut curve = ErrorCurve::default();
        curve.push(1, 1.0, 0.1);
        curve.push(1, 10.0, 0.01);
        assert_eq!(curve.points, [[0.0, -1.0], [1.0, -2.0]]);
        curve.push(2, 0.1, 1.0);
        assert_eq!(curve.points, [[-1.0, 0.0]]);
    }

    #[test]
    fn the_curve_stays_small_and_keeps_its_ends() {
        let mut curve = ErrorCurve::default();
        for second in 1..=10_000 {
            curve.push(1, f64::from(second), 0.5);
        }
        assert!(curve.points.len() <= CURVE_POINTS, "{}", curve.points.len());
        assert_eq!(curve.points.first().map(|point| point[0]), Some(0.0), "the first second");
    }
}
