//! What to trace, or why there is nothing to trace. Knows no widget.

use crate::app::document::{Document, Item};
use crate::math::Rgb;
use crate::scene::{Camera, Color, Film, MaterialModel, Scene, SceneFile};
use crate::transport::{LightPaths, light_paths};
use crate::world::{World, prepare};
use std::sync::Arc;

/// The light paths at a patch of an object, as a camera sees them.
#[derive(Clone, Debug)]
pub(super) struct Request {
    file: Arc<SceneFile>,
    object: usize,
    patch: usize,
    /// The camera and the film of the picture.
    camera: Camera,
    film: Film,
}

impl Request {
    /// The request for the selected surface.
    ///
    /// # Errors
    ///
    /// If there is nothing to trace: what the user has to change.
    pub(super) fn new(document: &Document, seen: &Scene) -> Result<Self, &'static str> {
        let (scene, selection) = (document.scene(), &document.selection);
        let (Item::Object(object), Some(_)) = (selection.item, selection.surface(scene)) else {
            return Err("Select a surface of patches");
        };
        if !is_specular(scene, object) {
            return Err("The surface needs a material of mirror or glass");
        }
        if scene.lights.is_empty() {
            return Err("The scene has no light");
        }
        let (camera, film) = (seen.camera, seen.film);
        Ok(Self { file: Arc::clone(document.file()), object, patch: selection.patch, camera, film })
    }

    /// Whether both have the same light paths.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.file, &other.file)
            && (self.object, self.patch, &self.camera) == (other.object, other.patch, &other.camera)
            && (self.film.width, self.film.height) == (other.film.width, other.film.height)
    }

    /// Whether both are for one surface, which an edit may have changed between them.
    pub(super) fn is_same_surface(&self, other: &Self) -> bool {
        (self.object, self.patch) == (other.object, other.patch)
    }

    /// Traces the light. The world shares unchanged parts with `previous`. Nothing for a scene that cannot be rendered.
    pub(super) fn trace(&self, previous: Option<&World>) -> (Option<World>, LightPaths) {
        let mut scene = bare(&self.file.scene);
        (scene.camera, scene.film) = (self.camera, self.film);
        let world = prepare(&scene, &self.file.location, previous).ok();
        let found = world.as_ref().map(|world| light_paths(world, self.object as u32, self.patch));
        (world, found.unwrap_or_default())
    }
}

fn is_specular(scene: &Scene, object: usize) -> bool {
    let material = scene.objects.get(object).map(|object| object.material.as_str());
    let mut models = scene.materials.iter().filter(|each| Some(each.name.as_str()) == material).map(|each| &each.model);
    models.any(|model| {
        matches!(model, MaterialModel::Mirror { .. } | MaterialModel::Glass { .. } | MaterialModel::Polished { .. })
    })
}

/// The scene without textures, which change no way of light, and without relief: the paths show the shape of the surface alone.
fn bare(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    for material in &mut scene.materials {
        material.relief = None;
        let colors = match &mut material.model {
            MaterialModel::Diffuse { albedo } => [Some(albedo), None],
            MaterialModel::Phong { albedo, specular, .. } => [Some(albedo), Some(specular)],
            MaterialModel::Polished { albedo, reflectance } => [Some(albedo), Some(reflectance)],
            MaterialModel::Mirror { reflectance } => [Some(reflectance), None],
            MaterialModel::Glass { tint, .. } => [Some(tint), None],
        };
        for color in colors.into_iter().flatten() {
            if matches!(color, Color::Texture(_)) {
                *color = Color::Constant(Rgb::ONE);
            }
        }
    }
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_world_of_light_paths_reads_no_file() {
        let file = SceneFile::built_in("report").unwrap();
        let world = prepare(&bare(&file.scene), &file.location, None).unwrap();
        assert_eq!(world.images().count(), 0);
        assert!(world.materials.iter().all(|material| !material.has_relief()));
    }
}
