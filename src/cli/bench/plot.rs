//! The plot of error over time, on logarithmic axes.

use super::{
    axis::{Axis, axis, is_shown, label},
    measurement::Measurement,
    median::medians,
    slope::slopes,
};
use crate::cli::CliError;
use image::{ColorType, ImageEncoder, codecs::png::PngEncoder};
use plotters::backend::BitMapBackend;
use plotters::{
    chart::ChartBuilder,
    coord::{
        Shift,
        combinators::{BindKeyPoints, IntoLogRange},
    },
    drawing::{DrawingArea, IntoDrawingArea},
    element::{Circle, PathElement, Text},
    series::LineSeries,
    style::{BLACK, Color, FontStyle, RGBColor, ShapeStyle, WHITE, register_font},
};
use std::error::Error;

const WIDTH: u32 = 960;
const HEIGHT: u32 = 640;

/// Rows of pixels above the axes, for the title and the legend.
const HEAD: u32 = 72;

/// The name of the font inside the program, which makes plots equal on all systems.
const FONT: &str = "plot";

/// The number of characters of a title that fit.
const TITLE: usize = 70;

/// One error over time.
struct Curve {
    name: String,
    color: RGBColor,
    /// Seconds and error: the median over the seeds at each mark.
    medians: Vec<(f64, f64)>,
    /// Seconds and error of each seed at each mark.
    seeds: Vec<(f64, f64)>,
}

/// The plot as the bytes of a PNG file.
pub(super) fn png(title: &str, rows: &[Measurement]) -> Result<Vec<u8>, CliError> {
    let failed = |e: Box<dyn Error>| CliError::Failed(format!("the plot cannot be drawn: {e}"));
    let mut pixels = vec![0; 3 * WIDTH as usize * HEIGHT as usize];
    draw(&mut pixels, title, &curves(rows)).map_err(failed)?;
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(&pixels, WIDTH, HEIGHT, ColorType::Rgb8.into())
        .map_err(|e| failed(e.into()))?;
    Ok(bytes)
}

fn curves(rows: &[Measurement]) -> [Curve; 2] {
    let medians = medians(rows);
    let slopes = slopes(&medians);
    let name = |name: &str, slope: Option<f64>| match slope {
        Some(slope) => format!("{name}, at last like t^{slope:.2}"),
        None => name.to_owned(),
    };
    let shown = |points: &mut Vec<(f64, f64)>| points.retain(|(x, y)| is_shown(*x) && is_shown(*y));
    let mut curves = [
        Curve {
            name: name("RMSE", slopes.map(|s| s.rmse)),
            color: RGBColor(0x1f, 0x5f, 0xbf),
            medians: medians.iter().map(|m| (m.seconds, m.errors.rmse)).collect(),
            seeds: rows.iter().map(|row| (row.stats.seconds, row.errors.rmse)).collect(),
        },
        Curve {
            name: name("relMSE", slopes.map(|s| s.rel_mse)),
            color: RGBColor(0xc8, 0x4b, 0x11),
            medians: medians.iter().map(|m| (m.seconds, m.errors.rel_mse)).collect(),
            seeds: rows.iter().map(|row| (row.stats.seconds, row.errors.rel_mse)).collect(),
        },
    ];
    for curve in &mut curves {
        shown(&mut curve.medians);
        shown(&mut curve.seeds);
    }
    curves
}

fn draw(pixels: &mut [u8], title: &str, curves: &[Curve]) -> Result<(), Box<dyn Error>> {
    register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| "the font inside the program is damaged")?;
    let root = BitMapBackend::with_buffer(pixels, (WIDTH, HEIGHT)).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(HEAD);
    draw_head(&head, title, curves)?;
    draw_body(&body, curves)?;
    root.present()?;
    Ok(())
}

/// Draws the title and below it the legend, outside of the axes and so clear of the curves.
fn draw_head(
    area: &DrawingArea<BitMapBackend<'_>, Shift>,
    title: &str,
    curves: &[Curve],
) -> Result<(), Box<dyn Error>> {
    area.draw(&Text::new(shortened(title), (90, 14), (FONT, 24)))?;
    for (x, curve) in (90..).step_by(300).zip(curves) {
        let style = line_style(curve);
        area.draw(&PathElement::new([(x, 54), (x + 32, 54)], style))?;
        area.draw(&Circle::new((x + 16, 54), 4, curve.color.filled()))?;
        area.draw(&Text::new(curve.name.clone(), (x + 42, 49), (FONT, 18)))?;
    }
    Ok(())
}

fn draw_body(area: &DrawingArea<BitMapBackend<'_>, Shift>, curves: &[Curve]) -> Result<(), Box<dyn Error>> {
    let points = || curves.iter().flat_map(|curve| curve.medians.iter().chain(&curve.seeds));
    let (x, y) = (axis(points().map(|point| point.0)), axis(points().map(|point| point.1)));
    let range =
        |axis: Axis| (axis.low..axis.high).log_scale().with_key_points(axis.labels).with_light_points(axis.lines);
    let mut chart = ChartBuilder::on(area)
        .margin_top(8)
        .margin_right(32)
        .margin_bottom(8)
        .margin_left(8)
        .x_label_area_size(56)
        .y_label_area_size(82)
        .build_cartesian_2d(range(x), range(y))?;
    chart
        .configure_mesh()
        .label_style((FONT, 17))
        .axis_desc_style((FONT, 19))
        .x_desc("seconds")
        .y_desc("error")
        .x_label_formatter(&|x| label(*x))
        .y_label_formatter(&|y| label(*y))
        .light_line_style(BLACK.mix(0.06))
        .bold_line_style(BLACK.mix(0.15))
        .draw()?;
    for curve in curves {
        let dots = |points: &[(f64, f64)], radius, style: ShapeStyle| {
            points.iter().map(|point| Circle::new(*point, radius, style)).collect::<Vec<_>>()
        };
        chart.draw_series(dots(&curve.seeds, 3, curve.color.mix(0.35).filled()))?;
        chart.draw_series(LineSeries::new(curve.medians.iter().copied(), line_style(curve)))?;
        chart.draw_series(dots(&curve.medians, 4, curve.color.filled()))?;
    }
    Ok(())
}

fn line_style(curve: &Curve) -> ShapeStyle {
    curve.color.stroke_width(2)
}

/// The title, cut to the length that fits.
fn shortened(title: &str) -> String {
    match title.char_indices().nth(TITLE) {
        Some((end, _)) => format!("{}...", &title[..end]),
        None => title.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        engine::Stats,
        film::{Errors, LinearImage, compare},
    };

    fn row(seed: u64, seconds: f64, rmse: f64) -> Measurement {
        let black = LinearImage::black(1, 1);
        let errors = Errors { rmse, rel_mse: rmse * rmse, ..compare(&black, &black, None).unwrap() };
        let stats = Stats { seconds, ..Stats::default() };
        Measurement { seed, mark: seconds, stats, errors, outside: None, flip: None, flip_outside: None }
    }

    /// All pixels of a colour below the head.
    fn positions(png: &[u8], color: RGBColor) -> Vec<(u32, u32)> {
        let image = image::load_from_memory(png).unwrap().into_rgb8();
        assert_eq!(image.dimensions(), (WIDTH, HEIGHT));
        let colored = image.enumerate_pixels().filter(|(_, y, p)| *y >= HEAD && p.0 == [color.0, color.1, color.2]);
        colored.map(|(x, y, _)| (x, y)).collect()
    }

    #[test]
    fn curves_fall_from_the_upper_left_to_the_lower_right() {
        let rows = [row(0, 1.0, 0.1), row(0, 2.0, 0.05), row(0, 4.0, 0.02)];
        let png = png("a title", &rows).unwrap();
        for curve in curves(&rows) {
            let positions = positions(&png, curve.color);
            let (first, last) = (positions.iter().min().unwrap(), positions.iter().max().unwrap());
            assert!(first.0 + 400 < last.0 && first.1 + 50 < last.1, "{}: {first:?} {last:?}", curve.name);
        }
    }

    #[test]
    fn colours_are_named_with_their_slopes() {
        let names = |rows: &[Measurement]| curves(rows).map(|curve| curve.name);
        let rows = [row(0, 1.0, 0.1), row(0, 4.0, 0.05)];
        assert_eq!(names(&rows), ["RMSE, at last like t^-0.50", "relMSE, at last like t^-1.00"]);
        assert_eq!(names(&rows[..1]), ["RMSE", "relMSE"]);
    }

    #[test]
    fn each_seed_has_a_point() {
        let rows = [row(0, 1.0, 0.1), row(1, 1.0, 0.3), row(2, 1.0, 0.2)];
        let [rmse, _] = curves(&rows);
        assert_eq!(rmse.medians, [(1.0, 0.2)]);
        assert_eq!(rmse.seeds, [(1.0, 0.1), (1.0, 0.3), (1.0, 0.2)]);
    }

    #[test]
    fn there_is_a_plot_of_no_errors_too() {
        for rows in [&[][..], &[row(0, 1.0, 0.0), row(0, 2.0, f64::NAN)]] {
            let png = png(&"\u{4e2d}".repeat(200), rows).unwrap();
            assert_eq!(positions(&png, curves(rows)[0].color), []);
        }
    }
}
