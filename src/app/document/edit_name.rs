//! The names of edits in menus and in the history, with the name of the edited item.

use super::changed_field::{of_camera, of_film, of_light, of_material, of_object, of_render, of_texture};
use super::edit::Edit;
use super::handles::Handle;
use super::selection::Item;
use crate::scene::Scene;

/// Most letters of an item's name in the name of an edit.
const LONGEST: usize = 32;

/// The name of an edit of `scene`, to follow the word "Undo": what it does, to which field and to which item.
pub(super) fn edit_name(edit: &Edit, scene: &Scene) -> String {
    let (action, _) = edit.key();
    match (changed_field(edit, scene), edited_item(edit)) {
        (Some(field), Some(item)) => match name_of(scene, item) {
            Some(_) => with_item(&format!("change {field} of"), name_of(scene, item)),
            None if item == Item::Camera => format!("change {field} of camera"),
            None => format!("change {field}"),
        },
        _ => action_name(action, edit, scene),
    }
}

/// The one field that an edit of an item changes.
fn changed_field(edit: &Edit, scene: &Scene) -> Option<&'static str> {
    match edit {
        Edit::Camera(new) => of_camera(&scene.camera, new),
        Edit::Film(new) => of_film(&scene.film, new),
        Edit::Render(new) => of_render(&scene.render, new),
        Edit::Object(index, new) => of_object(scene.objects.get(*index)?, new),
        Edit::Material(index, new) => of_material(scene.materials.get(*index)?, new),
        Edit::Light(index, new) => of_light(scene.lights.get(*index)?, new),
        Edit::Texture(index, new) => of_texture(scene.textures.get(*index)?, new),
        _ => None,
    }
}

/// The item whose fields an edit changes.
fn edited_item(edit: &Edit) -> Option<Item> {
    match edit {
        Edit::Camera(_) => Some(Item::Camera),
        Edit::Film(_) | Edit::Render(_) => Some(Item::Settings),
        Edit::Object(index, _) => Some(Item::Object(*index)),
        Edit::Material(index, _) => Some(Item::Material(*index)),
        Edit::Light(index, _) => Some(Item::Light(*index)),
        Edit::Texture(index, _) => Some(Item::Texture(*index)),
        _ => None,
    }
}

/// The name of an edit that is no change of one field.
fn action_name(action: &str, edit: &Edit, scene: &Scene) -> String {
    if let Some(item) = edited_item(edit) {
        return with_item(action, name_of(scene, item));
    }
    match edit {
        Edit::Move(handles, _) => move_name(action, handles, scene),
        Edit::Place(object, ..) | Edit::Patches(object, ..) => {
            with_item(&format!("{action} of"), name_of(scene, Item::Object(*object)))
        }
        Edit::AddObject(object) => with_item(action, Some(&object.name)),
        Edit::AddMaterial(material) => with_item(action, Some(&material.name)),
        Edit::AddLight(light) => with_item(action, Some(&light.name)),
        Edit::AddTexture(texture) => with_item(action, Some(&texture.name)),
        Edit::Remove(item) => with_item(action, name_of(scene, *item)),
        _ => action.to_owned(),
    }
}

fn move_name(action: &str, handles: &[Handle], scene: &Scene) -> String {
    match handles {
        [Handle::Point { object, .. }] => with_item(&format!("{action} of"), name_of(scene, Item::Object(*object))),
        [Handle::Point { object, .. }, ..] => {
            let action = format!("move {} control points of", handles.len());
            with_item(&action, name_of(scene, Item::Object(*object)))
        }
        [Handle::Object(object), ..] => with_item(action, name_of(scene, Item::Object(*object))),
        [Handle::Light(light), ..] => with_item(action, name_of(scene, Item::Light(*light))),
        [] => action.to_owned(),
    }
}

fn with_item(action: &str, item: Option<&str>) -> String {
    let Some(item) = item else { return action.to_owned() };
    match item.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{action} {}…", &item[..end]),
        None => format!("{action} {item}"),
    }
}

/// The name of an item; `None` for the camera, the settings, and an item that the scene lacks.
fn name_of(scene: &Scene, item: Item) -> Option<&str> {
    Some(match item {
        Item::Nothing | Item::Camera | Item::Settings => return None,
        Item::Object(index) => &scene.objects.get(index)?.name,
        Item::Material(index) => &scene.materials.get(index)?.name,
        Item::Light(index) => &scene.lights.get(index)?.name,
        Item::Texture(index) => &scene.textures.get(index)?.name,
    })
}

#[cfg(test)]
mod tests {
    use super::super::selection::PointIndex;
    use super::*;
    use crate::scene::{Camera, Emitter, SceneFile, Shape};
    use glam::DVec3;

    #[test]
    fn an_edit_names_its_item() {
        let scene = SceneFile::built_in("report").unwrap().scene;
        let object = scene.objects.iter().position(|object| matches!(object.shape, Shape::Bezier(_))).unwrap();
        let (sheet, lamp) = (&scene.objects[object], &scene.lights[0]);
        let name = |edit: Edit| edit_name(&edit, &scene);
        let point = |i| Handle::Point { object, point: PointIndex { patch: 0, i, j: 0 } };
        let (one, two) = (vec![point(0)], vec![point(0), point(1)]);
        assert_eq!(name(Edit::Move(one, DVec3::X)), format!("move control point of {}", sheet.name));
        assert_eq!(name(Edit::Move(two, DVec3::X)), format!("move 2 control points of {}", sheet.name));
        assert_eq!(name(Edit::Move(vec![Handle::Light(0)], DVec3::X)), format!("move light {}", lamp.name));
        assert_eq!(name(Edit::Remove(Item::Object(object))), format!("delete {}", sheet.name));
        assert_eq!(name(Edit::AddLight(lamp.clone())), format!("add light {}", lamp.name));
        assert_eq!(name(Edit::Camera(Camera::default())), "edit camera");
        assert_eq!(name(Edit::View(Camera::default(), "orbit view")), "orbit view");
        assert_eq!(name(Edit::Remove(Item::Object(99))), "delete", "an item that the scene lacks");
    }

    #[test]
    fn an_edit_of_one_field_names_the_field() {
        let scene = SceneFile::built_in("report").unwrap().scene;
        let name = |edit: Edit| edit_name(&edit, &scene);
        let (mut lamp, lamp_name) = (scene.lights[0].clone(), &scene.lights[0].name);
        if let Emitter::Sphere { radiance, .. }
        | Emitter::Quad { radiance, .. }
        | Emitter::Point { intensity: radiance, .. } = &mut lamp.emitter
        {
            *radiance *= 2.0;
        }
        let strength = if matches!(lamp.emitter, Emitter::Point { .. }) { "intensity" } else { "radiance" };
        assert_eq!(name(Edit::Light(0, lamp.clone())), format!("change {strength} of {lamp_name}"));
        lamp.name = "another".to_owned();
        assert_eq!(name(Edit::Light(0, lamp)), format!("edit light {lamp_name}"), "two fields");
        let mut ground = scene.objects[0].clone();
        ground.material = "other".to_owned();
        assert_eq!(name(Edit::Object(0, ground.clone())), format!("change material of {}", scene.objects[0].name));
        assert_eq!(name(Edit::Object(99, ground)), "edit object", "an item that the scene lacks");
        let fov = Camera { fov_y: scene.camera.fov_y + 1.0, ..scene.camera };
        assert_eq!(name(Edit::Camera(fov)), "change field of view of camera");
        let mut film = scene.film;
        film.exposure += 1.0;
        assert_eq!(name(Edit::Film(film)), "change exposure");
    }

    #[test]
    fn a_long_name_is_shortened() {
        assert_eq!(with_item("delete", Some(&"ä".repeat(33))), format!("delete {}…", "ä".repeat(32)));
        assert_eq!(with_item("delete", Some(&"ä".repeat(32))), format!("delete {}", "ä".repeat(32)));
    }
}
