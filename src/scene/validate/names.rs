use crate::scene::Scene;
use std::collections::BTreeSet;

/// The names that a scene can refer to.
pub(super) struct Names<'a> {
    pub(super) textures: BTreeSet<&'a str>,
    pub(super) materials: BTreeSet<&'a str>,
}

impl<'a> Names<'a> {
    /// The names of the textures and materials of a scene.
    pub(super) fn of(scene: &'a Scene) -> Self {
        Self {
            textures: scene.textures.iter().map(|t| t.name.as_str()).collect(),
            materials: scene.materials.iter().map(|m| m.name.as_str()).collect(),
        }
    }
}
