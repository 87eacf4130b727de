//! Writes unsaved changes to a file soon after an edit.

use super::background::Background;
use super::slot::Slot;
use super::unsaved_copy::UnsavedCopy;
use crate::app::document::Document;
use crate::scene::SceneFile;
use crossbeam_channel::{Receiver, Sender, unbounded};
use egui::Context;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// When changes are written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace {
    /// After this time without a further edit.
    pub(crate) rest: Duration,
    /// At the latest after this time, while edits go on.
    pub(crate) most: Duration,
}

impl Pace {
    /// The usual pace.
    const USUAL: Self = Self { rest: Duration::from_secs(2), most: Duration::from_secs(10) };

    /// The time from `now` until changes are written, of which the first and the last one were made at these times.
    fn wait(self, first: Instant, last: Instant, now: Instant) -> Duration {
        (last + self.rest).min(first + self.most).saturating_duration_since(now)
    }
}

/// Whether a write has worked, or why not.
type Written = Result<(), String>;

/// The file with the unsaved changes of a window.
pub(crate) struct Autosave {
    /// The folder of the file; `None` to write nothing.
    folder: Option<PathBuf>,
    pub(crate) pace: Pace,
    /// The state of the scene at the last call of [`Autosave::update`].
    seen: Option<Arc<SceneFile>>,
    /// The times of the first and of the last change that the file lacks.
    changed: Option<(Instant, Instant)>,
    is_writing: bool,
    /// Whether there is a file, or will be.
    is_kept: bool,
    /// Whether the last write failed.
    has_failed: bool,
    thread: Option<Background<Option<Slot>>>,
    done: (Sender<Written>, Receiver<Written>),
}

impl Default for Autosave {
    fn default() -> Self {
        Self {
            folder: None,
            pace: Pace::USUAL,
            seen: None,
            changed: None,
            is_writing: false,
            is_kept: false,
            has_failed: false,
            thread: None,
            done: unbounded(),
        }
    }
}

impl Autosave {
    /// Writes unsaved changes to a file in this folder from now on.
    pub(crate) fn keep_in(&mut self, folder: PathBuf) {
        self.folder = Some(folder);
    }

    /// Writes the unsaved changes of the document if it is time, or removes the file if there are none. Call it once a frame. Returns a
    /// message at the first of several failures.
    pub(crate) fn update(&mut self, ctx: &Context, document: &Document, now: Instant) -> Option<String> {
        self.folder.as_ref()?;
        let failure = self.done.1.try_iter().last().and_then(|result| self.written(result, now));
        if document.is_dirty() {
            self.notice(document.file(), now);
            self.write_in_time(ctx, document, now);
        } else {
            self.forget();
            self.seen = Some(Arc::clone(document.file()));
        }
        failure
    }

    /// Whether changes wait to be written, or are being written.
    #[cfg(test)]
    pub(crate) fn is_busy(&self) -> bool {
        self.is_writing || self.changed.is_some()
    }

    /// Removes the file: the changes are saved or discarded.
    pub(crate) fn forget(&mut self) {
        self.changed = None;
        if std::mem::take(&mut self.is_kept) {
            self.thread().run(|slot| slot.take().into_iter().for_each(Slot::remove));
        }
    }

    /// Removes the file for good: the window closes.
    pub(crate) fn end(&mut self) {
        self.forget();
        self.folder = None;
    }

    /// Takes over a file of a window that has ended, which holds the changes in `file`.
    pub(crate) fn adopt(&mut self, slot: Slot, file: &Arc<SceneFile>) {
        self.changed = None;
        self.is_kept = true;
        self.seen = Some(Arc::clone(file));
        self.thread().run(|own| own.replace(slot).into_iter().for_each(Slot::remove));
    }

    fn thread(&mut self) -> &Background<Option<Slot>> {
        self.thread.get_or_insert_with(|| Background::new("autosave", None))
    }

    fn notice(&mut self, file: &Arc<SceneFile>, now: Instant) {
        if !self.seen.as_ref().is_some_and(|seen| Arc::ptr_eq(seen, file)) {
            self.seen = Some(Arc::clone(file));
            self.changed = Some((self.changed.map_or(now, |(first, _)| first), now));
        }
    }

    fn write_in_time(&mut self, ctx: &Context, document: &Document, now: Instant) {
        let Some((first, last)) = self.changed.filter(|_| !self.is_writing) else { return };
        let wait = self.pace.wait(first, last, now);
        if !wait.is_zero() {
            return ctx.request_repaint_after(wait);
        }
        let Some(folder) = self.folder.clone() else { return };
        (self.changed, self.is_writing, self.is_kept) = (None, true, true);
        let name = document.title();
        let copy = UnsavedCopy { file: SceneFile::clone(document.file()), stamp: document.stamp() };
        let (done, ctx) = (self.done.0.clone(), ctx.clone());
        self.thread().run(move |slot| {
            // The channel is closed only after the window.
            done.send(write(slot, &folder, name.trim_start_matches('*'), &copy)).ok();
            ctx.request_repaint();
        });
    }

    /// Ends a write. After a failure the changes are written again in time.
    fn written(&mut self, result: Written, now: Instant) -> Option<String> {
        self.is_writing = false;
        let is_first = result.is_err() && !self.has_failed;
        self.has_failed = result.is_err();
        if self.has_failed {
            self.changed.get_or_insert((now, now));
        }
        result.err().filter(|_| is_first)
    }
}

/// Writes the copy to the window's file, which is created where it is missing.
fn write(slot: &mut Option<Slot>, folder: &Path, name: &str, copy: &UnsavedCopy) -> Written {
    let text = copy.text()?;
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let kept = match slot {
        Some(kept) => kept,
        None => slot.insert(Slot::create(folder, name.trim_end_matches(".toml")).map_err(failed)?),
    };
    kept.write(&text).map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_written_after_a_rest_or_while_edits_go_on() {
        let start = Instant::now();
        let at = |seconds| start + Duration::from_secs(seconds);
        let wait = |first, last, now| Pace::USUAL.wait(at(first), at(last), at(now)).as_secs();
        assert_eq!(wait(0, 0, 0), 2, "after one edit");
        assert_eq!(wait(0, 5, 6), 1, "after several edits");
        assert_eq!(wait(0, 9, 9), 1, "ten seconds after the first edit");
        assert_eq!(wait(0, 30, 30), 0, "late");
    }
}
