//! Whether two scenes have the same picture.

use crate::app::document::texture_names;
use crate::scene::{Scene, SceneFile};
use std::collections::HashMap;

/// Whether two scenes have the same radiance in every pixel. Names and the display settings do not matter.
pub(super) fn same_picture(a: &SceneFile, b: &SceneFile) -> bool {
    a.location == b.location && essence(&a.scene) == essence(&b.scene)
}

/// The scene without its display settings, and with numbers in place of names.
fn essence(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.name.clear();
    (scene.film.exposure, scene.film.tone_curve) = Default::default();
    let textures = number(scene.textures.iter_mut().map(|texture| &mut texture.name));
    let materials = number(scene.materials.iter_mut().map(|material| &mut material.name));
    let mut bodies = HashMap::new();
    scene.lights.iter_mut().for_each(|light| light.name.clear());
    for texture in scene.materials.iter_mut().flat_map(texture_names) {
        replace(texture, &textures);
    }
    for object in &mut scene.objects {
        object.name.clear();
        replace(&mut object.material, &materials);
        if let Some(body) = &mut object.body {
            let count = bodies.len();
            *body = bodies.entry(body.clone()).or_insert_with(|| count.to_string()).clone();
        }
    }
    scene
}

/// Replaces each name by its position in the list. Returns the position of each name.
fn number<'a>(names: impl Iterator<Item = &'a mut String>) -> HashMap<String, String> {
    names.enumerate().map(|(index, name)| (std::mem::replace(name, index.to_string()), index.to_string())).collect()
}

fn replace(name: &mut String, numbers: &HashMap<String, String>) {
    if let Some(number) = numbers.get(name) {
        name.clone_from(number);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::Edit;

    fn report() -> SceneFile {
        SceneFile::built_in("report").unwrap()
    }

    #[test]
    fn names_do_not_matter() {
        let mut renamed = report();
        let scene = &mut renamed.scene;
        scene.objects[0].name = "another name".to_owned();
        scene.lights[0].name = "another name".to_owned();
        for index in 0..scene.materials.len() {
            let mut material = scene.materials[index].clone();
            material.name = format!("material {index}");
            Edit::Material(index, material).apply(scene);
        }
        for index in 0..scene.textures.len() {
            let mut texture = scene.textures[index].clone();
            texture.name = format!("texture {index}");
            Edit::Texture(index, texture).apply(scene);
        }
        assert!(same_picture(&report(), &renamed));
    }

    #[test]
    fn the_use_of_names_matters() {
        let mut other = report();
        let used = &other.scene.objects[0].material;
        let free = other.scene.materials.iter().find(|material| material.name != *used).unwrap().name.clone();
        other.scene.objects[0].material = free;
        assert!(!same_picture(&report(), &other), "another material");
        let mut parted = report();
        parted.scene.objects[0].body = Some("a".to_owned());
        assert!(!same_picture(&report(), &parted), "a body of its own");
    }
}
