//! Icons of the kinds of items: a few strokes each, which stay sharp at any scale.

use crate::app::theme::overlay;
use crate::scene::{Color, Emitter, MaterialModel, Shape};
use egui::{Color32, Painter, Pos2, Rect, Shape as Drawing, Stroke};
use std::f32::consts::TAU;

/// The width and height of an icon, screen points.
pub(super) const SIZE: f32 = 14.0;

/// The icon of an item.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Icon {
    Camera,
    Settings,
    Patch,
    Vase,
    Ball,
    Parallelogram,
    Plane,
    Lamp,
    Rays,
    Texture,
    /// A material of one colour, or of a texture where the colour is unknown.
    Swatch(Option<Color32>),
    /// A mirror of one reflectance, or of a texture where the reflectance is unknown.
    Mirror(Option<Color32>),
    Glass,
}

impl Icon {
    pub(super) fn of_shape(shape: &Shape) -> Self {
        match shape {
            Shape::Quad { .. } => Self::Parallelogram,
            Shape::Sphere { .. } => Self::Ball,
            Shape::Plane { .. } => Self::Plane,
            Shape::Bezier(_) => Self::Patch,
            Shape::Revolution(_) => Self::Vase,
        }
    }

    pub(super) fn of_emitter(emitter: &Emitter) -> Self {
        match emitter {
            Emitter::Point { .. } | Emitter::Sphere { .. } | Emitter::Quad { .. } => Self::Lamp,
            Emitter::Sun { .. } | Emitter::Beam { .. } => Self::Rays,
        }
    }

    pub(super) fn of_model(model: &MaterialModel) -> Self {
        match model {
            MaterialModel::Mirror { reflectance } => Self::Mirror(swatch(reflectance)),
            MaterialModel::Glass { .. } => Self::Glass,
            MaterialModel::Diffuse { albedo }
            | MaterialModel::Phong { albedo, .. }
            | MaterialModel::Polished { albedo, .. } => Self::Swatch(swatch(albedo)),
        }
    }

    /// Paints the icon in a square.
    pub(super) fn paint(self, painter: &Painter, square: Rect, color: Color32) {
        let at = |x: f32, y: f32| square.lerp_inside(egui::vec2(x, y));
        let stroke = Stroke::new(1.2, color);
        let (center, radius) = (square.center(), 0.4 * square.width());
        let ring = Drawing::circle_stroke(center, radius, stroke);
        let line = |points: &[(f32, f32)]| Drawing::line(points.iter().map(|(x, y)| at(*x, *y)).collect(), stroke);
        let closed =
            |points: &[(f32, f32)]| Drawing::closed_line(points.iter().map(|(x, y)| at(*x, *y)).collect(), stroke);
        painter.add(match self {
            Self::Ball => ring,
            Self::Parallelogram => closed(&[(0.3, 0.2), (0.95, 0.2), (0.7, 0.8), (0.05, 0.8)]),
            Self::Plane => Drawing::Vec(vec![line(&[(0.0, 0.65), (1.0, 0.65)]), line(&[(0.5, 0.65), (0.5, 0.15)])]),
            Self::Patch => Drawing::Vec(patch().iter().map(|curve| line(curve)).collect()),
            Self::Vase => Drawing::Vec(vec![
                line(&[(0.3, 0.95), (0.12, 0.65), (0.38, 0.3), (0.28, 0.05)]),
                line(&[(0.7, 0.95), (0.88, 0.65), (0.62, 0.3), (0.72, 0.05)]),
                line(&[(0.28, 0.05), (0.72, 0.05)]),
                line(&[(0.3, 0.95), (0.7, 0.95)]),
            ]),
            Self::Lamp => lamp(center, 0.5 * radius, color),
            Self::Rays => Drawing::Vec(
                [0.2, 0.5, 0.8]
                    .map(|x| line(&[(x, 0.1), (x, 0.9), (x - 0.12, 0.68), (x, 0.9), (x + 0.12, 0.68)]))
                    .into(),
            ),
            Self::Camera => Drawing::Vec(vec![
                closed(&[(0.05, 0.25), (0.65, 0.25), (0.65, 0.75), (0.05, 0.75)]),
                closed(&[(0.65, 0.5), (0.95, 0.3), (0.95, 0.7)]),
            ]),
            Self::Settings => Drawing::Vec(
                [(0.2, 0.3), (0.5, 0.7), (0.8, 0.45)]
                    .into_iter()
                    .flat_map(|(y, x)| [line(&[(0.05, y), (0.95, y)]), Drawing::circle_filled(at(x, y), 2.0, color)])
                    .collect(),
            ),
            Self::Texture => checker(square.shrink(1.0), color),
            Self::Swatch(Some(fill)) => Drawing::Vec(vec![Drawing::circle_filled(center, radius, fill), ring]),
            Self::Swatch(None) => Drawing::Vec(vec![
                checker(Rect::from_center_size(center, egui::Vec2::splat(1.2 * radius)), color),
                ring,
            ]),
            Self::Mirror(fill) => {
                let disc = Drawing::circle_filled(center, radius, fill.unwrap_or(Color32::TRANSPARENT));
                // Strokes on a bright disc are dark.
                let glint = Stroke::new(1.2, fill.map_or(color, |_| overlay::OUTLINE));
                let glint =
                    |points: &[(f32, f32)]| Drawing::line(points.iter().map(|(x, y)| at(*x, *y)).collect(), glint);
                Drawing::Vec(vec![disc, ring, glint(&[(0.35, 0.65), (0.65, 0.35)]), glint(&[(0.5, 0.72), (0.72, 0.5)])])
            }
            Self::Glass => Drawing::Vec(vec![ring, Drawing::circle_stroke(center, 0.5 * radius, stroke)]),
        });
    }
}

/// The displayed colour of a constant reflectance; `None` for a texture.
fn swatch(color: &Color) -> Option<Color32> {
    let Color::Constant(value) = color else { return None };
    Some(egui::Rgba::from_rgb(value.x, value.y, value.z).into())
}

/// The curves of a bent patch, in the unit square.
fn patch() -> [Vec<(f32, f32)>; 4] {
    let wave = |x: f32| 0.14 * (TAU * x).sin();
    let along = |base: f32| (0..=8).map(|k| k as f32 / 8.0).map(|x| (x, base - wave(x))).collect();
    let across = |x: f32| vec![(x, 0.25), (x, 0.75)];
    [along(0.25), along(0.75), across(0.0), across(1.0)]
}

/// A disc with rays.
fn lamp(center: Pos2, radius: f32, color: Color32) -> Drawing {
    const RAYS: u8 = 8;
    let ray = |k| {
        let direction = egui::Vec2::angled(TAU * f32::from(k) / f32::from(RAYS));
        let ends = [center + (radius + 1.5) * direction, center + (radius + 3.5) * direction];
        Drawing::line_segment(ends, Stroke::new(1.2, color))
    };
    Drawing::Vec((0..RAYS).map(ray).chain([Drawing::circle_filled(center, radius, color)]).collect())
}

/// A checkerboard of 3 x 3 squares.
fn checker(square: Rect, color: Color32) -> Drawing {
    let side = square.width() / 3.0;
    let dark = |k: u8| {
        let corner = square.min + side * egui::vec2(f32::from(k % 3), f32::from(k / 3));
        Drawing::rect_filled(Rect::from_min_size(corner, egui::Vec2::splat(side)), 0.0, color)
    };
    Drawing::Vec((0..9).step_by(2).map(dark).collect())
}
