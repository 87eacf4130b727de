//! The way of a drag in numbers, beside the pointer.

use super::stage::Stage;
use egui::{Align2, Frame, Pos2, Rect, RichText, Ui, UiBuilder, Vec2, vec2};
use glam::DVec3;

/// From the pointer to the nearest corner of the readout, screen points.
const OFFSET: Vec2 = vec2(18.0, -18.0);
/// The readout's size at most, screen points: it stays on the canvas.
const SIZE: Vec2 = vec2(400.0, 30.0);

/// Shows the way `delta` of a drag, in the axes of the world, beside the pointer; with the step of the grid and the radius of
/// soft selection where the drag has them. The handle is at `at`.
pub(crate) fn ui(
    ui: &mut Ui,
    stage: &Stage<'_>,
    (pointer, at): (Pos2, DVec3),
    delta: DVec3,
    (grid, radius): (Option<f64>, Option<f64>),
) {
    let resolution = 1.0 / stage.points_per_unit(at);
    let mut text = text(delta, resolution);
    text.extend(grid.map(|step| format!("  grid {step}")));
    text.extend(radius.map(|radius| format!("  radius {radius:.*}", digits(resolution))));
    let anchored = Align2::LEFT_BOTTOM.anchor_size(pointer + OFFSET, SIZE);
    let rect = kept_within(anchored, stage.transform.canvas);
    ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
        Frame::popup(ui.style()).inner_margin(4.0).show(ui, |ui| {
            ui.add(egui::Label::new(RichText::new(text).monospace()).extend().selectable(false));
        });
    });
}

/// A rectangle moved into another; to its corner where it is too large.
fn kept_within(rect: Rect, canvas: Rect) -> Rect {
    let farthest = (canvas.max - rect.size()).max(canvas.min);
    Rect::from_min_size(rect.min.clamp(canvas.min, farthest), rect.size())
}

/// The decimal digits that a step of `resolution` changes, and one more.
fn digits(resolution: f64) -> usize {
    (1.0 - resolution.log10()).ceil().clamp(0.0, 12.0) as usize
}

/// A vector as text, with the digits that a step of `resolution` changes.
fn text(delta: DVec3, resolution: f64) -> String {
    let digits = digits(resolution);
    let number = |value: f64| {
        let rounded = format!("{value:+.digits$}");
        // No way is neither positive nor negative.
        if rounded.chars().all(|c| matches!(c, '+' | '-' | '0' | '.')) {
            rounded.replace(['+', '-'], " ")
        } else {
            rounded
        }
    };
    format!("x {}  y {}  z {}", number(delta.x), number(delta.y), number(delta.z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn the_digits_follow_the_resolution() {
        let delta = DVec3::new(0.123_456, -2.0, -1e-9);
        assert_eq!(text(delta, 0.005), "x +0.1235  y -2.0000  z  0.0000");
        assert_eq!(text(delta, 0.5), "x +0.12  y -2.00  z  0.00");
        assert_eq!(text(1e6 * delta, 300.0), "x +123456  y -2000000  z  0");
        assert_eq!(text(DVec3::ZERO, f64::INFINITY), "x  0  y  0  z  0");
    }

    #[test]
    fn the_readout_stays_on_the_canvas() {
        let canvas = Rect::from_min_size(pos2(100.0, 50.0), SIZE + vec2(0.0, 200.0));
        let kept = kept_within(Rect::from_min_size(pos2(450.0, 20.0), SIZE), canvas);
        assert_eq!(kept.min, pos2(100.0, 50.0), "moved left and down");
        let narrow = Rect::from_min_size(pos2(100.0, 50.0), vec2(40.0, 300.0));
        assert_eq!(kept_within(Rect::from_min_size(pos2(0.0, 60.0), SIZE), narrow).min, pos2(100.0, 60.0));
    }
}
