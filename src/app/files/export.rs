//! Writing the picture and the surface, off the UI thread.

use super::chooser::Purpose;
use crate::app::editor::Editor;
use crate::app::shell::Dialog;
use crate::engine::Frame;
use crate::file::write_whole;
use crate::film::{ToneMap, write_exr, write_png};
use crate::scene::{Film, SurfaceExport, SurfaceFormat};
use crossbeam_channel::{Receiver, Sender, unbounded};
use egui::Context;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;

type Written = (Purpose, PathBuf, Result<(), String>);

/// The picture to be written and what became of what was written before.
pub(crate) struct Export {
    /// Where to write the next picture that is no draft.
    waiting: Option<PathBuf>,
    /// Quads along each side of a patch, in a mesh.
    pub(crate) steps: NonZeroUsize,
    // One message for one click.
    done: (Sender<Written>, Receiver<Written>),
}

impl Default for Export {
    fn default() -> Self {
        Self { waiting: None, steps: SurfaceExport::STEPS, done: unbounded() }
    }
}

impl Export {
    /// The picture to come is of another scene.
    pub(crate) fn forget_waiting(&mut self) {
        self.waiting = None;
    }

    fn spawn(
        &self,
        ctx: &Context,
        purpose: Purpose,
        path: PathBuf,
        write: impl FnOnce(&Path) -> Result<(), String> + Send + 'static,
    ) {
        let (done, ctx) = (self.done.0.clone(), ctx.clone());
        rayon::spawn(move || {
            let written = write(&path);
            // Closed only when the window is.
            done.send((purpose, path, written)).ok();
            ctx.request_repaint();
        });
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

    /// Asks how the surface is to be exported.
    pub(crate) fn ask_for_surface(&mut self) {
        match self.surface() {
            Some(surface) => self.dialog = Some(Dialog::Surface(surface.name, self.export.steps.get())),
            None => {
                self.toasts.warning("The scene has no Bezier object to export");
            }
        }
    }

    /// The selected Bezier object, or all of them.
    fn surface(&self) -> Option<SurfaceExport> {
        let scene = self.document.scene();
        let selected = self.document.selection.object(scene).and_then(|object| SurfaceExport::of([object]));
        selected.or_else(|| SurfaceExport::of(&scene.objects))
    }

    /// Writes the surface.
    pub(crate) fn export_surface(&self, ctx: &Context, path: PathBuf) {
        let (Some(surface), Some(format)) = (self.surface(), SurfaceFormat::of(&path)) else { return };
        let steps = self.export.steps;
        self.export.spawn(ctx, Purpose::ExportSurface, path, move |path| {
            write_whole(path, surface.text(format, steps).as_bytes())
                .map_err(|error| format!("{} cannot be written: {error}", path.display()))
        });
    }

    /// Goes on with what was asked for, says what was done.
    pub(crate) fn poll_export(&mut self, ctx: &Context) {
        if let Some(frame) = self.rendering.full_frame()
            && let Some(path) = self.export.waiting.take()
        {
            let (frame, film) = (Arc::clone(frame), self.document.scene().film);
            self.export.spawn(ctx, Purpose::ExportPicture, path, move |path| write(path, &frame, &film));
        }
        while let Ok((purpose, path, written)) = self.export.done.1.try_recv() {
            match written {
                Ok(()) => {
                    self.toasts.success(format!("Exported {}", path.display()));
                }
                Err(error) => self.ask_again(purpose, &path, error),
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
