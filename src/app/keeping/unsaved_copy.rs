//! Unsaved changes as the text of a file.

use crate::app::document::Stamp;
use crate::file::read_text_limited;
use crate::scene::{Location, SceneFile, Shape};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{self, Path};

/// The first lines of the file. The second one ends with the header.
const TITLE: &str = "# Unsaved changes of a scene, kept by patchlight.\n#";
/// Most bytes of a file that are read.
const MAX_BYTES: u64 = 1 << 30;

/// A scene with unsaved changes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct UnsavedCopy {
    pub(crate) file: SceneFile,
    /// The state of the scene's file that the changes are based on.
    pub(crate) stamp: Option<Stamp>,
}

/// What the text of the scene does not say.
#[derive(Serialize, Deserialize)]
struct Header {
    /// The path of the scene's file; `None` for a scene without a file.
    path: Option<OsString>,
    /// The name of the built-in scene; `None` for any other scene.
    built_in: Option<String>,
    stamp: Option<Stamp>,
    /// The `.bpt` file of each object that has one, by the object's index.
    patch_files: BTreeMap<usize, String>,
}

impl UnsavedCopy {
    /// The content of a file that keeps the scene: a header in a comment, then the scene with all patches.
    ///
    /// # Errors
    /// A message, if the working directory, which the paths of a new scene are relative to, is gone.
    pub(super) fn text(&self) -> Result<String, String> {
        let mut file = self.file.clone();
        let (path, built_in) = match &file.location {
            Location::Disk(path) => (Some(path::absolute(path).map_err(|e| e.to_string())?.into_os_string()), None),
            Location::BuiltIn(name) => (None, Some(name.clone())),
            Location::Unsaved => (None, None),
        };
        if file.location == Location::Unsaved {
            name_absolute_paths(&mut file)?;
        }
        let header = Header { path, built_in, stamp: self.stamp, patch_files: patch_files(&file) };
        let header = serde_json::to_string(&header).map_err(|e| e.to_string())?;
        Ok(format!("{TITLE}{header}\n{}", file.snapshot()))
    }

    /// Reads a kept scene.
    ///
    /// # Errors
    /// A message, if the file cannot be read or is damaged.
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let text = read_text_limited(path, MAX_BYTES).map_err(|error| format!("it cannot be read: {error}"))?;
        Self::parse(&text, path)
    }

    fn parse(text: &str, path: &Path) -> Result<Self, String> {
        let (header, _) = text.strip_prefix(TITLE).and_then(|rest| rest.split_once('\n')).ok_or("it has no header")?;
        let header: Header = serde_json::from_str(header).map_err(|error| format!("its header is damaged: {error}"))?;
        let restored = SceneFile::restore(text, Location::Disk(path.to_owned()));
        let mut file = restored.map_err(|error| format!("it is damaged: {error}"))?;
        for (object, patch_file) in header.patch_files {
            if let Some(Shape::Bezier(bezier)) = file.scene.objects.get_mut(object).map(|object| &mut object.shape) {
                bezier.file = Some(patch_file);
            }
        }
        file.location = match (header.path, header.built_in) {
            (Some(path), _) => Location::Disk(path.into()),
            (None, Some(name)) => Location::BuiltIn(name),
            (None, None) => Location::Unsaved,
        };
        Ok(Self { file, stamp: header.stamp })
    }
}

fn patch_files(file: &SceneFile) -> BTreeMap<usize, String> {
    let patch_file = |(index, object): (usize, &crate::scene::Object)| match &object.shape {
        Shape::Bezier(bezier) => Some((index, bezier.file.clone()?)),
        _ => None,
    };
    file.scene.objects.iter().enumerate().filter_map(patch_file).collect()
}

/// Makes the paths in a scene independent of the working directory.
fn name_absolute_paths(file: &mut SceneFile) -> Result<(), String> {
    let textures = file.scene.textures.iter_mut().map(|texture| &mut texture.file);
    let patches = file.scene.objects.iter_mut().filter_map(|object| match &mut object.shape {
        Shape::Bezier(bezier) => bezier.file.as_mut(),
        _ => None,
    });
    for name in textures.chain(patches).filter(|name| !name.is_empty()) {
        let absolute = path::absolute(&name).map_err(|error| error.to_string())?;
        // The path of a file in a scene is Unicode text; a working directory that is not stays out.
        if let Some(text) = absolute.to_str() {
            text.clone_into(name);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Encoding, Texture};

    fn stays(file: SceneFile, stamp: Option<Stamp>) {
        let copy = UnsavedCopy { file, stamp };
        assert_eq!(UnsavedCopy::parse(&copy.text().unwrap(), Path::new("kept.toml")), Ok(copy));
    }

    #[test]
    fn a_copy_keeps_the_scene_and_its_place() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a \n\"b\".toml");
        std::fs::write(&path, "").unwrap();
        let mut file = SceneFile::built_in("teapot").unwrap();
        file.scene.name = "a\n# b".to_owned();
        stays(file.clone(), None);
        file.location = Location::Disk(path.clone());
        stays(file.clone(), Stamp::of(&path));
        if let Shape::Bezier(bezier) = &mut file.scene.objects[0].shape {
            bezier.file = Some("pot.bpt".to_owned());
        }
        stays(file, None);
        stays(SceneFile::default(), None);
    }

    #[cfg(unix)]
    #[test]
    fn a_path_that_is_no_unicode_text_stays() {
        use std::os::unix::ffi::OsStringExt;
        let path = OsString::from_vec(b"/tmp/\xff.toml".to_vec());
        let location = Location::Disk(path.into());
        stays(SceneFile { location, ..SceneFile::built_in("cornell").unwrap() }, None);
    }

    #[test]
    fn the_paths_of_a_new_scene_do_not_depend_on_the_working_directory() {
        let texture = Texture { name: "wood".into(), file: "a/b.png".into(), encoding: Encoding::Srgb };
        let mut file = SceneFile::default();
        file.scene.textures.push(texture);
        let text = UnsavedCopy { file, stamp: None }.text().unwrap();
        let read = UnsavedCopy::parse(&text, Path::new("kept.toml")).unwrap();
        let expected = std::env::current_dir().unwrap().join("a/b.png");
        assert_eq!(Path::new(&read.file.scene.textures[0].file), expected);
    }

    #[test]
    fn damage_is_told() {
        let copy = UnsavedCopy { file: SceneFile::built_in("cornell").unwrap(), stamp: None };
        let text = copy.text().unwrap();
        let error = |text: &str| UnsavedCopy::parse(text, Path::new("kept.toml")).unwrap_err();
        assert_eq!(error(""), "it has no header");
        assert_eq!(error("version = 1\n"), "it has no header");
        assert!(error(&text.replacen("stamp", "stomp\u{7}", 1)).contains("header is damaged"));
        assert!(error(&text[..text.len() - 20]).contains("it is damaged: kept.toml:"));
    }
}
