//! Changes the camera and the film size that the window shows the scene with.

use super::state::Editor;
use crate::app::document::Edit;
use crate::app::viewpoint::{NamedView, REST, framed, of_objects, of_selection, seen_from};
use crate::geometry::Sphere;
use crate::scene::{Camera, Film};
use egui::Context;

impl Editor {
    /// The camera that the window shows the scene with.
    pub(crate) fn seen_camera(&self) -> Camera {
        self.viewpoint.seen().scene.camera
    }

    /// Shows the scene with this camera, under this name of the change: the window's own while the user looks around, else the document's. The changes of
    /// a gesture are one undo step.
    pub(crate) fn show_camera(&mut self, camera: Camera, name: &'static str) {
        if self.viewpoint.looks_around() {
            self.viewpoint.look(Some(camera));
        } else {
            self.document.edit(Edit::View(camera, name));
        }
    }

    /// Shows the view of this name, as an undo step of its own.
    pub(crate) fn show_view(&mut self, view: NamedView) {
        self.document.end_gesture();
        let camera = self.seen_camera();
        self.visited.rest(camera);
        let scene = self.document.scene();
        let found = match view {
            NamedView::Selection => self.frame(&of_selection(scene, &self.document.selection)),
            NamedView::All => self.frame(&of_objects(scene)),
            NamedView::From(side) => Some(seen_from(&camera, side)),
            NamedView::Own => self.document.saved_scene().map(|scene| scene.camera),
            NamedView::Previous => self.visited.back(),
            NamedView::Next => self.visited.forward(),
        };
        if let Some(camera) = found {
            self.show_camera(camera, view.name());
            self.document.end_gesture();
        }
    }

    /// The camera that shows these balls, or else all objects; `None`, with a message, where the scene has no extent.
    fn frame(&mut self, balls: &[Sphere]) -> Option<Camera> {
        let seen = &self.viewpoint.seen().scene;
        let aspect = f64::from(seen.film.width) / f64::from(seen.film.height);
        let framed = [balls, &of_objects(seen)].into_iter().find_map(|balls| framed(&seen.camera, aspect, balls));
        if framed.is_none() {
            self.toasts.info("Nothing to frame: the scene has no object with an extent");
        }
        self.canvas.show_all();
        framed
    }

    /// Starts to look around with a camera that only the window has, or shows the scene through its own camera again.
    pub(crate) fn toggle_look_around(&mut self) {
        let starts = !self.viewpoint.looks_around();
        self.viewpoint.look(starts.then(|| self.seen_camera()));
    }

    /// Makes the camera that the user looks around with the document's camera, as an undo step.
    pub(crate) fn use_view(&mut self) {
        let camera = self.seen_camera();
        self.viewpoint.look(None);
        self.document.end_gesture();
        self.document.edit(Edit::View(camera, "use view as camera"));
    }

    /// Reverts the drag in progress.
    pub(crate) fn cancel_drag(&mut self) {
        self.document.abandon_gesture();
        if self.viewpoint.looks_around() {
            self.viewpoint.look(Some(self.visited.present()));
        }
    }

    /// Gives the picture the size of the canvas in screen pixels once that size rests, or the document's size.
    pub(crate) fn match_window(&mut self, ctx: &Context) {
        let Some(transform) = self.canvas.transform else { return };
        // The sum of panels may miss a whole number of pixels by rounding.
        let pixels = transform.canvas.size() * ctx.pixels_per_point() + egui::Vec2::splat(0.01);
        let size = [pixels.x, pixels.y].map(|side| (side as u32).clamp(1, Film::MOST_PIXELS));
        let rests = self.canvas_size.note(size, ctx.input(|input| input.time));
        if !self.canvas.matches_window {
            self.viewpoint.resize(None);
        } else if rests {
            self.viewpoint.resize(Some(size));
        } else {
            ctx.request_repaint_after_secs(REST as f32);
        }
    }

    /// Ends the gesture: the next edit starts a new undo step, and the present view is one to come back to.
    pub(crate) fn end_gesture(&mut self) {
        self.document.end_gesture();
        self.visited.rest(self.seen_camera());
    }
}
