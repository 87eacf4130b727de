use super::built_in::embedded;
use crate::{
    file::{folder, read_limited, shortened},
    geometry::bezier::{ControlNet, PatchFormat},
};
use image::{DynamicImage, ImageDecoder, ImageError, ImageReader};
use std::{
    borrow::Cow,
    fs,
    io::{self, Cursor},
    path::{Path, PathBuf},
    time::SystemTime,
};

/// The greatest number of texels of a texture: 8192 x 8192, which take 800 MB while they are decoded.
const MAX_TEXELS: u64 = 1 << 26;

/// Most bytes of a file that a scene names: more than the largest texture takes without compression.
const MAX_BYTES: u64 = 1 << 30;

/// The location of a scene, which the paths in it are relative to.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub enum Location {
    /// The scene file at this path.
    Disk(PathBuf),
    /// The built-in scene of this name.
    BuiltIn(String),
    /// Not saved yet: paths are relative to the working directory.
    #[default]
    Unsaved,
}

impl Location {
    /// The bytes of a file that the scene names, an image or a file of patches.
    ///
    /// # Errors
    ///
    /// If the file cannot be read.
    pub fn read(&self, relative: &str) -> io::Result<Cow<'static, [u8]>> {
        match self.path_on_disk(relative) {
            Some(path) => read_limited(&path, MAX_BYTES).map(Cow::Owned),
            None => embedded(&self.embedded_path(relative))
                .map(Cow::Borrowed)
                .ok_or_else(|| io::Error::new(io::ErrorKind::NotFound, "no such file among the built-in scenes")),
        }
    }

    /// The patches of a file that the scene names, in the format of its extension, otherwise `.bpt`.
    ///
    /// # Errors
    ///
    /// A message, if the file cannot be read or holds no valid patches.
    pub fn read_patches(&self, relative: &str) -> Result<Vec<ControlNet>, String> {
        let bytes = self.read(relative).map_err(|e| format!("\"{relative}\" cannot be read: {e}"))?;
        let text = str::from_utf8(&bytes).map_err(|e| format!("\"{relative}\" is not UTF-8 text: {e}"))?;
        let format = PatchFormat::of(Path::new(relative)).unwrap_or(PatchFormat::Bpt);
        format.read(text).map_err(|e| format!("\"{relative}\": {}", shortened(&e.to_string())))
    }

    /// The decoded PNG or JPEG file that the scene names, upright by the orientation that its EXIF data states.
    ///
    /// # Errors
    ///
    /// A message, if the file cannot be read or decoded, or has too many pixels.
    pub fn read_picture(&self, relative: &str) -> Result<DynamicImage, String> {
        let bytes = self.read_bytes(relative)?;
        check_size(relative, &bytes)?;
        let damaged = |e: ImageError| damaged(relative, &e);
        let mut decoder = reader(&bytes).map_err(|e| damaged(e.into()))?.into_decoder().map_err(damaged)?;
        let orientation = decoder.orientation().map_err(damaged)?;
        let mut picture = DynamicImage::from_decoder(decoder).map_err(damaged)?;
        picture.apply_orientation(orientation);
        Ok(picture)
    }

    /// Reads the header of the PNG or JPEG file that the scene names.
    ///
    /// # Errors
    ///
    /// A message, if the file cannot be read, is neither PNG nor JPEG, or has too many pixels.
    pub fn check_picture(&self, relative: &str) -> Result<(), String> {
        check_size(relative, &self.read_bytes(relative)?)
    }

    fn read_bytes(&self, relative: &str) -> Result<Cow<'static, [u8]>, String> {
        self.read(relative).map_err(|e| format!("\"{relative}\" cannot be read: {e}"))
    }

    /// The time of the last change and the length in bytes of a file that the scene names; `None` for a file inside the program, and where
    /// there is no such file.
    pub fn state_of(&self, relative: &str) -> Option<(SystemTime, u64)> {
        let metadata = fs::metadata(self.path_on_disk(relative)?).ok()?;
        Some((metadata.modified().ok()?, metadata.len()))
    }

    /// The path of a file that the scene names; `None` for a file inside the program.
    pub(super) fn path_on_disk(&self, relative: &str) -> Option<PathBuf> {
        match self {
            Self::Disk(scene) => Some(folder(scene).join(relative)),
            Self::Unsaved => Some(PathBuf::from(relative)),
            Self::BuiltIn(_) => Some(PathBuf::from(relative)).filter(|path| path.is_absolute()),
        }
    }

    /// The path in the project of a file that a built-in scene names, relative to `scenes/`.
    fn embedded_path(&self, relative: &str) -> String {
        let mut parts = vec!["scenes"];
        for part in relative.split('/') {
            match part {
                "." | "" => {}
                ".." => drop(parts.pop()),
                name => parts.push(name),
            }
        }
        parts.join("/")
    }

    /// The argument SCENE of a command line, in quotes where a shell needs them.
    pub fn argument(&self) -> String {
        let name = match self {
            Self::Disk(path) => path.display().to_string(),
            Self::BuiltIn(name) => name.clone(),
            Self::Unsaved => "SCENE".to_owned(),
        };
        let plain = name.chars().all(|c| c.is_alphanumeric() || "-_./".contains(c));
        if plain { name } else { format!("'{}'", name.replace('\'', r"'\''")) }
    }

    /// The name of the scene in messages and titles: the path, or the name of the built-in scene.
    pub fn label(&self) -> String {
        match self {
            Self::Disk(path) => path.display().to_string(),
            Self::BuiltIn(name) => format!("built-in scene {name}"),
            Self::Unsaved => "unsaved scene".to_owned(),
        }
    }
}

fn reader(bytes: &[u8]) -> io::Result<ImageReader<Cursor<&[u8]>>> {
    ImageReader::new(Cursor::new(bytes)).with_guessed_format()
}

fn damaged(relative: &str, error: &ImageError) -> String {
    format!("\"{relative}\" is not a valid PNG or JPEG image: {}", error.to_string().trim())
}

/// Checks the number of pixels by the header of a PNG or JPEG file.
fn check_size(relative: &str, bytes: &[u8]) -> Result<(), String> {
    let damaged = |e: ImageError| damaged(relative, &e);
    let (width, height) = reader(bytes).map_err(|e| damaged(e.into()))?.into_dimensions().map_err(damaged)?;
    if u64::from(width) * u64::from(height) > MAX_TEXELS {
        return Err(format!("\"{relative}\" has {width} x {height} pixels, expected at most 8192 x 8192"));
    }
    Ok(())
}

/// The path relative to `folder`, or the absolute path where no relative path exists. Separated by `/` on every system.
pub(super) fn relative_to(folder: &Path, path: &Path) -> io::Result<String> {
    let path = std::path::absolute(path)?;
    // Resolves symbolic links, from which `..` leads elsewhere.
    let (path, folder) = match (path.canonicalize(), folder.canonicalize()) {
        (Ok(path), Ok(folder)) => (path, folder),
        _ => (path, std::path::absolute(folder)?),
    };
    let relative = pathdiff::diff_paths(&path, folder).unwrap_or(path);
    let text = relative
        .to_str()
        .ok_or_else(|| io::Error::other("the path is not valid Unicode, which a scene file cannot hold"))?;
    Ok(if cfg!(windows) { text.replace('\\', "/") } else { text.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A JPEG whose rows are the columns of the picture: EXIF orientation 6, to be turned right.
    #[test]
    fn pictures_stand_upright() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/exif/orientation-6.jpg");
        let picture = Location::Unsaved.read_picture(file).unwrap().into_rgb8();
        let (width, height) = picture.dimensions();
        let [red, green, blue] = picture.get_pixel(width / 4, height / 4).0;
        assert!(blue > 150 && red < 60 && green < 60, "blue at the top left: {red} {green} {blue}");
        let [red, _, blue] = picture.get_pixel(3 * width / 4, height / 4).0;
        assert!(red > 150 && blue < 60, "red at the top right");
    }
}
