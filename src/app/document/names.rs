//! Names that are unique among the items of a kind.

use super::selection::Item;
use crate::scene::Scene;

/// A name for `item` that no other item of its kind has: `wanted`, or its stem with the first number from 2 that makes the
/// name free. `item` may be the next item of its list.
pub(super) fn free_name(scene: &Scene, item: Item, wanted: &str) -> String {
    let (names, index): (Vec<&str>, usize) = match item {
        Item::Object(index) => (scene.objects.iter().map(|object| object.name.as_str()).collect(), index),
        Item::Material(index) => (scene.materials.iter().map(|material| material.name.as_str()).collect(), index),
        Item::Light(index) => (scene.lights.iter().map(|light| light.name.as_str()).collect(), index),
        Item::Texture(index) => (scene.textures.iter().map(|texture| texture.name.as_str()).collect(), index),
        Item::Nothing | Item::Camera | Item::Settings => return wanted.to_owned(),
    };
    let taken = |name: &str| names.iter().enumerate().any(|(other, taken)| other != index && *taken == name);
    if !taken(wanted) {
        return wanted.to_owned();
    }
    let stem = wanted.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end();
    (2_u64..).map(|number| format!("{stem} {number}")).find(|name| !taken(name)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;
    use crate::scene::{Emitter, Light};
    use glam::DVec3;

    #[test]
    fn a_name_is_free_and_an_item_keeps_its_own() {
        let emitter = Emitter::Point { position: DVec3::ZERO, intensity: Rgb::ONE };
        let lights = ["ball", "ball 2", "lamp"].map(|name| Light { name: name.into(), emitter: emitter.clone() });
        let scene = Scene { lights: lights.into(), ..Scene::default() };
        let free = |index, wanted| free_name(&scene, Item::Light(index), wanted);
        let new = [free(3, "cube"), free(3, "ball"), free(3, "ball 2"), free(3, "lamp")];
        assert_eq!(new, ["cube", "ball 3", "ball 3", "lamp 2"]);
        assert_eq!([free(1, "ball 2"), free(1, "lamp")], ["ball 2", "lamp 2"]);
    }
}
