//! Every change that the window can make to a scene, as data.

use super::handles::{self, Handle};
use super::names::free_name;
use super::selection::{Item, PointIndex};
use crate::scene::{
    Bezier, Camera, Color, Film, Light, Material, MaterialModel, Object, Relief, Render, Scene, Shape, Texture,
};
use glam::DVec3;

/// A change of a scene; an index is the item's position in its list.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Edit {
    /// The scene's name.
    Name(String),
    /// The camera.
    Camera(Camera),
    /// The camera, moved by navigation under this name of the edit.
    View(Camera, &'static str),
    /// Image size, exposure and tone curve.
    Film(Film),
    /// The limits of light transport and the background.
    Render(Render),
    /// Replaces the object at this index.
    Object(usize, Object),
    /// Replaces the material at this index; a new name is copied to the objects that use it.
    Material(usize, Material),
    /// Replaces the light at this index.
    Light(usize, Light),
    /// Replaces the texture at this index; a new name is copied to the materials that use it.
    Texture(usize, Texture),
    /// Moves handles by a vector in world space.
    Move(Vec<Handle>, DVec3),
    /// Moves each handle by its own vector in world space.
    MoveEach(Vec<(Handle, DVec3)>),
    /// Places control points of the object at this index at positions in object space, under this name of the edit.
    Place(usize, Vec<(PointIndex, DVec3)>, &'static str),
    /// Replaces the surface of the object at this index, under this name of the edit.
    Patches(usize, Bezier, &'static str),
    /// Appends an object.
    AddObject(Object),
    /// Appends a material.
    AddMaterial(Material),
    /// Appends a light.
    AddLight(Light),
    /// Appends a texture.
    AddTexture(Texture),
    /// Removes an object, material, light or texture.
    Remove(Item),
}

/// The edit's name and the index of the edited item: edits of one gesture with equal keys make one undo step.
pub(crate) type EditKey = (&'static str, usize);

impl Edit {
    /// The edit's name, to follow the word "Undo", and the index of the edited item.
    pub(crate) fn key(&self) -> EditKey {
        match self {
            Self::Name(_) => ("rename scene", 0),
            Self::Camera(_) => ("edit camera", 0),
            Self::View(_, name) => (name, 0),
            Self::Film(_) => ("edit picture settings", 0),
            Self::Render(_) => ("edit render settings", 0),
            Self::Object(index, _) => ("edit object", *index),
            Self::Material(index, _) => ("edit material", *index),
            Self::Light(index, _) => ("edit light", *index),
            Self::Texture(index, _) => ("edit texture", *index),
            Self::Move(handles, _) => move_key(handles.first().copied()),
            Self::MoveEach(ways) => move_key(ways.first().map(|(handle, _)| *handle)),
            Self::Place(object, _, name) | Self::Patches(object, _, name) => (name, *object),
            Self::AddObject(_) => ("add object", 0),
            Self::AddMaterial(_) => ("add material", 0),
            Self::AddLight(_) => ("add light", 0),
            Self::AddTexture(_) => ("add texture", 0),
            Self::Remove(_) => ("delete", 0),
        }
    }

    /// The item to select after this edit of `scene`: an added item; after a removal nothing, so that a second "Delete"
    /// removes nothing. `None` where the selection stays.
    pub(crate) fn selects(&self, scene: &Scene) -> Option<Item> {
        Some(match self {
            Self::AddObject(_) => Item::Object(scene.objects.len()),
            Self::AddMaterial(_) => Item::Material(scene.materials.len()),
            Self::AddLight(_) => Item::Light(scene.lights.len()),
            Self::AddTexture(_) => Item::Texture(scene.textures.len()),
            Self::Remove(_) => Item::Nothing,
            _ => return None,
        })
    }

    /// Replaces a name that another item of the kind has by a free one, and returns the free one; `None` where the name stays.
    /// With two items of one name, a material's users could not be told apart.
    pub(crate) fn free_its_name(&mut self, scene: &Scene) -> Option<String> {
        let (item, name) = match self {
            Self::Object(index, object) => (Item::Object(*index), &mut object.name),
            Self::Material(index, material) => (Item::Material(*index), &mut material.name),
            Self::Light(index, light) => (Item::Light(*index), &mut light.name),
            Self::Texture(index, texture) => (Item::Texture(*index), &mut texture.name),
            _ => return None,
        };
        let free = free_name(scene, item, name);
        (free != *name).then(|| {
            name.clone_from(&free);
            free
        })
    }

    /// Changes the scene. An index beyond the end of its list has no effect.
    pub(crate) fn apply(self, scene: &mut Scene) {
        match self {
            Self::Name(name) => scene.name = name,
            Self::Camera(camera) | Self::View(camera, _) => scene.camera = camera,
            Self::Film(film) => scene.film = film,
            Self::Render(render) => scene.render = render,
            Self::Object(index, object) => replace(&mut scene.objects, index, object),
            Self::Material(index, material) => replace_material(scene, index, material),
            Self::Light(index, light) => replace(&mut scene.lights, index, light),
            Self::Texture(index, texture) => replace_texture(scene, index, texture),
            Self::Move(handles, by) => handles.into_iter().for_each(|handle| handle.translate(scene, by)),
            Self::MoveEach(ways) => ways.into_iter().for_each(|(handle, by)| handle.translate(scene, by)),
            Self::Place(object, points, _) => handles::place(scene, object, &points),
            Self::Patches(object, surface, _) => replace_surface(scene, object, surface),
            Self::AddObject(object) => scene.objects.push(object),
            Self::AddMaterial(material) => scene.materials.push(material),
            Self::AddLight(light) => scene.lights.push(light),
            Self::AddTexture(texture) => scene.textures.push(texture),
            Self::Remove(item) => remove(scene, item),
        }
    }
}

fn move_key(first: Option<Handle>) -> EditKey {
    match first {
        Some(Handle::Point { object, .. }) => ("move control point", object),
        Some(Handle::Object(object)) => ("move object", object),
        Some(Handle::Light(light)) => ("move light", light),
        None => ("move", 0),
    }
}

fn replace<T>(list: &mut [T], index: usize, new: T) {
    if let Some(old) = list.get_mut(index) {
        *old = new;
    }
}

fn replace_surface(scene: &mut Scene, object: usize, surface: Bezier) {
    if let Some(Object { shape: shape @ (Shape::Bezier(_) | Shape::Revolution(_)), .. }) = scene.objects.get_mut(object)
    {
        *shape = Shape::Bezier(surface);
    }
}

fn replace_material(scene: &mut Scene, index: usize, material: Material) {
    let Some(old) = scene.materials.get(index) else { return };
    for object in scene.objects.iter_mut().filter(|object| object.material == old.name) {
        object.material.clone_from(&material.name);
    }
    replace(&mut scene.materials, index, material);
}

fn replace_texture(scene: &mut Scene, index: usize, texture: Texture) {
    let Some(old) = scene.textures.get(index) else { return };
    for used in scene.materials.iter_mut().flat_map(texture_names).filter(|used| **used == old.name) {
        used.clone_from(&texture.name);
    }
    replace(&mut scene.textures, index, texture);
}

/// The name of the first object that uses a material, or of the first material that uses a texture; `None` for an unused
/// item, and for an item of any other kind.
pub(crate) fn user_of(scene: &Scene, item: Item) -> Option<&str> {
    match item {
        Item::Material(index) => {
            let used = &scene.materials.get(index)?.name;
            scene.objects.iter().find(|object| object.material == *used).map(|object| object.name.as_str())
        }
        Item::Texture(index) => {
            let used = &scene.textures.get(index)?.name;
            let uses = |material: &&Material| texture_names(&mut (*material).clone()).iter().any(|name| *name == used);
            scene.materials.iter().find(uses).map(|material| material.name.as_str())
        }
        _ => None,
    }
}

/// The texture names in a material, of its colours and its relief map.
pub(crate) fn texture_names(material: &mut Material) -> Vec<&mut String> {
    let colors = match &mut material.model {
        MaterialModel::Diffuse { albedo } => vec![albedo],
        MaterialModel::Phong { albedo, specular, .. } => vec![albedo, specular],
        MaterialModel::Polished { albedo, reflectance } => vec![albedo, reflectance],
        MaterialModel::Mirror { reflectance } => vec![reflectance],
        MaterialModel::Glass { tint, .. } => vec![tint],
    };
    let of_colors = colors.into_iter().filter_map(|color| match color {
        Color::Texture(used) => Some(&mut used.texture),
        Color::Constant(_) => None,
    });
    let of_relief = material.relief.as_mut().map(|relief| match relief {
        Relief::Normal { map, .. } | Relief::Height { map, .. } => &mut map.texture,
    });
    of_colors.chain(of_relief).collect()
}

fn remove(scene: &mut Scene, item: Item) {
    match item {
        Item::Object(index) if index < scene.objects.len() => drop(scene.objects.remove(index)),
        Item::Material(index) if index < scene.materials.len() => drop(scene.materials.remove(index)),
        Item::Light(index) if index < scene.lights.len() => drop(scene.lights.remove(index)),
        Item::Texture(index) if index < scene.textures.len() => drop(scene.textures.remove(index)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;
    use crate::scene::TextureUse;
    use glam::DVec2;

    fn scene() -> Scene {
        let planks = TextureUse { texture: "planks".into(), scale: DVec2::ONE };
        let model = MaterialModel::Phong {
            albedo: Color::Texture(planks.clone()),
            specular: Color::Constant(Rgb::ZERO),
            exponent: 1.0,
        };
        let relief = Some(Relief::Height { map: planks, depth: 1.0 });
        let shape = Shape::Sphere { center: DVec3::ZERO, radius: 1.0 };
        Scene {
            textures: vec![Texture { name: "planks".into(), file: "a.png".into(), encoding: Default::default() }],
            materials: vec![Material { name: "floor".into(), model, relief }],
            objects: vec![Object { name: "ball".into(), material: "floor".into(), shape, body: None }],
            ..Scene::default()
        }
    }

    #[test]
    fn objects_follow_a_renamed_material() {
        let mut scene = scene();
        let renamed = Material { name: "ground".into(), ..scene.materials[0].clone() };
        Edit::Material(0, renamed).apply(&mut scene);
        assert_eq!(scene.objects[0].material, "ground");
    }

    #[test]
    fn materials_follow_a_renamed_texture() {
        let mut scene = scene();
        let renamed = Texture { name: "wood".into(), ..scene.textures[0].clone() };
        Edit::Texture(0, renamed).apply(&mut scene);
        let names: Vec<_> = texture_names(&mut scene.materials[0]).into_iter().map(|name| name.clone()).collect();
        assert_eq!(names, ["wood", "wood"], "in the colour and in the relief");
    }

    #[test]
    fn a_used_item_names_its_user() {
        let mut scene = scene();
        assert_eq!(user_of(&scene, Item::Texture(0)), Some("floor"));
        assert_eq!(user_of(&scene, Item::Material(0)), Some("ball"));
        Edit::Remove(Item::Object(0)).apply(&mut scene);
        assert_eq!(user_of(&scene, Item::Material(0)), None);
        Edit::Remove(Item::Material(0)).apply(&mut scene);
        assert_eq!(user_of(&scene, Item::Texture(0)), None);
    }

    #[test]
    fn an_index_out_of_range_has_no_effect() {
        let mut changed = scene();
        let ball = changed.objects[0].clone();
        for edit in [Edit::Object(7, ball), Edit::Remove(Item::Light(3)), Edit::Remove(Item::Camera)] {
            edit.apply(&mut changed);
            assert_eq!(changed, scene());
        }
    }
}
