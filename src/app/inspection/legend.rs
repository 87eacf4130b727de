//! The legend of a view: its colours with their numbers, the number at the pointer, and those of the selected object.

use super::colors::{LINES, color};
use super::state::Inspection;
use crate::app::commands::PictureView;
use crate::app::theme::overlay;
use egui::{Align2, FontId, Rect, Ui, pos2, vec2};

/// Least width of the legend, and height of a line of its text, screen points.
const WIDTH: f32 = 250.0;
const LINE: f32 = 16.0;
/// Steps of the bar of colours.
const STEPS: u32 = 50;

/// Shows the legend in the upper left corner of the canvas. `pixel` is the film pixel under the pointer, `selected` the name and the index of
/// the selected object, `error` the estimated relative error of the picture.
pub(crate) fn legend_ui(
    ui: &Ui,
    canvas: Rect,
    inspection: &Inspection,
    pixel: Option<(u32, u32)>,
    selected: Option<(&str, usize)>,
    error: Option<f64>,
) {
    let view = inspection.view();
    if view == PictureView::Light {
        return;
    }
    let mut lines = vec![view.label().to_owned()];
    let scale = inspection.scaled().map(|scaled| scaled.scale);
    if scale.is_some() {
        let number = pixel.and_then(|pixel| inspection.number_at(pixel));
        let uncertainty = error.filter(|_| view == PictureView::Irradiance);
        let uncertainty = uncertainty.map_or(String::new(), |error| format!(" ± {:.2} %", 100.0 * error));
        lines.push(format!("pointer: {}", number.map_or("no number".to_owned(), |n| text(view, n) + &uncertainty)));
        if let Some((name, object)) = selected {
            let numbers = inspection.statistics(object).map(|numbers| {
                let [least, mean, greatest] = [numbers.least, numbers.mean, numbers.greatest].map(|n| text(view, n));
                format!("{least}, mean {mean}, to {greatest}")
            });
            lines.push(format!("{name}: {}", numbers.unwrap_or_else(|| "no number".to_owned())));
        }
        lines.push(String::new());
    } else if inspection.texture().is_none() {
        lines.push("After the first iteration".to_owned());
    }
    let height = LINE * lines.len() as f32 + if scale.is_some() { 2.0 * LINE } else { 0.0 } + 10.0;
    let of_line = |text: &String| {
        ui.painter().layout_no_wrap(text.clone(), FontId::proportional(12.0), overlay::LEGEND_TEXT).size().x
    };
    let widest = lines.iter().map(of_line).fold(0.0, f32::max);
    let width = (widest + 20.0).clamp(WIDTH, (canvas.width() - 20.0).max(WIDTH));
    let rect = Rect::from_min_size(canvas.left_top() + vec2(10.0, 10.0), vec2(width, height));
    if !canvas.contains_rect(rect) {
        return;
    }
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 5.0, overlay::LEGEND);
    let write = |x: f32, y: f32, align: Align2, text: &str| {
        painter.text(pos2(x, y), align, text, FontId::proportional(12.0), overlay::LEGEND_TEXT);
    };
    for (line, text) in (0..).zip(&lines) {
        write(rect.left() + 10.0, rect.top() + 6.0 + LINE * line as f32, Align2::LEFT_TOP, text);
    }
    let Some(scale) = scale else { return };
    let top = rect.top() + 6.0 + LINE * (lines.len() as f32 - 1.0);
    let bar = Rect::from_min_max(pos2(rect.left() + 10.0, top + 4.0), pos2(rect.right() - 10.0, top + 16.0));
    for step in 0..STEPS {
        let [left, right] = [step, step + 1].map(|k| bar.left() + bar.width() * k as f32 / STEPS as f32);
        let part = Rect::from_min_max(pos2(left, bar.top()), pos2(right, bar.bottom()));
        painter.rect_filled(part, 0.0, color((step as f32 + 0.5) / STEPS as f32));
    }
    for (x, align, part) in [
        (bar.left(), Align2::LEFT_TOP, 0.0),
        (bar.center().x, Align2::CENTER_TOP, 0.5),
        (bar.right(), Align2::RIGHT_TOP, 1.0),
    ] {
        write(x, bar.bottom() + 2.0, align, &text(view, part * scale));
    }
    let isolines = format!("isolines every {}", text(view, scale / LINES as f32));
    write(bar.left(), bar.bottom() + 2.0 + LINE, Align2::LEFT_TOP, &isolines);
}

/// A number of a view, short, with its unit.
pub(super) fn text(view: PictureView, number: f32) -> String {
    let short = |number: f32| match number.abs() {
        0.0 => "0".to_owned(),
        size if !(1e-3..1e4).contains(&size) => format!("{number:.2e}"),
        size => {
            let decimals = (2 - size.log10().floor() as i32).max(0) as usize;
            let fixed = format!("{number:.decimals$}");
            match fixed.contains('.') {
                true => fixed.trim_end_matches('0').trim_end_matches('.').to_owned(),
                false => fixed,
            }
        }
    };
    match view {
        PictureView::Irradiance => format!("{} W/m²", short(number)),
        PictureView::Error => format!("{} %", short(100.0 * number)),
        _ => short(number),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_have_their_unit() {
        for (view, number, expected) in [
            (PictureView::Irradiance, 0.0, "0 W/m²"),
            (PictureView::Irradiance, 12.345, "12.3 W/m²"),
            (PictureView::Irradiance, 0.5, "0.5 W/m²"),
            (PictureView::Irradiance, 5000.0, "5000 W/m²"),
            (PictureView::Irradiance, 1.5e-7, "1.50e-7 W/m²"),
            (PictureView::Error, 0.02, "2 %"),
            (PictureView::Distance, 3.004, "3"),
        ] {
            assert_eq!(text(view, number), expected);
        }
    }
}
