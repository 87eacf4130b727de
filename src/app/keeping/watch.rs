//! Notices files that other programs change.

use crate::app::document::{Document, Stamp};
use crate::scene::SceneFile;
use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, unbounded};
use egui::Context;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

/// Time between two looks at the files.
const INTERVAL: Duration = Duration::from_millis(500);
/// Time between two attempts to open a changed scene that cannot be opened, while its files stay as they are.
const RETRY: Duration = Duration::from_secs(5);

/// The files of a document.
#[derive(Clone, Debug, Default, PartialEq)]
struct Watched {
    /// The scene's file, as the document knows it; `None` for a scene without a file.
    scene: Option<(PathBuf, Option<Stamp>)>,
    /// Textures and patches.
    others: Vec<PathBuf>,
}

impl Watched {
    fn of(document: &Document) -> Self {
        let scene = document.path().map(|path| (path.to_owned(), document.stamp()));
        Self { scene, others: document.file().files() }
    }

    fn is_empty(&self) -> bool {
        self.scene.is_none() && self.others.is_empty()
    }
}

/// A change that another program made.
#[derive(Debug)]
pub(crate) struct OutsideChange {
    /// The scene's file with its present stamp, and the scene in it or why it cannot be opened; `None` for a scene without a file.
    pub(crate) scene: Option<(PathBuf, Option<Stamp>, Result<SceneFile, String>)>,
    /// The changed textures and patches.
    pub(crate) others: Vec<PathBuf>,
    /// The scene's file, if it is gone.
    pub(crate) removed: Option<PathBuf>,
}

/// Looks at the files of a document on a thread of its own, which only wakes the window for a change.
#[derive(Default)]
pub(crate) struct Watch {
    seen: Option<(Arc<SceneFile>, Option<Stamp>)>,
    watched: Watched,
    thread: Option<(Sender<Watched>, Receiver<OutsideChange>)>,
}

impl Watch {
    /// Follows the document. Call it once a frame.
    pub(crate) fn update(&mut self, ctx: &Context, document: &Document) {
        let (file, stamp) = (document.file(), document.stamp());
        if self.seen.as_ref().is_some_and(|(seen, known)| Arc::ptr_eq(seen, file) && *known == stamp) {
            return;
        }
        self.seen = Some((Arc::clone(file), stamp));
        let watched = Watched::of(document);
        if watched == self.watched || (self.thread.is_none() && watched.is_empty()) {
            return;
        }
        self.watched = watched.clone();
        if self.thread.is_none() {
            self.thread = start(ctx.clone());
        }
        if let Some((lists, _)) = &self.thread {
            // The thread ends with the window only.
            lists.send(watched).ok();
        }
    }

    /// The next change that was noticed; `None` without one.
    pub(crate) fn next(&self) -> Option<OutsideChange> {
        self.thread.as_ref()?.1.try_recv().ok()
    }
}

/// Starts the thread, which ends when its list of files has no sender any more. `None` where the system gives no thread: then changes are
/// noticed at the next save.
fn start(ctx: Context) -> Option<(Sender<Watched>, Receiver<OutsideChange>)> {
    let (send_list, lists) = unbounded();
    let (send_change, changes) = unbounded();
    let look = move || {
        let mut looker = Looker::default();
        let mut next = Instant::now() + INTERVAL;
        loop {
            match lists.recv_deadline(next) {
                Ok(watched) => looker.watch(watched),
                Err(RecvTimeoutError::Disconnected) => return,
                Err(RecvTimeoutError::Timeout) => {
                    if let Some(change) = looker.look(Instant::now()) {
                        // The window may close meanwhile.
                        send_change.send(change).ok();
                        ctx.request_repaint();
                    }
                    next = Instant::now() + INTERVAL;
                }
            }
        }
    };
    thread::Builder::new().name("watch".to_owned()).spawn(look).ok().map(|_| (send_list, changes))
}

/// The stamps of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen {
    /// The stamp that the window knows.
    known: Option<Stamp>,
    /// The stamp at the last look.
    last: Option<Stamp>,
}

/// What the thread knows of the files.
#[derive(Default)]
struct Looker {
    watched: Watched,
    files: BTreeMap<PathBuf, Seen>,
    /// The files at the last attempt that failed, and its time.
    failed: Option<(BTreeMap<PathBuf, Seen>, Instant)>,
}

impl Looker {
    fn watch(&mut self, watched: Watched) {
        let before = std::mem::take(&mut self.files);
        for path in &watched.others {
            let present = || Stamp::of(path);
            let seen = before.get(path).copied().unwrap_or_else(|| Seen { known: present(), last: present() });
            self.files.insert(path.clone(), seen);
        }
        if let Some((path, known)) = &watched.scene {
            self.files.insert(path.clone(), Seen { known: *known, last: *known });
        }
        self.failed = None;
        self.watched = watched;
    }

    /// The change since the last look. A file counts as changed once two looks see it alike: before, a program may still write it.
    fn look(&mut self, now: Instant) -> Option<OutsideChange> {
        if let removed @ Some(_) = self.removed_scene() {
            return Some(OutsideChange { scene: None, others: Vec::new(), removed });
        }
        let mut changed = Vec::new();
        for (path, seen) in &mut self.files {
            let present = Stamp::of(path);
            if present.is_some() && present != seen.known && present == seen.last {
                changed.push(path.clone());
            }
            seen.last = present;
        }
        if changed.is_empty()
            || self.failed.as_ref().is_some_and(|(at, since)| *at == self.files && now < *since + RETRY)
        {
            return None;
        }
        let scene = self.watched.scene.as_ref().map(|(path, _)| {
            let stamp = self.files.get(path).and_then(|seen| seen.last);
            (path.clone(), stamp, SceneFile::open(path).map_err(|error| error.to_string()))
        });
        self.failed = None;
        if matches!(scene, Some((.., Err(_)))) {
            self.failed = Some((self.files.clone(), now));
        } else {
            for path in &changed {
                self.files.entry(path.clone()).and_modify(|seen| seen.known = seen.last);
            }
        }
        changed.retain(|path| self.watched.others.contains(path));
        Some(OutsideChange { scene, others: changed, removed: None })
    }

    /// The scene's file, once when two looks miss it: a program may delete a file just before it writes the file anew.
    fn removed_scene(&mut self) -> Option<PathBuf> {
        let (path, _) = self.watched.scene.as_ref()?;
        let seen = self.files.get_mut(path)?;
        let is_gone = seen.known.is_some() && seen.last.is_none() && Stamp::of(path).is_none();
        is_gone.then(|| {
            seen.known = None;
            path.clone()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_change_counts_once_and_when_it_is_complete() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("room.toml");
        let mut file = SceneFile::built_in("cornell").unwrap();
        file.save(&path).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let mut looker = Looker::default();
        looker.watch(Watched { scene: Some((path.clone(), Stamp::of(&path))), others: Vec::new() });
        let now = Instant::now();
        assert!(looker.look(now).is_none(), "unchanged");

        fs::write(&path, &text[..text.len() / 2]).unwrap();
        assert!(looker.look(now).is_none(), "it may still be written");
        let opened = |change: Option<OutsideChange>| change.and_then(|change| change.scene).map(|(.., scene)| scene);
        assert!(opened(looker.look(now)).unwrap().is_err(), "a half of the text");
        assert!(looker.look(now).is_none(), "told once");
        assert!(opened(looker.look(now + RETRY)).unwrap().is_err(), "tried again");

        let changed = text.replace("exposure = ", "exposure = 1");
        fs::write(&path, &changed).unwrap();
        assert!(looker.look(now).is_none());
        assert_eq!(opened(looker.look(now)).unwrap().unwrap(), SceneFile::open(&path).unwrap());
        assert!(looker.look(now).is_none(), "told once");
        fs::remove_file(&path).unwrap();
        assert!(looker.look(now).is_none(), "it may be written anew");
        assert_eq!(looker.look(now).and_then(|change| change.removed), Some(path.clone()));
        assert!(looker.look(now).is_none(), "told once");
        fs::write(&path, &changed).unwrap();
        assert!(looker.look(now).is_none());
        assert!(opened(looker.look(now)).is_some(), "it is back");
    }

    #[test]
    fn a_changed_texture_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let texture = folder.path().join("wood.png");
        fs::write(&texture, "a").unwrap();
        let mut looker = Looker::default();
        looker.watch(Watched { scene: None, others: vec![texture.clone()] });
        fs::write(&texture, "ab").unwrap();
        assert!(looker.look(Instant::now()).is_none());
        let change = looker.look(Instant::now()).unwrap();
        assert_eq!((change.scene.is_none(), change.others), (true, vec![texture]));
        assert!(looker.look(Instant::now()).is_none());
    }
}
