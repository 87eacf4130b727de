//! Light paths over the picture, traced off the UI thread.

use super::legend::legend_ui;
use super::paint::paint;
use super::request::Request;
use crate::app::canvas::stage::Stage;
use crate::scene::Scene;
use crate::transport::LightPaths;
use crate::world::World;
use crossbeam_channel::{Receiver, Sender, bounded};
use egui::{Context, Ui};

/// A finished request with the world in which its light was traced.
struct Done {
    request: Request,
    world: Option<World>,
    paths: LightPaths,
}

/// The light paths of the selected surface over the picture. They are kept until the scene, the selection or the camera changes.
pub(crate) struct LightPathLayer {
    pub(crate) on: bool,
    requested: Option<Request>,
    shown: Option<(Request, LightPaths)>,
    /// The last world, of which the next keeps what has not changed.
    world: Option<World>,
    busy: bool,
    done: (Sender<Done>, Receiver<Done>),
}

impl Default for LightPathLayer {
    fn default() -> Self {
        Self { on: false, requested: None, shown: None, world: None, busy: false, done: bounded(1) }
    }
}

impl std::fmt::Debug for LightPathLayer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("LightPathLayer").field("on", &self.on).finish_non_exhaustive()
    }
}

impl LightPathLayer {
    /// The light paths of the present request; `None` while they are traced, and where there are none.
    #[cfg(test)]
    pub(crate) fn shown(&self) -> Option<&LightPaths> {
        let (request, paths) = self.shown.as_ref()?;
        self.requested.as_ref().is_some_and(|requested| requested.is_same(request)).then_some(paths)
    }

    /// Shows the light paths of the selected surface, once they are traced. While a request is traced, the newest one waits. `seen` has the
    /// camera and the film of the picture.
    pub(in crate::app::canvas) fn show(&mut self, ui: &mut Ui, stage: &Stage<'_>, seen: &Scene) {
        if let Ok(Done { request, world, paths }) = self.done.1.try_recv() {
            self.busy = false;
            self.world = world.filter(|_| self.on);
            self.shown = Some((request, paths));
        }
        self.requested = None;
        if !self.on {
            (self.shown, self.world) = (None, None);
            return;
        }
        let canvas = stage.transform.canvas;
        let request = match Request::new(stage.document, seen) {
            Ok(request) => request,
            Err(message) => return legend_ui(ui, canvas, Some(message)),
        };
        if !self.busy && !self.shown.as_ref().is_some_and(|(shown, _)| shown.is_same(&request)) {
            self.busy = true;
            start(request.clone(), self.world.take(), self.done.0.clone(), ui.ctx().clone());
        }
        // During a drag the last paths stay until the next are traced.
        if let Some((_, paths)) = self.shown.as_ref().filter(|(shown, _)| shown.is_same_surface(&request)) {
            paint(&ui.painter_at(canvas), stage, paths);
            legend_ui(ui, canvas, paths.is_empty().then_some("No light shines straight on this surface"));
        }
        self.requested = Some(request);
    }
}

fn start(request: Request, previous: Option<World>, done: Sender<Done>, ctx: Context) {
    rayon::spawn(move || {
        let (world, paths) = request.trace(previous.as_ref());
        // One request at a time is traced, so the channel has room; it is closed only after the window.
        if done.try_send(Done { request, world, paths }).is_ok() {
            ctx.request_repaint();
        }
    });
}
