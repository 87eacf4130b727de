//! The gizmo on the selection: arrows along the axes and the surface normal, squares in the planes of the axes. Knows no widget.

use super::drag::Constraint;
use super::stage::Stage;
use egui::{Pos2, Vec2};
use glam::DVec3;

/// Length of an arrow across the view direction, screen points.
const LENGTH: f64 = 64.0;
/// Length of the arrow along the normal over the length of the other arrows: it stays visible beside an axis.
const NORMAL_LENGTH: f64 = 1.3;
/// Distance of an arrow from the gizmo's centre as a fraction of its length: the centre belongs to the handle.
const GAP: f64 = 0.2;
/// Nearer and farther edge of a square along each of its axes, as fractions of an arrow's length.
const SQUARE: [f64; 2] = [0.3, 0.5];
/// Distance from an arrow that takes the pointer, screen points.
const REACH: f32 = 6.0;
/// Fractions of the full length or width on the screen below which a part is invisible, and above which it is opaque.
const FADE: [f32; 2] = [0.12, 0.3];

/// An axis of the gizmo.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Axis {
    X,
    Y,
    Z,
    Normal,
}

/// A part of the gizmo that the user can drag.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Part {
    /// Moves along the axis.
    Arrow(Axis),
    /// Moves in the plane across the axis.
    Square(Axis),
}

impl Part {
    /// The part's name, for its tooltip and for assistive technology.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Arrow(Axis::X) => "Move along x",
            Self::Arrow(Axis::Y) => "Move along y",
            Self::Arrow(Axis::Z) => "Move along z",
            Self::Arrow(Axis::Normal) | Self::Square(Axis::Normal) => "Move along the surface normal",
            Self::Square(Axis::X) => "Move in y and z",
            Self::Square(Axis::Y) => "Move in x and z",
            Self::Square(Axis::Z) => "Move in x and y",
        }
    }
}

/// A part of the gizmo on the screen.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ScreenPart {
    pub(crate) part: Part,
    /// The arrow's direction, or the normal of the square's plane: a unit vector.
    direction: DVec3,
    /// Start and tip of an arrow, or the corners of a square, screen points.
    pub(crate) outline: Vec<Pos2>,
    /// From 0 to 1: a part that the camera sees end-on or edge-on fades out.
    pub(crate) opacity: f32,
}

impl ScreenPart {
    /// The constraint of a drag of the part.
    pub(crate) fn constraint(&self) -> Constraint {
        match self.part {
            Part::Arrow(_) => Constraint::Axis(self.direction),
            Part::Square(_) => Constraint::Plane(self.direction),
        }
    }

    /// Where the part is best grabbed, screen points: near the tip of an arrow, in the middle of a square.
    pub(crate) fn grip(&self) -> Pos2 {
        let weight = |k: usize| match self.part {
            Part::Arrow(_) => [0.2, 0.8][k.min(1)],
            Part::Square(_) => 0.25,
        };
        let sum = self.outline.iter().enumerate().fold(Vec2::ZERO, |sum, (k, at)| sum + weight(k) * at.to_vec2());
        sum.to_pos2()
    }

    /// Distance of a screen point to the part, screen points.
    fn distance(&self, at: Pos2) -> f32 {
        match (&self.part, self.outline.as_slice()) {
            (Part::Arrow(_), [from, tip]) => distance_to_segment(at, *from, *tip),
            (Part::Square(_), corners) if contains(corners, at) => 0.0,
            _ => f32::INFINITY,
        }
    }
}

/// The gizmo's parts on the screen.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Gizmo {
    pub(crate) parts: Vec<ScreenPart>,
}

impl Gizmo {
    /// The gizmo of a selection at `center`, with an arrow along `normal` if there is one; `None` off the canvas.
    pub(crate) fn new(stage: &Stage<'_>, center: DVec3, normal: Option<DVec3>) -> Option<Self> {
        let middle = stage.screen(center).filter(|middle| stage.transform.canvas.contains(*middle))?;
        let length = LENGTH / stage.points_per_unit(center);
        let axes = [(Axis::X, DVec3::X), (Axis::Y, DVec3::Y), (Axis::Z, DVec3::Z)];
        let squares = [(Axis::X, 1, 2), (Axis::Y, 2, 0), (Axis::Z, 0, 1)];
        let mut parts = Vec::new();
        for (axis, a, b) in squares {
            let edges = [length * axes[a].1, length * axes[b].1];
            parts.extend(square(stage, axis, center, edges));
        }
        for (axis, direction) in axes {
            parts.extend(arrow(stage, axis, (center, middle), (direction, length)));
        }
        if let Some(normal) = normal {
            parts.extend(arrow(stage, Axis::Normal, (center, middle), (normal, NORMAL_LENGTH * length)));
        }
        Some(Self { parts })
    }

    /// The part under a screen point: an arrow in reach, or else the square that contains the point.
    pub(crate) fn part_at(&self, at: Pos2) -> Option<&ScreenPart> {
        let nearest = |arrow: bool| {
            let of_kind = self.parts.iter().filter(move |part| matches!(part.part, Part::Arrow(_)) == arrow);
            let reached = of_kind.filter(|part| part.distance(at) <= REACH);
            reached.min_by(|a, b| a.distance(at).total_cmp(&b.distance(at)))
        };
        nearest(true).or_else(|| nearest(false))
    }

    /// The part of this name; `None` while it has faded out.
    pub(crate) fn part(&self, part: Part) -> Option<&ScreenPart> {
        self.parts.iter().find(|candidate| candidate.part == part)
    }
}

fn arrow(
    stage: &Stage<'_>,
    axis: Axis,
    (center, middle): (DVec3, Pos2),
    (direction, length): (DVec3, f64),
) -> Option<ScreenPart> {
    let from = stage.screen(center + GAP * length * direction)?;
    let tip = stage.screen(center + length * direction)?;
    let shown = middle.distance(tip) / LENGTH as f32;
    let outline = vec![from, tip];
    faded(shown).map(|opacity| ScreenPart { part: Part::Arrow(axis), direction, outline, opacity })
}

fn square(stage: &Stage<'_>, axis: Axis, center: DVec3, [a, b]: [DVec3; 2]) -> Option<ScreenPart> {
    let [near, far] = SQUARE;
    let corner = |along_a: f64, along_b: f64| stage.screen(center + along_a * a + along_b * b);
    let corners = [corner(near, near), corner(far, near), corner(far, far), corner(near, far)];
    let outline: Vec<Pos2> = corners.into_iter().collect::<Option<_>>()?;
    let direction = a.cross(b).normalize_or_zero();
    let shown = stage.projection.sight(center).direction.normalize_or_zero().dot(direction).abs();
    faded(shown as f32).map(|opacity| ScreenPart { part: Part::Square(axis), direction, outline, opacity })
}

/// The opacity of a part whose size on the screen is the fraction `shown` of its full size; `None` for an invisible part.
fn faded(shown: f32) -> Option<f32> {
    let [from, to] = FADE;
    let opacity = ((shown - from) / (to - from)).min(1.0);
    (opacity > 0.0).then_some(opacity)
}

fn distance_to_segment(at: Pos2, from: Pos2, to: Pos2) -> f32 {
    let way = to - from;
    let along = ((at - from).dot(way) / way.length_sq().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    at.distance(from + along * way)
}

/// Whether a convex polygon contains a point.
fn contains(corners: &[Pos2], at: Pos2) -> bool {
    let side = |k: usize| {
        let (from, to) = (corners[k], corners[(k + 1) % corners.len()]);
        (to - from).rot90().dot(at - from)
    };
    (0..corners.len()).all(|k| side(k) >= 0.0) || (0..corners.len()).all(|k| side(k) <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::super::projection::Projection;
    use super::super::sight::Sight;
    use super::super::view::View;
    use super::*;
    use crate::app::document::Document;
    use crate::scene::{Camera, Location, Scene, SceneFile};
    use egui::{Rect, pos2, vec2};

    /// The gizmo at the origin, which projects to (256, 256) on a canvas of one screen point a film pixel.
    fn gizmo(camera: DVec3, normal: Option<DVec3>) -> Gizmo {
        let camera = Camera { position: camera, target: DVec3::ZERO, ..Camera::default() };
        let mut scene = Scene { camera, ..Scene::default() };
        (scene.film.width, scene.film.height) = (512, 512);
        let projection = Projection::new(&scene.camera, &scene.film).unwrap();
        let document = Document::new(SceneFile { scene, location: Location::Unsaved });
        let canvas = Rect::from_min_size(Pos2::ZERO, vec2(512.0, 512.0));
        let view = View::Free { scale: 1.0, center: vec2(256.0, 256.0) };
        let transform = view.transform(canvas, vec2(512.0, 512.0));
        let stage = Stage { document: &document, transform, projection, sight: &Sight::default(), shows_handles: true };
        Gizmo::new(&stage, DVec3::ZERO, normal).unwrap()
    }

    #[test]
    fn arrows_have_a_constant_length_and_an_arrow_at_the_camera_fades_out() {
        for distance in [0.01, 5.0, 1e6] {
            let gizmo = gizmo(distance * DVec3::Z, Some(DVec3::X));
            let tip = |part| gizmo.part(part).unwrap().outline[1];
            assert!(tip(Part::Arrow(Axis::X)).distance(pos2(320.0, 256.0)) < 0.01, "64 points to the right");
            assert!(tip(Part::Arrow(Axis::Y)).distance(pos2(256.0, 192.0)) < 0.01, "64 points up");
            assert!(tip(Part::Arrow(Axis::Normal)).distance(pos2(339.2, 256.0)) < 0.01, "longer than the axis");
            assert_eq!(gizmo.part(Part::Arrow(Axis::Z)), None, "points at the camera");
            assert_eq!(gizmo.part(Part::Square(Axis::X)), None, "is seen edge-on");
            assert!(gizmo.part(Part::Square(Axis::Z)).is_some(), "faces the camera");
        }
    }

    #[test]
    fn a_point_on_a_part_finds_it() {
        let gizmo = gizmo(5.0 * DVec3::Z, None);
        let found = |x, y| gizmo.part_at(pos2(x, y)).map(|part| part.part);
        assert_eq!(found(300.0, 260.0), Some(Part::Arrow(Axis::X)));
        assert_eq!(found(252.0, 215.0), Some(Part::Arrow(Axis::Y)));
        assert_eq!(found(282.0, 230.0), Some(Part::Square(Axis::Z)));
        assert_eq!(found(256.0, 256.0), None, "the centre belongs to the handle");
        assert_eq!(found(300.0, 300.0), None);
    }

    #[test]
    fn every_part_is_found_at_its_grip() {
        let gizmo = gizmo(DVec3::new(3.0, 2.0, 4.0), None);
        assert_eq!(gizmo.parts.len(), 6, "three arrows and three squares");
        for part in &gizmo.parts {
            assert_eq!(gizmo.part_at(part.grip()).map(|found| found.part), Some(part.part));
        }
    }
}
