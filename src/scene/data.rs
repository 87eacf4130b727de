use super::{Camera, Film, Light, Material, Object, Render, Texture};
use std::collections::HashMap;

/// The version of the scene format that the program reads and writes.
pub(super) const VERSION: u32 = 1;

/// A scene as the user describes it.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Scene {
    /// The title of the window; may be empty.
    pub name: String,
    /// The camera.
    pub camera: Camera,
    /// The size of the image, exposure and tone curve.
    pub film: Film,
    /// The limits of light transport.
    pub render: Render,
    /// The images that materials refer to by name.
    pub textures: Vec<Texture>,
    /// The materials that objects refer to by name.
    pub materials: Vec<Material>,
    /// The light sources.
    pub lights: Vec<Light>,
    /// The surfaces.
    pub objects: Vec<Object>,
}

impl Scene {
    /// The index of each material, by its name.
    pub fn materials_by_name(&self) -> HashMap<&str, usize> {
        self.materials.iter().enumerate().map(|(index, material)| (material.name.as_str(), index)).collect()
    }
}
