use super::CliError;
use std::path::Path;

/// Says that this program has no window.
pub(super) fn open(scene: Option<&Path>) -> Result<(), CliError> {
    let scene = scene.unwrap_or(Path::new("report")).display();
    Err(CliError::Failed(format!(
        "this program was built without a window\nThis works at once: patchlight render {scene} -o picture.png"
    )))
}
