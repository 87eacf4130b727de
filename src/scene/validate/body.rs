use super::checks::Checks;
use crate::math::Rgb;
use crate::scene::{MaterialModel, Object, Scene};
use std::collections::HashMap;

/// Checks that the materials of each body agree: a piece of glass has one index of refraction and one absorption.
pub(super) fn bodies(scene: &Scene, checks: &mut Checks<'_>) {
    let materials = scene.materials_by_name();
    let mut first_of = HashMap::new();
    for (index, object) in scene.objects.iter().enumerate() {
        let (Some(body), Some((ior, absorption))) = (&object.body, glass(scene, &materials, object)) else { continue };
        let first = *first_of.entry(body).or_insert((object, ior, absorption));
        checks.require((ior, absorption) == (first.1, first.2), &format!("object[{index}].body"), || {
            let (first, a, b) = (first.0, &first.0.material, &object.material);
            format!(
                "found \"{body}\", whose object \"{}\" has the material \"{a}\"; expected a material with the same ior and \
                 absorption here, not \"{b}\"",
                first.name
            )
        });
    }
}

/// Index of refraction and absorption of an object of glass; `None` for other materials.
fn glass(scene: &Scene, materials: &HashMap<&str, usize>, object: &Object) -> Option<(f64, Rgb)> {
    let index = *materials.get(object.material.as_str())?;
    match scene.materials[index].model {
        MaterialModel::Glass { ior, absorption, .. } => Some((ior, absorption)),
        _ => None,
    }
}
