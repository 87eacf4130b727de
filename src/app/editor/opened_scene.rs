//! A scene file that was opened before the user is asked about the present scene.

use crate::app::document::Stamp;
use crate::scene::{SceneError, SceneFile};
use std::path::{Path, PathBuf};

/// An opened scene file, to be shown once the user has answered.
pub(crate) struct OpenedScene {
    path: PathBuf,
    /// The state of the file before it was opened.
    stamp: Option<Stamp>,
    pub(crate) file: SceneFile,
}

impl OpenedScene {
    /// Opens a scene file.
    ///
    /// # Errors
    /// As [`SceneFile::open`].
    pub(crate) fn read(path: &Path) -> Result<Self, SceneError> {
        let stamp = Stamp::of(path);
        SceneFile::open(path).map(|file| Self { path: path.to_owned(), stamp, file })
    }

    /// Whether this is the file at `path` as it is now: the answer may have been to save over it.
    pub(crate) fn is_present(&self, path: &Path) -> bool {
        self.path == path && self.stamp.is_some() && self.stamp == Stamp::of(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_was_written_meanwhile_is_another_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("room.toml");
        SceneFile::built_in("cornell").unwrap().save(&path).unwrap();
        let opened = OpenedScene::read(&path).unwrap();
        assert!(opened.is_present(&path) && !opened.is_present(&folder.path().join("other.toml")));
        SceneFile::built_in("water").unwrap().save(&path).unwrap();
        assert!(!opened.is_present(&path), "saved over");
        assert!(!opened.is_present(&folder.path().join("other.toml")));
    }
}
