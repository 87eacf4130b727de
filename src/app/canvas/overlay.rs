//! Painting of control nets, handles, the gizmo and drag axes over the picture.

use super::drag::Constraint;
use super::gizmo::{Axis, Gizmo, Part};
use super::stage::{Look, ScreenHandle, Stage, is_tiny};
use crate::app::document::{Handle, PointIndex};
use crate::app::theme::{self, overlay};
use crate::scene::{Bezier, Revolution};
use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2, vec2};
use glam::{DVec2, DVec3};
use std::array;

/// Radius of a handle at every zoom, screen points.
const RADIUS: f32 = 4.0;
/// Radius of the handle under the pointer, screen points.
const RADIUS_HOVERED: f32 = 6.0;
/// Radius of a handle that an object hides, screen points.
const RADIUS_HIDDEN: f32 = 2.5;
/// Radius of a control point of a patch that is not current, screen points.
const RADIUS_FAINT: f32 = 1.5;
/// Length of an arrow's head, screen points.
const HEAD: f32 = 11.0;

/// Paints the control nets of an object: in full where the camera sees a current patch, faint where an object hides it, and
/// faint where the camera sees another patch, unless that is tiny on the screen.
pub(crate) fn paint_net(painter: &Painter, stage: &Stage<'_>, object: usize, bezier: &Bezier) {
    let world_from_object = bezier.transform.world_from_object();
    for (patch, net) in bezier.patches.iter().enumerate() {
        let current = stage.sight.is_current(patch, stage.document.selection.patch);
        let screen = net.points.map(|row| row.map(|point| stage.screen(world_from_object.transform_point3(point))));
        if !current && is_tiny(screen.as_flattened()) {
            continue;
        }
        let hidden = |i: usize, j: usize| stage.sight.is_point_hidden(object, PointIndex { patch, i, j });
        let hidden: [[bool; 4]; 4] = array::from_fn(|i| array::from_fn(|j| hidden(i, j)));
        for ((i, j), (k, l)) in segments() {
            let is_hidden = hidden[i][j] || hidden[k][l];
            if current || !is_hidden {
                paint_segment(painter, screen[i][j].zip(screen[k][l]), current && !is_hidden);
            }
        }
    }
}

/// Paints the control polygon of the profile of a surface of revolution.
pub(crate) fn paint_profile(painter: &Painter, stage: &Stage<'_>, revolution: &Revolution) {
    let world_from_object = revolution.transform().world_from_object();
    let screen = |point: &DVec2| stage.screen(world_from_object.transform_point3(point.extend(0.0)));
    let screen: Vec<_> = revolution.profile().iter().map(screen).collect();
    screen.windows(2).for_each(|ends| paint_segment(painter, ends[0].zip(ends[1]), true));
}

/// The neighbours in the 4 x 4 control points of a patch, in pairs.
fn segments() -> impl Iterator<Item = ((usize, usize), (usize, usize))> {
    let line = |k: usize| (0..3).map(move |at| (k, at));
    (0..4).flat_map(line).flat_map(|(k, at)| [((k, at), (k, at + 1)), ((at, k), (at + 1, k))])
}

fn paint_segment(painter: &Painter, ends: Option<(Pos2, Pos2)>, full: bool) {
    let Some((from, to)) = ends else { return };
    if full {
        painter.line_segment([from, to], Stroke::new(3.0, overlay::OUTLINE));
        painter.line_segment([from, to], Stroke::new(1.2, overlay::NET));
    } else {
        painter.line_segment([from, to], Stroke::new(1.0, overlay::NET_FAINT));
    }
}

/// Paints a dot for a control point, a square for an object, a sun for a light; `hot` under the pointer.
pub(crate) fn paint_handle(painter: &Painter, stage: &Stage<'_>, drawn: &ScreenHandle, hot: bool) {
    let selected = stage.is_selected(drawn.handle) && !matches!(drawn.handle, Handle::Object(_));
    let radius = match drawn.look {
        _ if hot => RADIUS_HOVERED,
        Look::Full => RADIUS,
        Look::Hidden if selected => RADIUS,
        Look::Hidden => RADIUS_HIDDEN,
        Look::Faint => RADIUS_FAINT,
    };
    let fill = match (drawn.handle, drawn.look) {
        _ if hot => overlay::HOVERED,
        (_, Look::Hidden) if selected => overlay::SELECTED.gamma_multiply(0.5),
        _ if selected => overlay::SELECTED,
        (_, Look::Hidden) => overlay::HIDDEN,
        (_, Look::Faint) => overlay::FAINT,
        (Handle::Light(_), Look::Full) => overlay::LIGHT,
        (Handle::Point { .. } | Handle::Object(_), Look::Full) => overlay::HANDLE,
    };
    let outline = if drawn.look == Look::Full || hot { overlay::OUTLINE } else { overlay::OUTLINE.gamma_multiply(0.4) };
    match drawn.handle {
        Handle::Point { .. } if drawn.look == Look::Faint && !hot => {
            painter.circle_filled(drawn.screen, radius, fill);
        }
        Handle::Point { .. } => paint_dot(painter, drawn.screen, radius, (fill, outline)),
        Handle::Object(_) => paint_square(painter, drawn.screen, radius, (fill, outline)),
        Handle::Light(_) => {
            paint_rays(painter, drawn.screen, radius, (fill, outline));
            paint_dot(painter, drawn.screen, radius, (fill, outline));
        }
    }
}

fn paint_dot(painter: &Painter, at: Pos2, radius: f32, (fill, outline): (Color32, Color32)) {
    painter.circle(at, radius, fill, Stroke::new(1.5, outline));
}

fn paint_square(painter: &Painter, at: Pos2, radius: f32, (fill, outline): (Color32, Color32)) {
    let rect = Rect::from_center_size(at, Vec2::splat(2.0 * radius + 1.0));
    painter.rect(rect, 1.0, fill, Stroke::new(1.5, outline), StrokeKind::Outside);
}

fn paint_rays(painter: &Painter, at: Pos2, radius: f32, (color, outline): (Color32, Color32)) {
    for k in 0..8 {
        let (sin, cos) = (k as f32 * std::f32::consts::FRAC_PI_4).sin_cos();
        let ends = [at + vec2(cos, sin) * (radius + 2.5), at + vec2(cos, sin) * (radius + 6.5)];
        painter.line_segment(ends, Stroke::new(3.5, outline));
        painter.line_segment(ends, Stroke::new(1.5, color));
    }
}

/// Paints the gizmo; `hot` is the part under the pointer.
pub(crate) fn paint_gizmo(painter: &Painter, gizmo: &Gizmo, hot: Option<Part>) {
    for part in &gizmo.parts {
        let color =
            if hot == Some(part.part) { overlay::HOVERED } else { color_of(part.part).gamma_multiply(part.opacity) };
        let outline = overlay::OUTLINE.gamma_multiply(part.opacity);
        match part.outline.as_slice() {
            [from, tip] => paint_arrow(painter, [*from, *tip], (color, outline)),
            corners => {
                let (fill, stroke) = (color.gamma_multiply(0.4), Stroke::new(1.2, color));
                painter.add(Shape::convex_polygon(corners.to_vec(), fill, stroke));
            }
        }
    }
}

fn paint_arrow(painter: &Painter, [from, tip]: [Pos2; 2], (color, outline): (Color32, Color32)) {
    let along = (tip - from).normalized();
    let neck = tip - HEAD * along;
    let across = 0.45 * HEAD * along.rot90();
    painter.line_segment([from, neck], Stroke::new(4.5, outline));
    let head = vec![tip, neck + across, neck - across];
    painter.add(Shape::convex_polygon(head, color, Stroke::new(1.0, outline)));
    painter.line_segment([from, neck], Stroke::new(2.2, color));
}

/// The colour of the part's axis; a square has the colour of the axis across it.
fn color_of(part: Part) -> Color32 {
    let (Part::Arrow(axis) | Part::Square(axis)) = part;
    let [x, y, z] = theme::palette(true).axes;
    match axis {
        Axis::X => x,
        Axis::Y => y,
        Axis::Z => z,
        Axis::Normal => overlay::NORMAL,
    }
}

/// Paints the line through `at` that a drag is bound to.
pub(crate) fn paint_constraint(painter: &Painter, stage: &Stage<'_>, at: DVec3, constraint: Constraint) {
    let Constraint::Axis(axis) = constraint else { return };
    // Each half is half as long as the handle is deep: long enough to leave most pictures on both sides.
    let reach = axis * stage.projection.depth(at) * 0.5;
    if let (Some(from), Some(to)) = (stage.screen(at - reach), stage.screen(at + reach)) {
        let axes = [(DVec3::X, Axis::X), (DVec3::Y, Axis::Y), (DVec3::Z, Axis::Z)];
        let named = axes.into_iter().find(|(direction, _)| *direction == axis).map_or(Axis::Normal, |(_, named)| named);
        let stroke = Stroke::new(1.5, color_of(Part::Arrow(named)));
        painter.with_clip_rect(stage.transform.canvas).line_segment([from, to], stroke);
    }
}

/// Paints the circle within which control points follow a drag at `at`.
pub(crate) fn paint_radius(painter: &Painter, stage: &Stage<'_>, at: DVec3, radius: f64) {
    let Some(center) = stage.screen(at) else { return };
    let radius = (radius * stage.points_per_unit(at)) as f32;
    painter.circle_stroke(center, radius, Stroke::new(3.0, overlay::OUTLINE));
    painter.circle_stroke(center, radius, Stroke::new(1.2, overlay::HOVERED));
}
