//! Edits as a user makes them: one small change of a scene.

use glam::{DMat3, DVec3};
use patchlight::scene::{Color, Emitter, Light, Material, MaterialModel, Scene, SceneFile, Shape};
use std::sync::Arc;

/// Lift of a control point, over the size of its patch.
const LIFT: f64 = 0.1;
/// Shift of a light, over its distance from what the camera looks at.
const SHIFT: f64 = 0.05;
/// Factor of a material's colour.
const DARKER: f32 = 0.6;
/// Turn of the camera or of a parallel light, degrees.
const TURN: f64 = 3.0;

/// What an edit changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Edit {
    /// An inner control point of the first patch.
    Point,
    /// The first light's place or direction.
    Light,
    /// The colour of the first object's material.
    Material,
    /// The camera, which turns about its target.
    Camera,
}

impl Edit {
    pub(crate) const ALL: [Self; 4] = [Self::Point, Self::Light, Self::Material, Self::Camera];

    /// The name in a table.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Light => "light",
            Self::Material => "material",
            Self::Camera => "camera",
        }
    }

    /// The scene after a fraction of the edit; `None` where the scene has nothing to edit.
    pub(crate) fn applied(self, file: &SceneFile, fraction: f64) -> Option<Arc<SceneFile>> {
        let mut file = file.clone();
        match self {
            Self::Point => lift(&mut file.scene, fraction)?,
            Self::Light => shift(&mut file.scene, fraction)?,
            Self::Material => darken(&mut file.scene, fraction as f32)?,
            Self::Camera => orbit(&mut file.scene, fraction),
        }
        Some(Arc::new(file))
    }
}

fn lift(scene: &mut Scene, fraction: f64) -> Option<()> {
    let bezier = scene.objects.iter_mut().find_map(|object| match &mut object.shape {
        Shape::Bezier(bezier) => Some(bezier),
        _ => None,
    })?;
    let mut patches = bezier.patches.as_ref().clone();
    let points = &mut patches[0].points;
    let diagonals = [points[3][3] - points[0][0], points[3][0] - points[0][3]];
    let size = diagonals[0].length().max(diagonals[1].length());
    points[1][1] += fraction * LIFT * size * diagonals[0].cross(diagonals[1]).normalize_or(DVec3::Y);
    (bezier.patches, bezier.file) = (Arc::new(patches), None);
    Some(())
}

fn shift(scene: &mut Scene, fraction: f64) -> Option<()> {
    let target = scene.camera.target;
    let Light { emitter, .. } = scene.lights.first_mut()?;
    let by = |place: DVec3| fraction * SHIFT * place.distance(target) * DVec3::X;
    let turned = |direction: DVec3| DMat3::from_rotation_z((fraction * TURN).to_radians()) * direction;
    match emitter {
        Emitter::Point { position, .. } => *position += by(*position),
        Emitter::Sphere { center, .. } => *center += by(*center),
        Emitter::Quad { corner, .. } => *corner += by(*corner),
        Emitter::Sun { direction, .. } | Emitter::Beam { direction, .. } => *direction = turned(*direction),
    }
    Some(())
}

/// Darkens the first constant colour of an object.
fn darken(scene: &mut Scene, fraction: f32) -> Option<()> {
    let used: Vec<&str> = scene.objects.iter().map(|object| object.material.as_str()).collect();
    let color =
        scene.materials.iter_mut().filter(|material| used.contains(&material.name.as_str())).find_map(constant)?;
    *color *= 1.0 + fraction * (DARKER - 1.0);
    Some(())
}

fn constant(material: &mut Material) -> Option<&mut patchlight::math::Rgb> {
    match &mut material.model {
        MaterialModel::Diffuse { albedo: Color::Constant(color) }
        | MaterialModel::Phong { albedo: Color::Constant(color), .. }
        | MaterialModel::Polished { albedo: Color::Constant(color), .. } => Some(color),
        _ => None,
    }
}

fn orbit(scene: &mut Scene, fraction: f64) {
    let camera = &mut scene.camera;
    let turn = DMat3::from_axis_angle(camera.up.normalize(), (fraction * TURN).to_radians());
    camera.position = camera.target + turn * (camera.position - camera.target);
}
