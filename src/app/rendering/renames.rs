//! New names in the engine's texts, which have the names that the scene had when its rendering began. Renaming restarts no rendering.

use crate::scene::Scene;
use std::collections::BTreeMap;

/// The new name of each renamed item by its old name.
#[derive(Debug, Default)]
pub(crate) struct Renames<'a>(BTreeMap<&'a str, Option<&'a str>>);

impl<'a> Renames<'a> {
    /// The renames from one scene to another one with the same items. A name of several items that are called differently now stays.
    pub(super) fn between(before: &'a Scene, after: &'a Scene) -> Self {
        let mut renames = BTreeMap::new();
        for (old, new) in names(before).zip(names(after)) {
            let known = renames.entry(old).or_insert(Some(new));
            *known = known.filter(|known| *known == new);
        }
        Self(renames)
    }

    /// The text with the new names between its quotation marks.
    pub(crate) fn apply(&self, text: &str) -> String {
        let new = |name| self.0.get(name).copied().flatten().unwrap_or(name);
        let parts = text.split('"').enumerate().map(|(k, part)| if k % 2 == 1 { new(part) } else { part });
        parts.collect::<Vec<_>>().join("\"")
    }
}

/// The names of the objects, their bodies and the lights.
fn names(scene: &Scene) -> impl Iterator<Item = &str> {
    let of_objects = scene.objects.iter().flat_map(|object| [object.name.as_str(), object.body_key().name()]);
    of_objects.chain(scene.lights.iter().map(|light| light.name.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SceneFile;

    #[test]
    fn renamed_items_have_their_new_names() {
        let before = SceneFile::built_in("cornell").unwrap().scene;
        let mut after = before.clone();
        after.objects[1].name = "sky".to_owned();
        after.lights[0].name = "sun".to_owned();
        let renames = Renames::between(&before, &after);
        let (object, light, other) = (&before.objects[1].name, &before.lights[0].name, &before.objects[0].name);
        let text = format!("light \"{light}\" is inside of \"{object}\" and \"{other}\", a {object}");
        let expected = format!("light \"sun\" is inside of \"sky\" and \"{other}\", a {object}");
        assert_eq!(renames.apply(&text), expected);
        assert_eq!(Renames::default().apply(&text), text);
    }

    #[test]
    fn a_name_with_two_new_names_stays() {
        let mut before = SceneFile::built_in("cornell").unwrap().scene;
        before.lights[0].name.clone_from(&before.objects[0].name.clone());
        let mut after = before.clone();
        after.lights[0].name = "sun".to_owned();
        let text = format!("\"{}\" is open", before.objects[0].name);
        assert_eq!(Renames::between(&before, &after).apply(&text), text);
    }
}
