//! Painting of curves in the room.

use crate::app::canvas::stage::Stage;
use crate::app::theme::overlay;
use crate::transport::{LightPaths, Polyline};
use egui::{Color32, Painter, Pos2, Shape, Stroke};

/// The look of a kind of curves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    pub(super) color: Color32,
    /// Screen points.
    pub(super) width: f32,
    /// How much wider the outline is; 0 for no outline.
    outline: f32,
}

/// The ways of light in the room.
pub(super) const WAYS: Look = Look { color: overlay::LIGHT_WAY, width: 1.0, outline: 0.0 };
/// The images of lines of equal u and of equal v.
pub(super) const LINES: [Look; 2] = [
    Look { color: overlay::LIGHT_IMAGE[0], width: 1.2, outline: 1.8 },
    Look { color: overlay::LIGHT_IMAGE[1], width: 1.2, outline: 1.8 },
];
/// The edges of the caustic.
pub(super) const EDGES: Look = Look { color: overlay::CAUSTIC_EDGE, width: 2.4, outline: 2.4 };
/// The strength of curves that an opaque surface hides.
const HIDDEN: f32 = 0.3;

/// Paints the light paths, from the faintest to the most important.
pub(super) fn paint(painter: &Painter, stage: &Stage<'_>, paths: &LightPaths) {
    paint_curves(painter, stage, &paths.ways, WAYS);
    for (lines, look) in paths.lines.iter().zip(LINES) {
        paint_curves(painter, stage, lines, look);
    }
    paint_curves(painter, stage, &paths.edges, EDGES);
}

/// Paints all outlines before all curves, so that no outline cuts another curve of its kind.
fn paint_curves(painter: &Painter, stage: &Stage<'_>, curves: &[Polyline], look: Look) {
    let runs: Vec<Run> = curves.iter().flat_map(|curve| runs(stage, curve)).collect();
    if look.outline > 0.0 {
        let stroke = Stroke::new(look.width + look.outline, overlay::OUTLINE);
        let outline = |run: &Run| Shape::line(run.points.clone(), stroke);
        painter.extend(runs.iter().filter(|run| run.seen).map(outline));
    }
    painter.extend(runs.into_iter().map(|run| {
        let color = if run.seen { look.color } else { look.color.gamma_multiply(HIDDEN) };
        Shape::line(run.points, Stroke::new(look.width, color))
    }));
}

/// A part of a curve on the screen that is seen or hidden as a whole.
#[derive(Debug, PartialEq)]
struct Run {
    points: Vec<Pos2>,
    seen: bool,
}

/// The parts of a curve in front of the near plane. A segment with a hidden end counts as hidden.
fn runs(stage: &Stage<'_>, curve: &Polyline) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    // Whether the last segment ended at a point in front of the near plane, which the next segment may continue.
    let mut goes_on = false;
    for (ends, seen) in curve.points.windows(2).zip(curve.seen.windows(2)) {
        let Some(clipped) = stage.projection.clipped([ends[0], ends[1]]) else {
            goes_on = false;
            continue;
        };
        let (Some(from), Some(to)) = (stage.screen(clipped[0]), stage.screen(clipped[1])) else {
            goes_on = false;
            continue;
        };
        let seen = seen[0] && seen[1];
        match runs.last_mut().filter(|run| goes_on && run.seen == seen) {
            Some(run) => run.points.push(to),
            None => runs.push(Run { points: vec![from, to], seen }),
        }
        goes_on = clipped[1] == ends[1];
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::canvas::projection::Projection;
    use crate::app::canvas::sight::Sight;
    use crate::app::canvas::view::View;
    use crate::app::document::Document;
    use crate::scene::SceneFile;
    use egui::{Rect, Vec2};
    use glam::DVec3;

    #[test]
    fn curves_end_at_the_near_plane_and_where_they_are_hidden() {
        let file = SceneFile::built_in("report").unwrap();
        let (camera, film) = (file.scene.camera, file.scene.film);
        let projection = Projection::new(&camera, &film).unwrap();
        let size = Vec2::new(film.width as f32, film.height as f32);
        let transform = View::Fit.transform(Rect::from_min_size(Pos2::ZERO, size), size);
        let document = Document::new(file);
        let stage = Stage { document: &document, transform, projection, sight: &Sight::default(), shows_handles: true };
        let at = |x: f64, z: f64| DVec3::new(x, 0.0, z);
        // The camera is at z = 5.5 and looks along -z.
        let points = vec![at(0.0, 0.0), at(0.1, 0.0), at(0.2, 0.0), at(0.3, 9.0), at(0.4, 0.0)];
        let curve = Polyline { points, seen: vec![true, true, false, true, true] };
        let found = runs(&stage, &curve);
        let seen: Vec<_> = found.iter().map(|run| (run.seen, run.points.len())).collect();
        assert_eq!(seen, [(true, 2), (false, 3), (true, 2)], "{found:?}");
        assert!(found.iter().flat_map(|run| &run.points).all(|point| point.x.abs().max(point.y.abs()) < 1e6));
    }
}
