//! Writing the picture, off the UI thread.

use super::dialogs::Dialog;
use super::editor::Editor;
use crate::engine::Frame;
use crate::film::{ToneMap, write_exr, write_png};
use crate::scene::Film;
use crossbeam_channel::{Receiver, Sender, unbounded};
use egui::Context;
use std::path::{Path, PathBuf};
use std::sync::Arc;

type Written = (PathBuf, Result<(), String>);

/// The picture to be written and what became of those before.
pub(crate) struct Export {
    /// Where to write the next picture that is no draft.
    waiting: Option<PathBuf>,
    // One message for one click.
    done: (Sender<Written>, Receiver<Written>),
}

impl Default for Export {
    fn default() -> Self {
        Self { waiting: None, done: unbounded() }
    }
}

impl Export {
    /// The picture to come is of another scene.
    pub(crate) fn forget_waiting(&mut self) {
        self.waiting = None;
    }
}

impl Editor {
    /// Writes the picture as soon as it is no draft.
    pub(crate) fn start_export(&mut self, path: PathBuf) {
        if self.rendering.full_frame().is_none() {
            self.toasts.info("The picture is still a draft; it is written after its first iteration");
        }
        self.export.waiting = Some(path);
    }

    /// Goes on with what was asked for, says what was done.
    pub(crate) fn poll_export(&mut self, ctx: &Context) {
        if let Some(frame) = self.rendering.full_frame()
            && let Some(path) = self.export.waiting.take()
        {
            let (frame, film) = (Arc::clone(frame), self.document.scene().film);
            let (done, ctx) = (self.export.done.0.clone(), ctx.clone());
            rayon::spawn(move || {
                let written = write(&path, &frame, &film);
                // Closed only when the window is.
                done.send((path, written)).ok();
                ctx.request_repaint();
            });
        }
        while let Ok((path, written)) = self.export.done.1.try_recv() {
            match written {
                Ok(()) => {
                    self.toasts.success(format!("Exported {}", path.display()));
                }
                Err(error) => {
                    self.dialog = Some(Dialog::error(format!("{} was not written", path.display()), error));
                }
            }
        }
    }
}

fn write(path: &Path, frame: &Frame, film: &Film) -> Result<(), String> {
    let is_exr = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("exr"));
    let written = if is_exr {
        write_exr(path, &frame.image)
    } else {
        write_png(path, &frame.image, &ToneMap::new(film.exposure, film.tone_curve))
    };
    written.map_err(|error| error.to_string())
}
