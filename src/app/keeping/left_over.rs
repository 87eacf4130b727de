//! Unsaved changes of windows that ended without saving.

use super::slot::Slot;
use super::unsaved_copy::UnsavedCopy;
use crate::scene::Location;
use crossbeam_channel::{Receiver, bounded};
use egui::Context;
use std::cmp::Reverse;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// A file with unsaved changes, locked by this window.
struct LeftOver {
    slot: Slot,
    /// The time of the last write; `None` where the system does not tell.
    written: Option<SystemTime>,
    /// The changes, or why they cannot be read.
    content: Result<UnsavedCopy, String>,
}

/// What the user is told about unsaved changes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LeftOverRow {
    /// The name of the scene; for a damaged file, its path.
    pub(crate) name: String,
    /// When the changes were written, and the folder of the scene.
    pub(crate) details: String,
    /// Why the file cannot be read; `None` for changes that can be recovered.
    pub(crate) damage: Option<String>,
}

/// The unsaved changes that a window has found.
#[derive(Default)]
pub(crate) struct LeftOvers {
    search: Option<Receiver<Vec<LeftOver>>>,
    found: Vec<LeftOver>,
}

impl LeftOvers {
    /// Searches a folder on a thread of its own, because a scene may be large.
    pub(crate) fn search(&mut self, ctx: &Context, folder: PathBuf) {
        let (send, receive) = bounded(1);
        let ctx = ctx.clone();
        // Without a thread the changes wait for a later start.
        let started = std::thread::Builder::new().name("recovery".to_owned()).spawn(move || {
            // The receiver is gone if the window has closed meanwhile.
            send.send(find(&folder)).ok();
            ctx.request_repaint();
        });
        self.search = started.is_ok().then_some(receive);
    }

    /// Whether the search has ended since the last call, and found changes.
    pub(crate) fn poll(&mut self) -> bool {
        let Some(found) = self.search.as_ref().and_then(|search| search.try_recv().ok()) else { return false };
        self.search = None;
        self.found = found;
        !self.found.is_empty()
    }

    /// What the user is told, from the newest changes to the oldest.
    pub(crate) fn rows(&self) -> Vec<LeftOverRow> {
        let now = SystemTime::now();
        self.found.iter().map(|left_over| left_over.row(now)).collect()
    }

    /// Takes the changes at this place in the list; `None` for a damaged file, which stays in the list.
    pub(crate) fn take(&mut self, index: usize) -> Option<(Slot, UnsavedCopy)> {
        self.found.get(index).filter(|left_over| left_over.content.is_ok())?;
        let LeftOver { slot, content, .. } = self.found.remove(index);
        content.ok().map(|copy| (slot, copy))
    }

    /// Removes the file at this place in the list.
    pub(crate) fn discard(&mut self, index: usize) {
        if index < self.found.len() {
            self.found.remove(index).slot.remove();
        }
    }

    /// Leaves the files to a later window.
    pub(crate) fn release(&mut self) {
        self.found.clear();
    }
}

/// The changes in a folder, the newest first.
fn find(folder: &Path) -> Vec<LeftOver> {
    let read = |slot: Slot| {
        let written = fs::metadata(slot.path()).and_then(|metadata| metadata.modified()).ok();
        let content = UnsavedCopy::read(slot.path());
        LeftOver { slot, written, content }
    };
    let mut found: Vec<LeftOver> = Slot::of_ended_windows(folder).into_iter().map(read).collect();
    found.sort_by_key(|left_over| Reverse(left_over.written));
    found
}

impl LeftOver {
    fn row(&self, now: SystemTime) -> LeftOverRow {
        let age = self.written.and_then(|written| now.duration_since(written).ok()).unwrap_or_default();
        let changed = format!("changed {}", ago(age));
        let copy = match &self.content {
            Ok(copy) => copy,
            Err(damage) => {
                let name = self.slot.path().display().to_string();
                return LeftOverRow { name, details: changed, damage: Some(damage.clone()) };
            }
        };
        let (name, folder) = match &copy.file.location {
            Location::Disk(path) => (file_name(path), path.parent().map(Path::to_path_buf)),
            Location::BuiltIn(name) => (format!("example {name}"), None),
            Location::Unsaved => ("untitled".to_owned(), None),
        };
        let details = match folder {
            Some(folder) => format!("{changed}, in {}", folder.display()),
            None => changed,
        };
        LeftOverRow { name, details, damage: None }
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// How long ago something was, in words.
fn ago(age: Duration) -> String {
    let minutes = age.as_secs() / 60;
    let (count, unit) = match minutes {
        0 => return "less than a minute ago".to_owned(),
        1..60 => (minutes, "minute"),
        60..1440 => (minutes / 60, "hour"),
        _ => (minutes / 1440, "day"),
    };
    format!("{count} {unit}{} ago", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ages_are_words() {
        let words = [59, 60, 150, 3600, 86_399, 86_400, 900_000].map(|seconds| ago(Duration::from_secs(seconds)));
        let expected = ["less than a minute", "1 minute", "2 minutes", "1 hour", "23 hours", "1 day", "10 days"]
            .map(|age| format!("{age} ago"));
        assert_eq!(words, expected);
    }
}
