//! From text to a scene, with every problem that can be found and where it stands.

mod field;
mod notes;
mod table;
mod tables;

use super::{LocatedProblem, Location, Problem, Scene, Shape, problem::is_within, validate};
use notes::Notes;
use std::sync::Arc;
pub(super) use tables::VERSION;
use toml::de::DeTable;

/// The scene that a text describes. Reads the files that it names, to see that they are there.
pub(super) fn parse(text: &str, location: &Location) -> Result<Scene, Vec<LocatedProblem>> {
    let (root, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        return Err(errors.iter().map(|e| syntax_problem(text, e)).collect());
    }
    let mut notes = Notes::default();
    let mut scene = tables::scene(root.get_ref(), &mut notes);
    load_patches(&mut scene, location, &mut notes);
    find_textures(&scene, location, &mut notes);
    add_invalid(&scene, &mut notes);
    notes.finish(text).map(|()| scene)
}

fn syntax_problem(text: &str, error: &toml::de::Error) -> LocatedProblem {
    let problem = Problem { path: String::new(), message: error.message().trim().replace('\n', "; ") };
    LocatedProblem::at(text, error.span().map_or(0, |span| span.start), problem)
}

/// Adds what [`validate`] finds, without what only follows from a value that could not be read.
fn add_invalid(scene: &Scene, notes: &mut Notes) {
    if ["texture", "material", "light", "object"].iter().any(|list| notes.has_problem_at(list)) {
        return;
    }
    for Problem { path, message } in validate(scene) {
        if !notes.problem_paths().any(|reported| is_within(&path, reported) || is_within(reported, &path)) {
            notes.add(&path, message);
        }
    }
}

fn load_patches(scene: &mut Scene, location: &Location, notes: &mut Notes) {
    for (index, object) in scene.objects.iter_mut().enumerate() {
        let Shape::Bezier(bezier) = &mut object.shape else { continue };
        let Some(file) = &bezier.file else { continue };
        match location.read_patches(file) {
            Ok(patches) => bezier.patches = Arc::new(patches),
            Err(message) => notes.add(&format!("object[{index}].file"), message),
        }
    }
}

fn find_textures(scene: &Scene, location: &Location, notes: &mut Notes) {
    for (index, texture) in scene.textures.iter().enumerate() {
        if !texture.file.is_empty()
            && let Err(error) = location.read(&texture.file)
        {
            notes.add(&format!("texture[{index}].file"), format!("\"{}\" cannot be read: {error}", texture.file));
        }
    }
}

#[cfg(test)]
mod tests;
