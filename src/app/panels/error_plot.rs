//! The plot of the error estimate over time.

use super::numbers::two_digits;
use crate::app::rendering::ErrorCurve;
use crate::app::theme;
use egui::Ui;
use egui_plot::{GridInput, GridMark, HLine, Line, Plot, PlotPoints, Points};

/// Least length of an axis, powers of ten.
const LEAST_SPAN: f64 = 1.0;
/// Part of an axis at each end that has no labels.
const MARGIN: f64 = 0.08;
/// Distance of labels along the x axis over its length: a label like "0.15 s" fits.
const X_GAP: f64 = 0.24;
/// Distance of labels along the y axis over its length: the height of a line.
const Y_GAP: f64 = 0.16;

/// Plots the error curve on logarithmic axes, with the target error where it lies near the curve.
pub(super) fn error_plot_ui(ui: &mut Ui, curve: &ErrorCurve, target: Option<f64>) {
    let points = curve.points();
    if points.is_empty() {
        ui.weak("No error estimate yet");
        return;
    }
    let color = theme::palette(ui.visuals().dark_mode).plot;
    let target_color = ui.visuals().weak_text_color();
    let line = Line::new("error", PlotPoints::from(points.to_vec())).color(color).width(2.0);
    // A single measurement has no line, so its point is drawn as well.
    let newest = PlotPoints::from(points.last().copied().into_iter().collect::<Vec<_>>());
    let newest = Points::new("newest error", newest).color(color).radius(3.0);
    let plot = Plot::new("error curve")
        .height(130.0)
        .grid_color(ui.visuals().widgets.noninteractive.bg_stroke.color)
        .x_grid_spacer(|input| round_marks(&input, X_GAP))
        .y_grid_spacer(|input| round_marks(&input, Y_GAP))
        .allow_scroll(false)
        .allow_zoom(false)
        .allow_drag(false)
        .allow_boxed_zoom(false)
        .x_axis_formatter(|mark, _| format!("{} s", two_digits(10_f64.powf(mark.value))))
        .y_axis_formatter(|mark, _| format!("{} %", two_digits(100.0 * 10_f64.powf(mark.value))))
        .label_formatter(|_| None);
    let ([left, right], [bottom, top]) = (span(points, 0), span(points, 1));
    let plot = plot.include_x(left).include_x(right).include_y(bottom).include_y(top);
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
    ui.weak("Error over time, logarithmic");
}

/// The range of the curve along one axis, decimal logarithms, widened to the least span: a shorter axis would have no round
/// number to label.
fn span(points: &[[f64; 2]], axis: usize) -> [f64; 2] {
    let low = points.iter().map(|point| point[axis]).fold(f64::INFINITY, f64::min);
    let high = points.iter().map(|point| point[axis]).fold(f64::NEG_INFINITY, f64::max);
    let missing = (LEAST_SPAN - (high - low)).max(0.0);
    [low - 0.5 * missing, high + 0.5 * missing]
}

/// Grid marks at round numbers whose labels do not overlap: first powers of ten, then finer numbers between them while
/// neighbours keep a distance of `gap` times the length of the axis.
fn round_marks(input: &GridInput, gap: f64) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    // A mark at the edge would lose half of its label.
    let margin = MARGIN * (high - low);
    let inner = (low + margin)..=(high - margin);
    let decades = (low.floor() as i32)..=(high.ceil() as i32);
    let mut kept: Vec<f64> = Vec::new();
    // Coarse digits come first.
    for digit in [1.0_f64, 2.0, 5.0, 3.0, 1.5, 7.0] {
        for decade in decades.clone() {
            let value = f64::from(decade) + digit.log10();
            let is_apart = kept.iter().all(|other| (other - value).abs() >= gap * (high - low));
            if inner.contains(&value) && is_apart {
                kept.push(value);
            }
        }
    }
    // The plot fades marks of small steps, so all marks have a step as long as the axis.
    kept.into_iter().map(|value| GridMark { value, step_size: high - low }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_has_two_to_eight_labels_that_do_not_overlap() {
        for gap in [X_GAP, Y_GAP] {
            for span in [LEAST_SPAN, 1.3, 2.0, 3.5, 7.0, 12.0] {
                for low in (0..100).map(|k| -3.0 + 0.037 * f64::from(k)) {
                    let input = GridInput { bounds: (low, low + span), base_step_size: 1.0 };
                    let mut marks: Vec<_> = round_marks(&input, gap).into_iter().map(|mark| mark.value).collect();
                    marks.sort_by(f64::total_cmp);
                    assert!((2..=8).contains(&marks.len()), "{low} to {}: {marks:?}", low + span);
                    assert!(marks.windows(2).all(|pair| pair[1] - pair[0] >= gap * span), "{marks:?}");
                }
            }
        }
    }

    #[test]
    fn the_axes_of_a_short_curve_are_widened() {
        assert_eq!(span(&[[1.0, -2.0]], 0), [1.0 - 0.5 * LEAST_SPAN, 1.0 + 0.5 * LEAST_SPAN]);
        assert_eq!(span(&[[1.0, -2.0], [4.0, -3.0]], 0), [1.0, 4.0]);
    }
}
