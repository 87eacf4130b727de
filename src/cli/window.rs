use super::CliError;
use crate::scene::SceneFile;
use std::path::Path;

/// Says that this program has no window, if the scene is right.
pub(super) fn open(scene: Option<&Path>) -> Result<(), CliError> {
    let scene = scene.unwrap_or(Path::new("report"));
    SceneFile::find(scene)?;
    Err(CliError::Failed(format!(
        "this program was built without a window\nThis works at once: patchlight render {} -o picture.png",
        scene.display()
    )))
}
