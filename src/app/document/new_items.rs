//! New objects, lights, materials and textures, for "Add", "Duplicate" and "New scene".

use super::edit::Edit;
use super::handles::{Handle, translate_emitter, translate_shape};
use super::kinds::{MODEL_KINDS, emitter_like, model_like};
use super::names::free_name;
use super::placement::{fitted, free_place, size, way_to_copy};
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

/// Where a new sun shines from: high, and aside, so that shadows show.
const NEW_SUN: DVec3 = DVec3::new(0.4, 0.8, 0.3);

/// Makes a new shape or light, sized and placed for the scene's camera.
type Make<T> = fn(&Scene) -> T;

/// The shapes of the menu "Add to Objects", by their labels.
pub(crate) fn shapes() -> [(&'static str, Make<Shape>); 4] {
    [
        ("patch", |scene| Shape::Bezier(sheet(place(scene), size(scene)))),
        ("sphere", |scene| Shape::Sphere { center: place(scene), radius: 0.5 * size(scene) }),
        ("quad", |scene| {
            let size = size(scene);
            let corner = place(scene) - DVec3::new(size, 0.0, -size);
            Shape::Quad { corner, edge_u: 2.0 * size * DVec3::X, edge_v: -2.0 * size * DVec3::Z }
        }),
        ("plane", |scene| Shape::Plane { point: scene.camera.target, normal: DVec3::Y, u_axis: None }),
    ]
}

/// The lights of the menu "Add to Lights", by their labels.
pub(crate) fn emitters() -> [(&'static str, Make<Emitter>); 5] {
    [
        ("point light", |scene| emitter(scene, "point")),
        ("sphere light", |scene| emitter(scene, "sphere")),
        ("quad light", |scene| emitter(scene, "quad")),
        ("sun", |scene| emitter(scene, "sun")),
        ("beam", |scene| emitter(scene, "beam")),
    ]
}

/// The materials of the menu "Add to Materials", by their labels.
pub(crate) fn models() -> [(&'static str, MaterialModel); 5] {
    let grey = MaterialModel::Diffuse { albedo: Color::Constant(Rgb::splat(0.6)) };
    MODEL_KINDS.map(|kind| (kind, model_like(&grey, kind)))
}

/// A new object of the scene's first material, under a free name made from `name`.
pub(crate) fn object(scene: &Scene, name: &str, shape: Shape) -> Object {
    let material = scene.materials.first().map_or(String::new(), |material| material.name.clone());
    Object { name: object_name(scene, name), material, shape, body: None }
}

/// A new light under a free name made from `kind`.
pub(crate) fn light(scene: &Scene, kind: &str, emitter: Make<Emitter>) -> Light {
    Light { name: light_name(scene, kind), emitter: emitter(scene) }
}

/// A new material under a free name made from `kind`.
pub(crate) fn material(scene: &Scene, kind: &str, model: MaterialModel) -> Material {
    Material { name: material_name(scene, kind), model, relief: None }
}

/// A new sRGB texture of an image file, under a free name made from the file's name.
///
/// # Errors
/// Returns a message when the file is no PNG or JPEG image.
pub(crate) fn texture(scene: &Scene, path: &Path) -> Result<Texture, String> {
    let file = absolute(path);
    Location::Unsaved.check_picture(&file)?;
    let name = free_name(scene, Item::Texture(scene.textures.len()), &stem(path, "texture"));
    Ok(Texture { name, file, encoding: Encoding::Srgb })
}

/// A new object of the patches in a `.bpt` file, under a free name made from the file's name. Patches out of sight are
/// scaled and moved into the picture.
///
/// # Errors
/// Returns a message when the file cannot be read or parsed.
pub(crate) fn surface(scene: &Scene, path: &Path) -> Result<Object, String> {
    let file = absolute(path);
    let patches = Arc::new(Location::Unsaved.read_patches(&file)?);
    let bezier = Bezier { transform: fitted(scene, &patches), patches, file: Some(file) };
    Ok(object(scene, &stem(path, "patches"), Shape::Bezier(bezier)))
}

/// The file's name without its extension; `otherwise` where the path has no file name.
fn stem(path: &Path, otherwise: &str) -> String {
    path.file_stem().map_or_else(|| otherwise.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// The absolute path. Saving the scene makes a path below the scene's folder relative to that folder.
fn absolute(path: &Path) -> String {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned()).display().to_string()
}

/// The edit that adds a copy of an item under a free name, beside the item; `None` for textures, the camera and the settings.
pub(crate) fn duplicate(scene: &Scene, item: Item) -> Option<Edit> {
    Some(match item {
        Item::Object(index) => {
            let mut copy = scene.objects.get(index)?.clone();
            copy.name = object_name(scene, &copy.name);
            translate_shape(&mut copy.shape, way_to_copy_of(scene, Handle::Object(index)));
            Edit::AddObject(copy)
        }
        Item::Light(index) => {
            let mut copy = scene.lights.get(index)?.clone();
            copy.name = light_name(scene, &copy.name);
            translate_emitter(&mut copy.emitter, way_to_copy_of(scene, Handle::Light(index)));
            Edit::AddLight(copy)
        }
        Item::Material(index) => {
            let original = scene.materials.get(index)?;
            Edit::AddMaterial(Material { name: material_name(scene, &original.name), ..original.clone() })
        }
        Item::Camera | Item::Settings | Item::Texture(_) => return None,
    })
}

/// The way from an item to its copy. The copy of a plane must leave the plane, so it goes along the normal.
fn way_to_copy_of(scene: &Scene, original: Handle) -> DVec3 {
    let Some(from) = original.position(scene) else { return DVec3::ZERO };
    let way = way_to_copy(scene, from);
    match original {
        Handle::Object(index) => match &scene.objects[index].shape {
            Shape::Plane { normal, .. } => way.length() * normal.normalize_or_zero(),
            _ => way,
        },
        Handle::Light(_) | Handle::Point { .. } => way,
    }
}

/// Where a new object goes: where the camera looks, beside the objects that are there.
fn place(scene: &Scene) -> DVec3 {
    free_place(scene, scene.camera.target)
}

/// The scene of "New scene": a curved patch over a ground plane, lit by a point light.
pub(crate) fn empty_scene() -> Scene {
    let mut scene = Scene { name: "new scene".to_owned(), ..Scene::default() };
    scene.camera.position = DVec3::new(0.0, 1.2, 3.8);
    scene.materials = vec![material(&scene, "white", model_like(&models()[0].1, "diffuse"))];
    scene.lights = vec![Light {
        name: "lamp".to_owned(),
        emitter: Emitter::Point { position: DVec3::new(0.5, 1.8, 0.5), intensity: Rgb::splat(3.0) },
    }];
    let ground = Shape::Plane { point: DVec3::new(0.0, -0.6, 0.0), normal: DVec3::Y, u_axis: None };
    let named = |name: &str, shape| Object { name: name.to_owned(), material: "white".to_owned(), shape, body: None };
    scene.objects = vec![named("ground", ground), named("sheet", Shape::Bezier(sheet(DVec3::ZERO, 0.7)))];
    scene
}

/// A gently curved patch with sides of length `2 half`.
fn sheet(center: DVec3, half: f64) -> Bezier {
    let along = |k: usize| half * (2.0 * k as f64 / 3.0 - 1.0);
    let lift = |i: usize, j: usize| if (1..3).contains(&i) && (1..3).contains(&j) { 0.6 * half } else { 0.0 };
    let points = array::from_fn(|i| array::from_fn(|j| DVec3::new(along(j), lift(i, j), along(i))));
    let transform = Transform { translate: center, ..Transform::default() };
    Bezier { transform, patches: Arc::new(vec![ControlNet { points }]), file: None }
}

fn emitter(scene: &Scene, kind: &str) -> Emitter {
    if kind == "sun" {
        return emitter_like(&Emitter::Point { position: NEW_SUN, intensity: Rgb::ONE }, kind);
    }
    let position = free_place(scene, scene.camera.target + size(scene) * DVec3::Y);
    emitter_like(&Emitter::Point { position, intensity: Rgb::ONE }, kind)
}

fn object_name(scene: &Scene, wanted: &str) -> String {
    free_name(scene, Item::Object(scene.objects.len()), wanted)
}

fn light_name(scene: &Scene, wanted: &str) -> String {
    free_name(scene, Item::Light(scene.lights.len()), wanted)
}

fn material_name(scene: &Scene, wanted: &str) -> String {
    free_name(scene, Item::Material(scene.materials.len()), wanted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SceneFile;

    #[test]
    fn added_and_copied_items_lie_beside_the_others() {
        let mut scene = SceneFile::built_in("report").unwrap().scene;
        let mut places: Vec<DVec3> = Vec::new();
        for _ in 0..3 {
            for (label, shape) in shapes().into_iter().filter(|(label, _)| *label != "plane") {
                let new = object(&scene, label, shape(&scene));
                Edit::AddObject(new).apply(&mut scene);
                let copied = duplicate(&scene, Item::Object(scene.objects.len() - 1));
                copied.into_iter().for_each(|edit| edit.apply(&mut scene));
                places.extend([2, 1].map(|k| Handle::Object(scene.objects.len() - k).position(&scene).unwrap()));
            }
        }
        let near = |a: &DVec3| places.iter().filter(|b| a.distance(**b) < 0.2 * size(&scene)).count();
        // Nine places around the target fill up; the first objects have a place of their own.
        assert!(places[..6].iter().all(|place| near(place) == 1), "{places:?}");
    }

    #[test]
    fn a_copied_plane_is_another_plane() {
        let scene = empty_scene();
        let Some(Edit::AddObject(copy)) = duplicate(&scene, Item::Object(0)) else { panic!("a copy of the ground") };
        let Shape::Plane { point, normal, .. } = copy.shape else { panic!("a plane") };
        assert!((point.dot(normal) + 0.6).abs() > 0.01, "{point} lies off the ground at y = -0.6");
    }
}
