//! Proposed paths for file dialogs, and the extensions of chosen paths.

use crate::app::commands::Purpose;
use crate::app::document::Document;
use std::path::{Path, PathBuf};

/// A longer text after a dot is part of the file's name, not an extension.
const LONGEST_EXTENSION: usize = 5;

/// The path to propose: to open or save a scene, in the folder of the scene file, or else in `last`, the folder that the user chose last; for
/// other files in `last`, or else in the folder of the scene file; without both in the working directory. To write a file, the path has
/// the scene's name and the default extension.
pub(crate) fn proposed(document: &Document, purpose: Purpose, last: Option<PathBuf>) -> PathBuf {
    let of_scene = document.path().and_then(Path::parent).map(Path::to_path_buf);
    let is_of_scene = matches!(purpose, Purpose::OpenScene | Purpose::SaveScene);
    let folder = if is_of_scene { of_scene.or(last) } else { last.or(of_scene) };
    let folder = folder.or_else(|| std::env::current_dir().ok()).unwrap_or_default();
    if !purpose.writes() {
        return folder.join("");
    }
    let name = document.title();
    let stem = Path::new(name.trim_start_matches('*')).file_stem().map(Path::new).unwrap_or(Path::new("scene"));
    folder.join(stem).with_extension(purpose.extensions()[0])
}

/// The path of a typed text: `~` stands for the home folder, and a relative path starts at `folder`.
pub(super) fn typed(text: &str, folder: &Path, home: Option<PathBuf>) -> PathBuf {
    let text = text.trim();
    let below_home = text.strip_prefix('~').filter(|rest| rest.is_empty() || rest.starts_with('/'));
    match below_home.zip(home) {
        Some((rest, home)) => home.join(rest.trim_start_matches('/')),
        None => folder.join(text),
    }
}

/// The path, with the default extension appended where a file to write lacks an extension.
///
/// # Errors
/// Returns a message for a file to write in an unknown format.
pub(crate) fn complete(purpose: Purpose, path: PathBuf) -> Result<PathBuf, String> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    let allowed = |extension: &String| purpose.extensions().contains(&extension.as_str());
    if !purpose.writes() || extension.as_ref().is_some_and(allowed) {
        return Ok(path);
    }
    let is_extension = |text: &String| {
        text.len() <= LONGEST_EXTENSION
            && text.starts_with(|c: char| c.is_ascii_alphabetic())
            && text.chars().all(|c| c.is_ascii_alphanumeric())
    };
    if let Some(other) = extension.filter(is_extension) {
        return Err(format!("A .{other} file cannot be written."));
    }
    // The extension is appended, because the 5 in "view 1.5" is no extension.
    let mut name = path.into_os_string();
    name.push(".");
    name.push(purpose.extensions()[0]);
    Ok(PathBuf::from(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_typed_path_knows_the_home_folder_and_its_own_folder() {
        let path = |text| typed(text, Path::new("/scenes"), Some("/home/ada".into())).display().to_string();
        let paths = [path(" ~/a.toml "), path("~"), path("~ada/a"), path("b/c.toml"), path("/d.toml")];
        assert_eq!(paths, ["/home/ada/a.toml", "/home/ada/", "/scenes/~ada/a", "/scenes/b/c.toml", "/d.toml"]);
    }

    #[test]
    fn a_missing_extension_is_appended_and_an_unknown_one_refused() {
        let path = |purpose, path: &str| complete(purpose, PathBuf::from(path)).map(|path| path.display().to_string());
        assert_eq!(path(Purpose::ExportPicture, "a/view 1.5"), Ok("a/view 1.5.png".to_owned()));
        assert_eq!(path(Purpose::ExportPicture, "a/b.EXR"), Ok("a/b.EXR".to_owned()));
        assert_eq!(path(Purpose::SaveScene, "room"), Ok("room.toml".to_owned()));
        assert_eq!(path(Purpose::OpenScene, "room"), Ok("room".to_owned()));
        assert_eq!(path(Purpose::ExportPicture, "x.bmp"), Err("A .bmp file cannot be written.".to_owned()));
    }
}
