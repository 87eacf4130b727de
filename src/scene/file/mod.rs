//! Scenes with the files that they name: opening, built-in scenes, saving.

use super::{
    LocatedProblem, Location, Problem, Scene, SceneError, Shape, built_in::embedded, built_in_scenes, load,
    location::relative_to, problem::suggestion, save, surface_scene::scene_of_patches, validate,
};
use crate::file::{folder, read_limited, shortened, write_whole};
use crate::geometry::bezier::PatchFormat;
use std::{
    fs, io,
    path::{Path, PathBuf},
};

/// Most bytes of a scene file: some 200,000 patches.
const MAX_SCENE_BYTES: u64 = 256 << 20;

/// A scene with its location.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct SceneFile {
    /// The scene.
    pub scene: Scene,
    /// The location that the paths in the scene are relative to.
    pub location: Location,
}

impl SceneFile {
    /// Reads a scene file, validates it and checks the files that it names. A file of patches
    /// (`.bpt`, `.obj`, `.pov`, `.rib`) becomes an unsaved scene that shows them.
    ///
    /// # Errors
    ///
    /// If the file cannot be read or is not a valid scene; the error then lists all problems.
    pub fn open(path: &Path) -> Result<Self, SceneError> {
        let bytes =
            read_limited(path, MAX_SCENE_BYTES).map_err(|source| SceneError::Read { file: path.to_owned(), source })?;
        if let Some(format) = PatchFormat::of(path) {
            return Self::of_patches(path, format, &bytes);
        }
        let location = Location::Disk(path.to_owned());
        let text = String::from_utf8(bytes).map_err(|e| not_utf8(&e, &location))?;
        Self::parse(&text, location)
    }

    fn of_patches(path: &Path, format: PatchFormat, bytes: &[u8]) -> Result<Self, SceneError> {
        let failed = |problem: String| SceneError::Patches { file: path.to_owned(), problem };
        let text = str::from_utf8(bytes).map_err(|e| failed(format!("is not UTF-8 text: {e}")))?;
        let nets = format.read(text).map_err(|e| failed(shortened(&e.to_string()).into_owned()))?;
        let mut points = nets.iter().flat_map(|net| net.points.iter().flatten());
        if points.next().is_some_and(|first| points.all(|point| point == first)) {
            return Err(failed("all control points are the same point, so there is no surface to show".to_owned()));
        }
        let absolute = std::path::absolute(path).map_err(|e| failed(e.to_string()))?;
        let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let scene = scene_of_patches(&name, nets, absolute.display().to_string());
        match validate(&scene).first() {
            Some(problem) => Err(failed(format!("its patches make no valid scene: {problem}"))),
            None => Ok(Self { scene, location: Location::Unsaved }),
        }
    }

    /// The paths on disk of the textures and patches that the scene names.
    pub fn files(&self) -> Vec<PathBuf> {
        let Scene { textures, objects, .. } = &self.scene;
        let patches = objects.iter().filter_map(|object| match &object.shape {
            Shape::Bezier(bezier) => bezier.file.as_deref(),
            _ => None,
        });
        let named = textures.iter().map(|texture| texture.file.as_str()).chain(patches);
        named.filter_map(|file| self.location.path_on_disk(file)).collect()
    }

    /// The scene of a command line: the scene file at this path, or else the built-in scene of this name.
    ///
    /// # Errors
    ///
    /// If there is neither, or the file is not a valid scene.
    pub fn find(name: &Path) -> Result<Self, SceneError> {
        Self::find_from(Path::new(""), name)
    }

    /// The scene file at a path relative to `folder`, or else the built-in scene of this name.
    ///
    /// # Errors
    ///
    /// If there is neither, or the file is not a valid scene.
    pub fn find_from(folder: &Path, name: &Path) -> Result<Self, SceneError> {
        let path = folder.join(name);
        let names_a_file = path.exists() || name.extension().is_some() || name.components().count() > 1;
        match name.to_str().filter(|word| !names_a_file && !word.is_empty()) {
            Some(word) => Self::built_in(word),
            None => Self::open(&path),
        }
    }

    /// The built-in scene of this name.
    ///
    /// # Errors
    ///
    /// If there is no such scene.
    pub fn built_in(name: &str) -> Result<Self, SceneError> {
        let names = built_in_scenes().iter().map(|scene| scene.name);
        let found = names.clone().find(|known| *known == name);
        let bytes = found.and_then(|known| embedded(&format!("scenes/{known}.toml")));
        let Some(bytes) = bytes else {
            let known = names.clone().collect::<Vec<_>>().join(", ");
            return Err(SceneError::NoSuchExample {
                name: name.to_owned(),
                known,
                suggestion: suggestion(name, names),
            });
        };
        let location = Location::BuiltIn(name.to_owned());
        let text = String::from_utf8(bytes.to_vec()).map_err(|e| not_utf8(&e, &location))?;
        Self::parse(&text, location)
    }

    /// The scene of a text; paths in it are relative to `location`.
    ///
    /// # Errors
    ///
    /// If the text is not a valid scene.
    pub fn parse(text: &str, location: Location) -> Result<Self, SceneError> {
        match load::parse(text, &location) {
            Ok(scene) => Ok(Self { scene, location }),
            Err(problems) => Err(SceneError::Invalid { file: location.label(), problems }),
        }
    }

    /// Writes the scene to `path`, whole or not at all, and changes the location to that file.
    ///
    /// Paths in the scene are rewritten so that they name the same files from the new location. Files inside the program are
    /// copied beside the scene. Patches that differ from their `.bpt` file are written into the scene file.
    ///
    /// # Errors
    ///
    /// If the scene file or a copied file cannot be written.
    pub fn save(&mut self, path: &Path) -> Result<(), SceneError> {
        let failed = |source| SceneError::Write { file: path.to_owned(), source };
        let mut saved = self.scene.clone();
        let mut carried = Vec::new();
        for texture in &mut saved.textures {
            texture.file = self.moved(&texture.file, path, &mut carried).map_err(failed)?;
        }
        for object in &mut saved.objects {
            if let Shape::Bezier(bezier) = &mut object.shape
                && let Some(file) = bezier.file.take()
                && self.location.read_patches(&file).is_ok_and(|patches| patches == *bezier.patches)
            {
                bezier.file = Some(self.moved(&file, path, &mut carried).map_err(failed)?);
            }
        }
        for (file, bytes) in carried {
            write_whole(&file, bytes).map_err(|source| SceneError::Write { file, source })?;
        }
        write_whole(path, save::text(&saved).as_bytes()).map_err(failed)?;
        *self = Self { scene: saved, location: Location::Disk(path.to_owned()) };
        Ok(())
    }

    /// The path, from a scene file at `path`, of the file that `relative` names from the present location. Adds to `carried` a
    /// file that has to be copied.
    fn moved(&self, relative: &str, path: &Path, carried: &mut Vec<(PathBuf, &'static [u8])>) -> io::Result<String> {
        let folder = folder(path);
        if relative.is_empty() {
            return Ok(String::new());
        }
        if Path::new(relative).is_absolute() {
            // Files beside or below the scene get relative paths, so that the folder can be moved as a whole.
            let is_below = std::path::absolute(&folder).is_ok_and(|folder| Path::new(relative).starts_with(folder));
            return if is_below { relative_to(&folder, Path::new(relative)) } else { Ok(relative.to_owned()) };
        }
        if let Some(file) = self.location.path_on_disk(relative) {
            let stays = matches!(&self.location, Location::Disk(from) if crate::file::folder(from) == folder);
            return if stays { Ok(relative.to_owned()) } else { relative_to(&folder, &file) };
        }
        match self.location.read(relative)? {
            std::borrow::Cow::Borrowed(bytes) => beside(&folder, relative, bytes, carried),
            std::borrow::Cow::Owned(_) => Ok(relative.to_owned()),
        }
    }
}

/// A free name in `folder` for a copied file, or the name of a file with the same bytes.
fn beside(
    folder: &Path,
    relative: &str,
    bytes: &'static [u8],
    carried: &mut Vec<(PathBuf, &'static [u8])>,
) -> io::Result<String> {
    let name = relative.rsplit('/').next().unwrap_or(relative);
    let (stem, extension) = name.rsplit_once('.').unwrap_or((name, ""));
    for number in 1.. {
        let candidate = if number == 1 { name.to_owned() } else { format!("{stem}-{number}.{extension}") };
        let file = folder.join(&candidate);
        let planned = carried.iter().find(|(other, _)| *other == file).map(|(_, bytes)| *bytes);
        let there = planned.map(|b| Ok(b.to_vec())).unwrap_or_else(|| fs::read(&file));
        match there {
            Ok(held) if held == bytes => return Ok(candidate),
            Ok(_) => {}
            Err(e) if e.kind() == io::ErrorKind::NotFound => {
                carried.push((file, bytes));
                return Ok(candidate);
            }
            Err(e) => return Err(e),
        }
    }
    Err(io::Error::other("there is no free file name"))
}

fn not_utf8(error: &std::string::FromUtf8Error, location: &Location) -> SceneError {
    let valid = error.utf8_error().valid_up_to();
    let text = String::from_utf8_lossy(&error.as_bytes()[..valid]);
    let problem = Problem { path: String::new(), message: "the file is not valid UTF-8 from here on".to_owned() };
    SceneError::Invalid { file: location.label(), problems: vec![LocatedProblem::at(&text, text.len(), problem)] }
}

#[cfg(test)]
mod tests;
