//! The scene files that the user opened or saved last.

use super::background::Background;
use crate::file::{read_text_limited, write_whole};
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};

/// Files kept at most.
const MOST: usize = 10;
/// Most bytes of the list's file that are read.
const MAX_BYTES: u64 = 1 << 20;

/// The scene files that the user opened or saved last, the newest first. All windows share the list.
#[derive(Default)]
pub(crate) struct RecentFiles {
    paths: Vec<PathBuf>,
    /// The list's file, and the thread that writes it; `None` to keep the list in the window only.
    kept: Option<(PathBuf, Background<()>)>,
}

/// The content of the list's file. A path that is no Unicode text is not kept.
#[derive(Default, Serialize, Deserialize)]
struct List {
    files: Vec<String>,
}

impl RecentFiles {
    /// Reads the list from a file, and keeps it there from now on.
    pub(crate) fn keep_in(&mut self, file: PathBuf) {
        self.paths = read(&file);
        self.kept = Some((file, Background::new("recent files", ())));
    }

    /// The files, the newest first. They may be gone.
    pub(crate) fn paths(&self) -> &[PathBuf] {
        &self.paths
    }

    /// Puts a file at the top of the list.
    pub(crate) fn add(&mut self, path: &Path) {
        let Ok(path) = std::path::absolute(path) else { return };
        self.change(move |paths| add(paths, &path));
    }

    /// Takes a file out of the list.
    pub(crate) fn remove(&mut self, path: &Path) {
        let path = path.to_owned();
        self.change(move |paths| paths.retain(|other| *other != path));
    }

    /// Takes all files out of the list.
    pub(crate) fn clear(&mut self) {
        self.change(Vec::clear);
    }

    /// Changes the list here and in its file, which another window may have changed meanwhile.
    fn change(&mut self, change: impl Fn(&mut Vec<PathBuf>) + Send + 'static) {
        change(&mut self.paths);
        if let Some((file, thread)) = &self.kept {
            let file = file.clone();
            thread.run(move |()| {
                let mut paths = read(&file);
                change(&mut paths);
                write(&file, &paths);
            });
        }
    }
}

fn add(paths: &mut Vec<PathBuf>, path: &Path) {
    paths.retain(|other| other != path);
    paths.insert(0, path.to_owned());
    paths.truncate(MOST);
}

/// The list in a file; empty for a missing or damaged file.
fn read(file: &Path) -> Vec<PathBuf> {
    let text = read_text_limited(file, MAX_BYTES).unwrap_or_default();
    let list: List = toml::from_str(&text).unwrap_or_default();
    list.files.into_iter().take(MOST).map(PathBuf::from).collect()
}

/// Writes the list. A failure costs the user nothing but the list.
fn write(file: &Path, paths: &[PathBuf]) {
    let list = List { files: paths.iter().filter_map(|path| path.to_str().map(str::to_owned)).collect() };
    if let Ok(text) = toml::to_string_pretty(&list) {
        fs::create_dir_all(crate::file::folder(file)).and_then(|()| write_whole(file, text.as_bytes())).ok();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(names: &[&str]) -> Vec<PathBuf> {
        names.iter().map(|name| Path::new("/scenes").join(name)).collect()
    }

    #[test]
    fn the_newest_file_is_first_and_no_file_is_there_twice() {
        let mut recent = RecentFiles::default();
        named(&["a", "b", "a"]).iter().for_each(|path| recent.add(path));
        assert_eq!(recent.paths(), named(&["a", "b"]));
        (0..12).for_each(|k| recent.add(&Path::new("/scenes").join(k.to_string())));
        assert_eq!(recent.paths().len(), MOST);
        assert_eq!(recent.paths()[0], Path::new("/scenes/11"));
    }

    #[test]
    fn two_windows_share_the_list() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("new/recent.toml");
        let open = || {
            let mut recent = RecentFiles::default();
            recent.keep_in(file.clone());
            recent
        };
        let (mut first, mut second) = (open(), open());
        first.add(Path::new("/scenes/a"));
        drop(first);
        second.add(Path::new("/scenes/b"));
        drop(second);
        let mut third = open();
        assert_eq!(third.paths(), named(&["b", "a"]));
        third.remove(Path::new("/scenes/b"));
        drop(third);
        assert_eq!(open().paths(), named(&["a"]));
        fs::write(&file, "files = 3").unwrap();
        assert!(open().paths().is_empty(), "a damaged list");
    }
}
