//! The plot of the error estimate over time.

use super::numbers::two_digits;
use crate::app::rendering::ErrorCurve;
use crate::app::theme;
use egui::Ui;
use egui_plot::{GridInput, GridMark, HLine, Line, Plot, PlotPoints, Points};

/// Plots the error curve on logarithmic axes, with the target error where it lies near the curve.
pub(super) fn error_plot_ui(ui: &mut Ui, curve: &ErrorCurve, target: Option<f64>) {
    let points = curve.points();
    let known = !points.is_empty();
    let color = theme::palette(ui.visuals().dark_mode).plot;
    let target_color = ui.visuals().weak_text_color();
    let line = Line::new("error", PlotPoints::from(points.to_vec())).color(color).width(2.0);
    // A single measurement has no line, so its point is drawn as well.
    let newest = PlotPoints::from(points.last().copied().into_iter().collect::<Vec<_>>());
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
        // A target far below the curve would flatten the curve.
        let lowest = points.last().map(|point| point[1]);
        if let (Some(lowest), Some(target)) = (lowest, target.map(f64::log10).filter(|target| target.is_finite()))
            && target > lowest - 0.5
        {
            plot.hline(HLine::new("target", target).color(target_color).width(1.0));
        }
    });
    ui.weak(if known { "Error over time, logarithmic" } else { "No error estimate yet" });
}

/// Grid marks at round numbers. An axis over more powers of ten has fewer marks per power.
fn round_marks(input: GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let digits: &[f64] = match high - low {
        span if span > 2.5 => &[1.0],
        span if span > 0.7 => &[1.0, 2.0, 5.0],
        _ => &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0],
    };
    let decades = (low.floor() as i32)..=(high.ceil() as i32);
    // A mark at the edge would lose half of its label.
    let margin = 0.08 * (high - low);
    let marks = decades.flat_map(|decade| digits.iter().map(move |digit| f64::from(decade) + digit.log10()));
    // The plot fades marks of smaller steps, so all marks have one step size.
    let inner = (low + margin)..=(high - margin);
    marks.filter(|value| inner.contains(value)).map(|value| GridMark { value, step_size: 1.0 }).collect()
}
