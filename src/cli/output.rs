//! The files that commands write.

use super::CliError;
use crate::file::{folder, write_whole};
use std::path::Path;

/// Tells before the rendering rather than after it that its result cannot be written.
pub(super) fn needs_folder(path: &Path) -> Result<(), CliError> {
    let folder = folder(path);
    let there = folder.is_dir();
    if there {
        Ok(())
    } else {
        Err(CliError::Usage(format!("{}: there is no folder {}", path.display(), folder.display())))
    }
}

/// Writes a result, whole or not at all.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    write_whole(path, bytes).map_err(|e| CliError::Failed(format!("{}: cannot be written: {e}", path.display())))
}
