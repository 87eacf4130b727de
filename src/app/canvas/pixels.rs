//! The grid between film pixels and their numbers, where the picture is magnified enough for them.

use super::view::ScreenTransform;
use crate::app::theme::overlay;
use crate::film::{LinearImage, ToneMap};
use crate::scene::Film;
use egui::{Align2, Color32, FontId, Painter, Stroke};
use glam::DVec2;
use std::ops::Range;

/// Scale from which the grid is shown, screen pixels per film pixel.
const GRID_SCALE: f32 = 16.0;
/// Size of the font of the numbers over the side of a pixel: three lines of six digits fill the pixel.
const FONT_SIZE: f32 = 0.24;
/// Sizes of the font, screen points; numbers in a smaller font are not shown.
const FONT_SIZES: std::ops::RangeInclusive<f32> = 8.0..=14.0;
/// Most characters of a number.
const DIGITS: usize = 6;
/// Brightness of a pixel from which its numbers are black, of 255.
const BRIGHT: f32 = 140.0;

/// Paints the grid, and the linear RGB of each pixel where the numbers fit. `image` has the size of the film; `None` for a
/// draft with fewer pixels, which has a grid only.
pub(super) fn paint_pixels(painter: &Painter, transform: &ScreenTransform, film: &Film, image: Option<&LinearImage>) {
    if transform.scale * painter.pixels_per_point() < GRID_SCALE {
        return;
    }
    let (columns, rows) = visible(transform);
    paint_grid(painter, transform, &columns, &rows);
    let font = (FONT_SIZE * transform.scale).floor().min(*FONT_SIZES.end());
    if let Some(image) = image.filter(|_| font >= *FONT_SIZES.start()) {
        let (font, tone) = (FontId::monospace(font), ToneMap::new(film.exposure, film.tone_curve));
        for (column, row) in rows.flat_map(|row| columns.clone().map(move |column| (column, row))) {
            let Some(pixel) = image.pixels.get(row as usize * image.width as usize + column as usize) else { continue };
            let center = transform.to_screen(DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5));
            let text = pixel.to_array().map(channel_text).join("\n");
            painter.text(center, Align2::CENTER_CENTER, text, font.clone(), readable_on(tone.map(*pixel)));
        }
    }
}

/// Columns and rows of the film pixels on the canvas.
fn visible(transform: &ScreenTransform) -> (Range<u32>, Range<u32>) {
    let shown = transform.canvas.intersect(transform.picture());
    let (first, last) = (transform.to_film(shown.min), transform.to_film(shown.max));
    let range =
        |first: f64, last: f64, size: f32| (first.max(0.0) as u32)..(last.ceil().max(0.0) as u32).min(size as u32);
    (range(first.x, last.x, transform.film.x), range(first.y, last.y, transform.film.y))
}

fn paint_grid(painter: &Painter, transform: &ScreenTransform, columns: &Range<u32>, rows: &Range<u32>) {
    let shown = transform.canvas.intersect(transform.picture());
    let stroke = Stroke::new(1.0 / painter.pixels_per_point(), overlay::GRID);
    for column in columns.clone() {
        let x = transform.to_screen(DVec2::new(f64::from(column), 0.0)).x;
        painter.vline(x, shown.y_range(), stroke);
    }
    for row in rows.clone() {
        let y = transform.to_screen(DVec2::new(0.0, f64::from(row))).y;
        painter.hline(shown.x_range(), y, stroke);
    }
}

/// A number in at most six characters, with as many digits as they hold.
fn channel_text(value: f32) -> String {
    let is_tiny = value != 0.0 && value.abs() < 1e-3;
    let plain = (0..=4).rev().map(|decimals| format!("{value:.decimals$}"));
    let short = plain.into_iter().find(|text| text.len() <= DIGITS && !is_tiny);
    short.unwrap_or_else(|| format!("{value:.1e}"))
}

/// Black on a bright colour, white on a dark one.
fn readable_on([red, green, blue]: [u8; 3]) -> Color32 {
    let brightness = 0.299 * f32::from(red) + 0.587 * f32::from(green) + 0.114 * f32::from(blue);
    if brightness >= BRIGHT { Color32::BLACK } else { Color32::WHITE }
}

#[cfg(test)]
mod tests {
    use super::super::view::View;
    use super::*;
    use egui::{Rect, pos2, vec2};

    #[test]
    fn numbers_have_at_most_six_characters() {
        for (value, text) in [
            (0.0, "0.0000"),
            (0.123_456, "0.1235"),
            (9.999_99, "10.000"),
            (123.456, "123.46"),
            (65_504.0, "65504"),
            (1.23e7, "1.2e7"),
            (1.2e-5, "1.2e-5"),
            (f32::NAN, "NaN"),
        ] {
            assert_eq!(channel_text(value), text);
        }
    }

    #[test]
    fn numbers_contrast_with_their_pixel() {
        assert_eq!(readable_on([255, 255, 255]), Color32::BLACK);
        assert_eq!(readable_on([0, 0, 255]), Color32::WHITE, "blue is dark");
        assert_eq!(readable_on([0, 255, 0]), Color32::BLACK, "green is bright");
    }

    #[test]
    fn only_pixels_on_the_canvas_are_visible() {
        let canvas = Rect::from_min_size(pos2(100.0, 50.0), vec2(320.0, 160.0));
        let view = View::Free { scale: 32.0, center: vec2(5.25, 60.0) };
        let (columns, rows) = visible(&view.transform(canvas, vec2(64.0, 62.0)));
        assert_eq!((columns, rows), (0..11, 57..62));
    }
}
