//! What "Add", "Duplicate" and another choice of "Type" begin with.

use super::edit::Edit;
use super::selection::Item;
use crate::geometry::bezier::ControlNet;
use crate::math::Rgb;
use crate::scene::{
    Bezier, Color, Emitter, Encoding, Light, Location, Material, MaterialModel, Object, Scene, Shape, Texture,
    Transform,
};
use glam::DVec3;
use std::array;
use std::path::Path;
use std::sync::Arc;

/// The kinds of materials, as the scene format calls them.
pub(crate) const MODEL_KINDS: [&str; 5] = ["diffuse", "phong", "polished", "mirror", "glass"];
/// The kinds of lights, as the scene format calls them.
pub(crate) const EMITTER_KINDS: [&str; 3] = ["point", "sphere", "quad"];

/// A shape to begin with, of about the size of what the camera sees round its target.
type Make<T> = fn(&Scene) -> T;

/// The shapes that can be added.
pub(crate) fn shapes() -> [(&'static str, Make<Shape>); 4] {
    [
        ("patch", |scene| Shape::Bezier(sheet(scene.camera.target, size(scene)))),
        ("sphere", |scene| Shape::Sphere { center: scene.camera.target, radius: 0.5 * size(scene) }),
        ("quad", |scene| {
            let size = size(scene);
            let corner = scene.camera.target - DVec3::new(size, 0.0, -size);
            Shape::Quad { corner, edge_u: 2.0 * size * DVec3::X, edge_v: -2.0 * size * DVec3::Z }
        }),
        ("plane", |scene| Shape::Plane { point: scene.camera.target, normal: DVec3::Y, u_axis: None }),
    ]
}

/// The lights that can be added.
pub(crate) fn emitters() -> [(&'static str, Make<Emitter>); 3] {
    [
        ("point light", |scene| emitter(scene, "point")),
        ("sphere light", |scene| emitter(scene, "sphere")),
        ("quad light", |scene| emitter(scene, "quad")),
    ]
}

/// The materials that can be added.
pub(crate) fn models() -> [(&'static str, MaterialModel); 5] {
    let grey = MaterialModel::Diffuse { albedo: Color::Constant(Rgb::splat(0.6)) };
    MODEL_KINDS.map(|kind| (kind, model_like(&grey, kind)))
}

/// A new object with a name of its own.
pub(crate) fn object(scene: &Scene, name: &str, shape: Shape) -> Object {
    let material = scene.materials.first().map_or(String::new(), |material| material.name.clone());
    Object { name: object_name(scene, name), material, shape }
}

/// A new light with a name of its own.
pub(crate) fn light(scene: &Scene, kind: &str, emitter: Make<Emitter>) -> Light {
    Light { name: light_name(scene, kind), emitter: emitter(scene) }
}

/// A new material with a name of its own.
pub(crate) fn material(scene: &Scene, kind: &str, model: MaterialModel) -> Material {
    Material { name: material_name(scene, kind), model, relief: None }
}

/// A new texture from an image file, with a name of its own.
pub(crate) fn texture(scene: &Scene, path: &Path) -> Texture {
    let name = free_name(&stem(path, "texture"), |name| scene.textures.iter().any(|texture| texture.name == name));
    Texture { name, file: absolute(path), encoding: Encoding::Srgb }
}

/// A new object of the patches in a `.bpt` file, where their coordinates say, with a name of its own; or why the file
/// cannot be read.
pub(crate) fn surface(scene: &Scene, path: &Path) -> Result<Object, String> {
    let file = absolute(path);
    let patches = Arc::new(Location::Unsaved.read_patches(&file)?);
    let bezier = Bezier { transform: Transform::default(), patches, file: Some(file) };
    Ok(object(scene, &stem(path, "patches"), Shape::Bezier(bezier)))
}

/// The file's name without its extension.
fn stem(path: &Path, otherwise: &str) -> String {
    path.file_stem().map_or_else(|| otherwise.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// Absolute until the scene is saved, which writes a path below its own folder relative to that.
fn absolute(path: &Path) -> String {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned()).display().to_string()
}

/// The edit that adds a copy of an item, moved a little so that it can be seen.
pub(crate) fn duplicate(scene: &Scene, item: Item) -> Option<Edit> {
    Some(match item {
        Item::Object(index) => {
            let original = scene.objects.get(index)?;
            Edit::AddObject(Object { name: object_name(scene, &original.name), ..original.clone() })
        }
        Item::Light(index) => {
            let original = scene.lights.get(index)?;
            Edit::AddLight(Light { name: light_name(scene, &original.name), ..original.clone() })
        }
        Item::Material(index) => {
            let original = scene.materials.get(index)?;
            Edit::AddMaterial(Material { name: material_name(scene, &original.name), ..original.clone() })
        }
        Item::Camera | Item::Settings | Item::Texture(_) => return None,
    })
}

/// A material of another kind that keeps the colours that both kinds have.
pub(crate) fn model_like(model: &MaterialModel, kind: &str) -> MaterialModel {
    let white = || Color::Constant(Rgb::splat(0.9));
    let (albedo, reflectance) = match model.clone() {
        MaterialModel::Diffuse { albedo } => (albedo, white()),
        MaterialModel::Phong { albedo, specular, .. } => (albedo, specular),
        MaterialModel::Polished { albedo, reflectance } => (albedo, reflectance),
        MaterialModel::Mirror { reflectance } => (Color::Constant(Rgb::splat(0.5)), reflectance),
        MaterialModel::Glass { .. } => (Color::Constant(Rgb::splat(0.5)), white()),
    };
    // Diffuse and mirrored light together may not be more than what came.
    let gloss = Color::Constant(Rgb::splat(0.1));
    let dimmed = |color| match color {
        Color::Constant(value) => Color::Constant(value.min(Rgb::splat(0.9))),
        textured @ Color::Texture(_) => textured,
    };
    match kind {
        "phong" => MaterialModel::Phong { albedo: dimmed(albedo), specular: gloss, exponent: 50.0 },
        "polished" => MaterialModel::Polished { albedo: dimmed(albedo), reflectance: gloss },
        "mirror" => MaterialModel::Mirror { reflectance },
        "glass" => MaterialModel::Glass { ior: 1.5, tint: Color::Constant(Rgb::ONE), absorption: Rgb::ZERO },
        _ => MaterialModel::Diffuse { albedo },
    }
}

/// A light of another kind in the same place, of about the same power.
pub(crate) fn emitter_like(emitter: &Emitter, kind: &str) -> Emitter {
    const PI: f32 = std::f32::consts::PI;
    // The intensity towards the brightest side; a small surface of area A and radiance L has A L.
    let (at, intensity) = match *emitter {
        Emitter::Point { position, intensity } => (position, intensity),
        Emitter::Sphere { center, radius, radiance } => (center, radiance * (PI * (radius * radius) as f32)),
        Emitter::Quad { corner, edge_u, edge_v, radiance } => {
            (corner + 0.5 * (edge_u + edge_v), radiance * edge_u.cross(edge_v).length() as f32)
        }
    };
    const RADIUS: f64 = 0.1;
    match kind {
        "sphere" => {
            Emitter::Sphere { center: at, radius: RADIUS, radiance: intensity / (PI * (RADIUS * RADIUS) as f32) }
        }
        "quad" => Emitter::Quad {
            corner: at - RADIUS * DVec3::new(1.0, 0.0, 1.0),
            edge_u: 2.0 * RADIUS * DVec3::X,
            edge_v: 2.0 * RADIUS * DVec3::Z,
            radiance: intensity / (4.0 * RADIUS * RADIUS) as f32,
        },
        _ => Emitter::Point { position: at, intensity },
    }
}

/// An empty scene has something to see and something to see it by.
pub(crate) fn empty_scene() -> Scene {
    let mut scene = Scene { name: "new scene".to_owned(), ..Scene::default() };
    scene.camera.position = DVec3::new(0.0, 1.2, 3.8);
    scene.materials = vec![material(&scene, "white", model_like(&models()[0].1, "diffuse"))];
    scene.lights = vec![Light {
        name: "lamp".to_owned(),
        emitter: Emitter::Point { position: DVec3::new(0.5, 1.8, 0.5), intensity: Rgb::splat(3.0) },
    }];
    let ground = Shape::Plane { point: DVec3::new(0.0, -0.6, 0.0), normal: DVec3::Y, u_axis: None };
    let named = |name: &str, shape| Object { name: name.to_owned(), material: "white".to_owned(), shape };
    scene.objects = vec![named("ground", ground), named("sheet", Shape::Bezier(sheet(DVec3::ZERO, 0.7)))];
    scene
}

/// A gently curved patch.
fn sheet(center: DVec3, half: f64) -> Bezier {
    let along = |k: usize| half * (2.0 * k as f64 / 3.0 - 1.0);
    let lift = |i: usize, j: usize| if (1..3).contains(&i) && (1..3).contains(&j) { 0.6 * half } else { 0.0 };
    let points = array::from_fn(|i| array::from_fn(|j| DVec3::new(along(j), lift(i, j), along(i))));
    let transform = Transform { translate: center, ..Transform::default() };
    Bezier { transform, patches: Arc::new(vec![ControlNet { points }]), file: None }
}

fn emitter(scene: &Scene, kind: &str) -> Emitter {
    let position = scene.camera.target + size(scene) * DVec3::Y;
    emitter_like(&Emitter::Point { position, intensity: Rgb::ONE }, kind)
}

/// About a fifth of the picture's height at the target, scene units.
fn size(scene: &Scene) -> f64 {
    let camera = &scene.camera;
    0.4 * camera.position.distance(camera.target) * (0.5 * camera.fov_y.to_radians()).tan()
}

fn object_name(scene: &Scene, wanted: &str) -> String {
    free_name(wanted, |name| scene.objects.iter().any(|object| object.name == name))
}

fn light_name(scene: &Scene, wanted: &str) -> String {
    free_name(wanted, |name| scene.lights.iter().any(|light| light.name == name))
}

fn material_name(scene: &Scene, wanted: &str) -> String {
    free_name(wanted, |name| scene.materials.iter().any(|material| material.name == name))
}

/// `wanted`, or with the first number behind it that makes it new.
fn free_name(wanted: &str, taken: impl Fn(&str) -> bool) -> String {
    if !taken(wanted) {
        return wanted.to_owned();
    }
    let stem = wanted.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end();
    (2_u64..).map(|number| format!("{stem} {number}")).find(|name| !taken(name)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_name_is_free() {
        let taken = ["ball", "ball 2", "lamp"];
        let free = |wanted| free_name(wanted, |name| taken.contains(&name));
        assert_eq!([free("cube"), free("ball"), free("ball 2"), free("lamp")], ["cube", "ball 3", "ball 3", "lamp 2"]);
    }

    #[test]
    fn another_kind_of_light_has_the_same_intensity() {
        let point = Emitter::Point { position: DVec3::ONE, intensity: Rgb::new(1.0, 2.0, 3.0) };
        for kind in EMITTER_KINDS {
            let Emitter::Point { position, intensity } = emitter_like(&emitter_like(&point, kind), "point") else {
                panic!("a point light was asked for")
            };
            // f32 radiance and back: a few roundings of 6e-8.
            assert!((intensity - Rgb::new(1.0, 2.0, 3.0)).length() < 1e-5, "{intensity} through {kind}");
            assert!(position.distance(DVec3::ONE) < 1e-12, "{position} through {kind}");
        }
    }

    #[test]
    fn another_kind_of_material_keeps_its_colour() {
        let red = Color::Constant(Rgb::new(0.8, 0.1, 0.1));
        let model = model_like(&MaterialModel::Diffuse { albedo: red.clone() }, "phong");
        assert!(matches!(model, MaterialModel::Phong { albedo, .. } if albedo == red), "red stays red");
    }
}
