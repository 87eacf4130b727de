use super::CliError;
use crate::scene::{SceneFile, built_in_scenes};
use std::path::Path;

/// The scene that an argument names: a file, or where there is none of this name, a built-in scene.
pub(super) fn open(argument: &Path) -> Result<SceneFile, CliError> {
    let built_in = built_in_scenes().iter().find(|scene| Path::new(scene.name) == argument);
    match built_in {
        Some(scene) if !argument.exists() => Ok(SceneFile::built_in(scene.name)?),
        _ => Ok(SceneFile::open(argument)?),
    }
}
