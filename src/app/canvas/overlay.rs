//! Painting of control nets, handles and drag axes over the picture.

use super::drag::Constraint;
use super::stage::{ScreenHandle, Stage};
use crate::app::document::Handle;
use crate::app::theme::{self, overlay};
use crate::scene::Bezier;
use egui::{Color32, Painter, Pos2, Rect, Stroke, StrokeKind, Vec2, vec2};

/// Radius of a handle at every zoom, screen points.
const RADIUS: f32 = 4.0;
/// Radius of the handle under the pointer, screen points.
const RADIUS_HOVERED: f32 = 6.0;

/// Paints the control nets of an object; the net in the side panel stands out.
pub(crate) fn paint_net(painter: &Painter, stage: &Stage<'_>, bezier: &Bezier) {
    let world_from_object = bezier.transform.world_from_object();
    for (patch, net) in bezier.patches.iter().enumerate() {
        let shown = stage.document.selection.patch == patch;
        let screen = net.points.map(|row| row.map(|point| stage.screen(world_from_object.transform_point3(point))));
        for (i, row) in screen.iter().enumerate() {
            for (j, &from) in row.iter().enumerate() {
                let along_u = screen.get(i + 1).map(|next| next[j]);
                let along_v = row.get(j + 1).copied();
                for to in [along_u, along_v].into_iter().flatten() {
                    paint_segment(painter, from.zip(to), shown);
                }
            }
        }
    }
}

fn paint_segment(painter: &Painter, ends: Option<(Pos2, Pos2)>, shown: bool) {
    let Some((from, to)) = ends else { return };
    if shown {
        painter.line_segment([from, to], Stroke::new(3.0, overlay::OUTLINE));
        painter.line_segment([from, to], Stroke::new(1.2, overlay::NET));
    } else {
        painter.line_segment([from, to], Stroke::new(1.0, overlay::NET_FAINT));
    }
}

/// Paints a dot for a control point, a square for an object, a sun for a light; `hot` under the pointer.
pub(crate) fn paint_handle(painter: &Painter, stage: &Stage<'_>, drawn: &ScreenHandle, hot: bool) {
    let radius = if hot { RADIUS_HOVERED } else { RADIUS };
    let fill = match drawn.handle {
        _ if hot => overlay::HOVERED,
        _ if stage.is_selected(drawn.handle) && !matches!(drawn.handle, Handle::Object(_)) => overlay::SELECTED,
        Handle::Light(_) => overlay::LIGHT,
        Handle::Point { .. } | Handle::Object(_) => overlay::HANDLE,
    };
    match drawn.handle {
        Handle::Point { .. } => paint_dot(painter, drawn.screen, radius, fill),
        Handle::Object(_) => paint_square(painter, drawn.screen, radius, fill),
        Handle::Light(_) => {
            paint_rays(painter, drawn.screen, radius, fill);
            paint_dot(painter, drawn.screen, radius, fill);
        }
    }
}

fn paint_dot(painter: &Painter, at: Pos2, radius: f32, fill: Color32) {
    painter.circle(at, radius, fill, Stroke::new(1.5, overlay::OUTLINE));
}

fn paint_square(painter: &Painter, at: Pos2, radius: f32, fill: Color32) {
    let rect = Rect::from_center_size(at, Vec2::splat(2.0 * radius + 1.0));
    painter.rect(rect, 1.0, fill, Stroke::new(1.5, overlay::OUTLINE), StrokeKind::Outside);
}

fn paint_rays(painter: &Painter, at: Pos2, radius: f32, color: Color32) {
    for k in 0..8 {
        let (sin, cos) = (k as f32 * std::f32::consts::FRAC_PI_4).sin_cos();
        let ends = [at + vec2(cos, sin) * (radius + 2.5), at + vec2(cos, sin) * (radius + 6.5)];
        painter.line_segment(ends, Stroke::new(3.5, overlay::OUTLINE));
        painter.line_segment(ends, Stroke::new(1.5, color));
    }
}

/// Paints the axis that a drag is bound to.
pub(crate) fn paint_constraint(painter: &Painter, stage: &Stage<'_>, handle: Handle, constraint: Constraint) {
    let Constraint::Axis(axis) = constraint else { return };
    let Some(at) = handle.position(stage.document.scene()) else { return };
    // Each half is half as long as the handle is deep: long enough to leave most pictures on both sides.
    let reach = axis * stage.projection.depth(at) * 0.5;
    if let (Some(from), Some(to)) = (stage.screen(at - reach), stage.screen(at + reach)) {
        let [x, y, z] = theme::palette(true).axes;
        let color = if axis.x == 1.0 {
            x
        } else if axis.y == 1.0 {
            y
        } else {
            z
        };
        painter.with_clip_rect(stage.transform.canvas).line_segment([from, to], Stroke::new(1.5, color));
    }
}
