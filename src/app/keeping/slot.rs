//! A file for the unsaved changes of a window, locked while the window runs.

use crate::file::write_whole;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// The extension of files with unsaved changes.
const EXTENSION: &str = "toml";
/// The extension of the lock beside such a file. The file itself is replaced at each write, so a lock on it would get lost.
const LOCK: &str = "lock";
/// Most letters of a scene's name in the name of a file.
const LONGEST_NAME: usize = 40;

/// The place of a file with unsaved changes, and the lock that keeps other windows from taking the file. The system releases the lock when
/// the program ends, however it ends.
#[derive(Debug)]
pub(crate) struct Slot {
    path: PathBuf,
    _lock: File,
}

impl Slot {
    /// A new place in `folder`, which is created where it is missing. The file's name begins with `name`.
    ///
    /// # Errors
    /// If the folder cannot be written to.
    pub(super) fn create(folder: &Path, name: &str) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        let plain = |c: char| if c.is_alphanumeric() || c == '-' { c } else { '_' };
        let prefix: String = name.chars().take(LONGEST_NAME).map(plain).chain(['-']).collect();
        let suffix = format!(".{LOCK}");
        let (lock, path) = tempfile::Builder::new().prefix(&prefix).suffix(&suffix).tempfile_in(folder)?.keep()?;
        // Where the file system has no locks, a later window offers the changes of a window that still runs.
        lock.try_lock().ok();
        Ok(Self { path: path.with_extension(EXTENSION), _lock: lock })
    }

    /// The files with unsaved changes in `folder` whose windows have ended, locked for the caller.
    pub(super) fn of_ended_windows(folder: &Path) -> Vec<Self> {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
        entries.filter(|path| path.extension().is_some_and(|e| e == EXTENSION)).filter_map(Self::claim).collect()
    }

    /// Locks the file; `None` where a running window holds the lock, or the file is gone.
    fn claim(path: PathBuf) -> Option<Self> {
        let lock_path = path.with_extension(LOCK);
        let lock = OpenOptions::new().create(true).truncate(false).write(true).open(&lock_path).ok()?;
        if matches!(lock.try_lock(), Err(TryLockError::WouldBlock)) {
            return None;
        }
        if !path.exists() {
            // Another window has removed both files meanwhile.
            fs::remove_file(&lock_path).ok();
            return None;
        }
        Some(Self { path, _lock: lock })
    }

    /// The path of the file.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Replaces the content of the file, whole or not at all.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub(super) fn write(&self, text: &str) -> io::Result<()> {
        write_whole(&self.path, text.as_bytes())
    }

    /// Removes the file and its lock.
    pub(super) fn remove(self) {
        // What cannot be removed is offered at the next start.
        fs::remove_file(&self.path).ok();
        fs::remove_file(self.path.with_extension(LOCK)).ok();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_belongs_to_one_window_until_its_end() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path().join("new/folder");
        let slot = Slot::create(&folder, "a/b c.toml").unwrap();
        assert!(Slot::of_ended_windows(&folder).is_empty(), "nothing was written");
        slot.write("text").unwrap();
        assert!(Slot::of_ended_windows(&folder).is_empty(), "the window runs");
        drop(slot);
        let claimed = Slot::of_ended_windows(&folder);
        assert_eq!(claimed.len(), 1, "the window has ended");
        assert_eq!(fs::read_to_string(claimed[0].path()).unwrap(), "text");
        assert!(Slot::of_ended_windows(&folder).is_empty(), "another window has claimed it");
        claimed.into_iter().for_each(Slot::remove);
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 0, "nothing is left");
    }

    #[test]
    fn a_lost_lock_file_hides_nothing() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("room-1.toml"), "text").unwrap();
        assert_eq!(Slot::of_ended_windows(folder.path()).len(), 1);
    }
}
