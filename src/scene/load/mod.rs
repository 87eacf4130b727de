//! From text to a scene, with all problems and their positions.
//!
//! | file | holds |
//! |---|---|
//! | `tables` | the tables of the format, each read into the type that mirrors it |
//! | `table` | `Table`: a TOML table that reports missing and unknown keys |
//! | `field` | `Field`: types that can be the value of a key |
//! | `notes` | `Notes`: the positions of values, and the problems |

mod field;
mod notes;
mod table;
mod tables;

use super::{LocatedProblem, Location, Problem, Scene, Shape, validate};
use notes::Notes;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;
use toml::de::DeTable;

/// The scene of a text. Reads the files that the scene names.
///
/// # Errors
///
/// All problems of the text and of these files, in the order of the text.
pub(super) fn parse(text: &str, location: &Location) -> Result<Scene, Vec<LocatedProblem>> {
    read(text, |scene, notes| {
        load_patches(scene, location, notes);
        check_textures(scene, location, notes);
        add_invalid(scene, notes);
    })
}

/// The scene of a text, valid or not. Reads no file that the scene names: such patches are left out.
///
/// # Errors
///
/// The values of the text that no scene can have.
pub(super) fn parse_unchecked(text: &str) -> Result<Scene, Vec<LocatedProblem>> {
    read(text, |_, _| {})
}

fn read(text: &str, check: impl FnOnce(&mut Scene, &mut Notes)) -> Result<Scene, Vec<LocatedProblem>> {
    let (root, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        return Err(LocatedProblem::all(text, syntax_problems(text, &errors)));
    }
    let mut notes = Notes::default();
    let mut scene = tables::scene(root.get_ref(), &mut notes);
    check(&mut scene, &mut notes);
    notes.finish(text).map(|()| scene)
}

/// The syntax errors with their byte offsets, only the first of a line: the others mostly follow from it.
fn syntax_problems(text: &str, errors: &[toml::de::Error]) -> Vec<(usize, Problem)> {
    let mut problems: Vec<_> = errors.iter().map(|error| syntax_problem(text, error)).collect();
    problems.sort_by_key(|(offset, _)| *offset);
    problems.dedup_by(|(next, _), (first, _)| text.get(*first..*next).is_some_and(|between| !between.contains('\n')));
    problems
}

/// A syntax error with its byte offset.
fn syntax_problem(text: &str, error: &toml::de::Error) -> (usize, Problem) {
    let is_nested = error.message().trim().contains("recursion limit");
    // The parser does not tell where a key with too many points is.
    let span = error.span().unwrap_or_else(|| if is_nested { longest_key(text) } else { 0..0 });
    let found = text.get(span.clone()).unwrap_or_default();
    let rest_of_line = text.get(span.start..).unwrap_or_default().lines().next().unwrap_or_default().trim();
    let message = match error.message().trim() {
        _ if is_nested => "found a key with too many points: no table of a scene is nested so deeply".to_owned(),
        "duplicate key" => format!("found the key `{found}` for the second time"),
        // The TOML parser takes a missing value for a string without quotes.
        said if said.starts_with("string values must be quoted") && rest_of_line.is_empty() => {
            "expected a value after `=`, found none".to_owned()
        }
        said if lacks_digit_at_point(text, span.start) => {
            let hint = "a number needs digits on both sides of its point, as in 0.5 and 5.0";
            format!("{}; {hint}", said.replace('\n', "; "))
        }
        said => said.replace('\n', "; "),
    };
    (span.start, Problem { path: String::new(), message })
}

/// The place of the first key of a text that has the most points.
fn longest_key(text: &str) -> Range<usize> {
    let mut longest = (0, 0..0);
    let mut offset = 0;
    for line in text.split_inclusive('\n') {
        let key = line.split('=').next().unwrap_or_default();
        let points = key.matches('.').count();
        if points > longest.0 {
            let start = offset + (key.len() - key.trim_start().len());
            longest = (points, start..offset + key.trim_end().len());
        }
        offset += line.len();
    }
    longest.1
}

/// Whether the number around this offset lacks a digit beside its point, like `.5`, `-.5`, `5.` and `1.e5`.
fn lacks_digit_at_point(text: &str, offset: usize) -> bool {
    let is_of_number = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '+' | '-' | '_');
    let (before, after) = text.split_at(text.floor_char_boundary(offset));
    let begin = before.trim_end_matches(is_of_number).len();
    let end = text.len() - after.trim_start_matches(is_of_number).len();
    let number = text.get(begin..end).unwrap_or_default();
    number.split_once('.').is_some_and(|(whole, fraction)| {
        let is_number = number.starts_with(['.', '+', '-']) || number.starts_with(|c: char| c.is_ascii_digit());
        is_number
            && (!whole.ends_with(|c: char| c.is_ascii_digit()) || !fraction.starts_with(|c: char| c.is_ascii_digit()))
    })
}

/// Adds the problems of [`validate()`], except problems that follow from an unreadable value.
fn add_invalid(scene: &Scene, notes: &mut Notes) {
    if ["texture", "material", "light", "object"].iter().any(|list| notes.has_problem_at(list)) {
        return;
    }
    for Problem { path, message } in validate(scene) {
        let read_from = path.strip_suffix(".patches").map(|object| format!("{object}.file"));
        let follows = notes.has_problem_near(&path) || read_from.is_some_and(|file| notes.has_problem_at(&file));
        if !follows {
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

fn check_textures(scene: &Scene, location: &Location, notes: &mut Notes) {
    let problem = |file: &str| if file.is_empty() { None } else { location.read_picture(file).err() };
    let problems: Vec<_> = scene.textures.par_iter().map(|texture| problem(&texture.file)).collect();
    for (index, problem) in problems.into_iter().enumerate() {
        problem.into_iter().for_each(|message| notes.add(&format!("texture[{index}].file"), message));
    }
}

#[cfg(test)]
mod tests;
