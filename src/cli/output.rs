//! The output files of the commands.

use super::CliError;
use crate::file::{folder, link_target, write_whole};
use crate::scene::SceneFile;
use std::path::Path;

/// Fails before the rendering if the folder of its result does not exist.
pub(super) fn needs_folder(path: &Path) -> Result<(), CliError> {
    let folder = folder(path);
    let there = folder.is_dir();
    if there {
        Ok(())
    } else {
        Err(CliError::Usage(format!("{}: the folder {} does not exist", path.display(), folder.display())))
    }
}

/// Fails before the rendering if one of the files that it writes, each with its name, has no folder, or is another one of them.
pub(super) fn must_be_own_files(written: &[(&Path, &str)]) -> Result<(), CliError> {
    for (index, (path, name)) in written.iter().enumerate() {
        needs_folder(path)?;
        if let Some((_, other)) = written[..index].iter().find(|(other, _)| is_same_file(path, other)) {
            let file = path.display();
            return Err(CliError::Usage(format!("{file}: is both the {other} and the {name}, expected two files")));
        }
    }
    Ok(())
}

/// Writes a file, whole or not at all.
pub(super) fn write(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    write_whole(path, bytes).map_err(|e| CliError::Failed(format!("{}: cannot be written: {e}", path.display())))
}

/// Fails if a file that is written is one of those that are read, each with its name, and would be lost.
pub(super) fn must_not_overwrite<'a>(
    written: &Path,
    read: impl IntoIterator<Item = (&'a Path, &'a str)>,
) -> Result<(), CliError> {
    match read.into_iter().find(|(read, _)| is_same_file(written, read)) {
        Some((_, name)) => Err(CliError::Usage(format!("{}: is {name}, which would be lost", written.display()))),
        None => Ok(()),
    }
}

/// [`must_not_overwrite`] for the files that a scene names.
pub(super) fn must_spare_files_of(scene: &SceneFile, written: &Path) -> Result<(), CliError> {
    let files = scene.files();
    must_not_overwrite(written, files.iter().map(|file| (file.as_path(), "a file of the scene")))
}

/// Whether two paths lead to one file, which need not exist.
fn is_same_file(a: &Path, b: &Path) -> bool {
    let resolved = |path: &Path| {
        let path = link_target(path);
        path.canonicalize()
            .or_else(|_| folder(&path).canonicalize().map(|at| at.join(path.file_name().unwrap_or_default())))
    };
    matches!((resolved(a), resolved(b)), (Ok(a), Ok(b)) if a == b)
}
