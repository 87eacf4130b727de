//! Writing of pictures and surfaces, off the UI thread.

use crate::app::commands::Purpose;
use crate::app::document::Document;
use crate::engine::{EngineSettings, Frame, provenance};
use crate::file::write_whole;
use crate::film::{LinearImage, PngDepth, Provenance, ToneMap, write_exr, write_png};
use crate::scene::{Film, SceneFile, SurfaceExport, SurfaceFormat, SurfaceOptions};
use crate::transport::Component;
use crossbeam_channel::{Receiver, Sender, unbounded};
use egui::Context;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file that was exported, or the reason why it could not be.
pub(crate) struct Exported {
    pub(crate) purpose: Purpose,
    pub(crate) path: PathBuf,
    pub(crate) result: Result<(), String>,
}

/// The exports in progress.
pub(crate) struct Export {
    /// The purpose and the path of a requested picture, which waits for the first frame that is no draft.
    waiting: Option<(Purpose, PathBuf)>,
    /// How surfaces are written.
    pub(crate) surface_options: SurfaceOptions,
    // Each click sends at most one message.
    done: (Sender<Exported>, Receiver<Exported>),
}

impl Default for Export {
    fn default() -> Self {
        Self { waiting: None, surface_options: SurfaceOptions::default(), done: unbounded() }
    }
}

impl Export {
    /// Writes the picture to `path` once a frame is no draft: as it is, or for [`Purpose::ExportShown`] as the screen shows it.
    pub(crate) fn request_picture(&mut self, purpose: Purpose, path: PathBuf) {
        self.waiting = Some((purpose, path));
    }

    /// Drops the requested picture, because the next frames show another scene.
    pub(crate) fn cancel_picture(&mut self) {
        self.waiting = None;
    }

    /// Writes the surface to `path`, in the format of the path's extension; writes no file for an unknown extension.
    pub(crate) fn write_surface(&self, ctx: &Context, surface: SurfaceExport, path: PathBuf) {
        let Some(format) = SurfaceFormat::of(&path) else { return };
        let options = self.surface_options;
        self.spawn(ctx, Purpose::ExportSurface, path, move |path| {
            write_whole(path, &surface.bytes(format, options))
                .map_err(|error| format!("{} cannot be written: {error}", path.display()))
        });
    }

    /// Writes a text to `path`.
    pub(crate) fn write_text(&self, ctx: &Context, purpose: Purpose, text: String, path: PathBuf) {
        self.spawn(ctx, purpose, path, move |path| {
            write_whole(path, text.as_bytes()).map_err(|error| format!("{} cannot be written: {error}", path.display()))
        });
    }

    /// Writes the requested picture if `frame`, the newest frame that is no draft, exists. Returns the exports that have
    /// finished since the last call. `seen` is the scene that the window shows, with one component of the light or all.
    pub(crate) fn poll(
        &mut self,
        ctx: &Context,
        frame: Option<&Arc<Frame>>,
        seen: &Arc<SceneFile>,
        only: Option<Component>,
    ) -> Vec<Exported> {
        if let Some(frame) = frame
            && let Some((purpose, path)) = self.waiting.take()
        {
            let image = Arc::clone(if purpose == Purpose::ExportShown { frame.shown() } else { &frame.image });
            let (frame, seen) = (Arc::clone(frame), Arc::clone(seen));
            self.spawn(ctx, purpose, path, move |path| {
                let depth = if purpose == Purpose::ExportDeep { PngDepth::Sixteen } else { PngDepth::Eight };
                write_picture(
                    path,
                    &image,
                    &seen.scene.film,
                    depth,
                    &provenance(&seen, EngineSettings::default().seed, only, &frame.stats),
                )
            });
        }
        self.done.1.try_iter().collect()
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
            let result = write(&path);
            // The channel is closed only after the window.
            done.send(Exported { purpose, path, result }).ok();
            ctx.request_repaint();
        });
    }
}

/// The selected Bezier object as a surface to export, or else all Bezier objects; `None` in a scene without any.
pub(crate) fn surface_of(document: &Document) -> Option<SurfaceExport> {
    let scene = document.scene();
    let selected = document.selection.object(scene).and_then(|object| SurfaceExport::of([object]));
    selected.or_else(|| SurfaceExport::of(&scene.objects))
}

fn write_picture(
    path: &Path,
    image: &LinearImage,
    film: &Film,
    depth: PngDepth,
    provenance: &Provenance,
) -> Result<(), String> {
    let is_exr = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("exr"));
    let written = if is_exr {
        write_exr(path, image, provenance)
    } else {
        write_png(path, image, &ToneMap::new(film.exposure, film.tone_curve), depth, provenance)
    };
    written.map_err(|error| error.to_string())
}
