use super::{Bezier, Camera, Color, Emitter, Light, Material, MaterialModel, Object, Render, Scene, Shape, Transform};
use crate::geometry::bezier::ControlNet;
use crate::math::{Aabb, Rgb};
use glam::DVec3;
use std::sync::Arc;

/// Distance of the camera over the radius of the patches: they fill most of the film.
const CAMERA_DISTANCE: f64 = 3.2;
/// Distance of the lamp over the radius of the patches.
const LAMP_DISTANCE: f64 = 4.0;
/// Distance of the ground below the patches over their radius: patches that stand on it do not coincide with it.
const ABOVE_GROUND: f64 = 1e-3;

/// The scene that shows the patches of a `.bpt` file: on a ground, under a lamp, seen from aside and above.
pub(super) fn scene_of_patches(name: &str, nets: Vec<ControlNet>, file: String) -> Scene {
    let bounds = Aabb::around(nets.iter().flat_map(|net| net.points.iter().flatten().copied()));
    let (center, radius) = if bounds.is_empty() {
        (DVec3::ZERO, 1.0)
    } else {
        (bounds.center(), (0.5 * bounds.diagonal()).max(f64::MIN_POSITIVE))
    };
    let diffuse = |name: &str, albedo: f32| Material {
        name: name.to_owned(),
        model: MaterialModel::Diffuse { albedo: Color::Constant(Rgb::splat(albedo)) },
        relief: None,
    };
    let object = |name: &str, shape| Object { name: name.to_owned(), material: name.to_owned(), shape, body: None };
    let below = bounds.min.y - ABOVE_GROUND * radius;
    let ground = Shape::Plane { point: DVec3::new(center.x, below, center.z), normal: DVec3::Y, u_axis: None };
    let surface =
        Shape::Bezier(Bezier { transform: Transform::default(), patches: Arc::new(nets), file: Some(file), uv: None });
    let lamp = LAMP_DISTANCE * radius;
    Scene {
        name: name.to_owned(),
        camera: Camera {
            position: center + CAMERA_DISTANCE * radius * DVec3::new(0.35, 0.4, 0.85).normalize(),
            target: center,
            ..Camera::default()
        },
        render: Render { background: Rgb::splat(0.1), ..Render::default() },
        materials: vec![diffuse("surface", 0.7), diffuse("ground", 0.4)],
        lights: vec![Light {
            name: "lamp".to_owned(),
            emitter: Emitter::Point {
                position: center + lamp * DVec3::new(-0.4, 0.8, 0.5).normalize(),
                // The light of a white surface across it, at the distance of the patches.
                intensity: Rgb::splat((std::f64::consts::PI * lamp * lamp) as f32),
            },
        }],
        objects: if bounds.is_empty() {
            Vec::new()
        } else {
            vec![object("ground", ground), object("surface", surface)]
        },
        ..Scene::default()
    }
}
