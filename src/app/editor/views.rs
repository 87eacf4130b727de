//! Changes the camera that the window shows the scene with.

use super::state::Editor;
use crate::app::document::Edit;
use crate::app::viewpoint::{NamedView, framed, of_objects, of_selection, seen_from};
use crate::geometry::Sphere;
use crate::scene::Camera;

impl Editor {
    /// Shows the scene with this camera. The changes of a gesture are one undo step.
    pub(crate) fn show_camera(&mut self, camera: Camera) {
        self.document.edit(Edit::View(camera));
    }

    /// Shows the view of this name, as an undo step of its own.
    pub(crate) fn show_view(&mut self, view: NamedView) {
        self.document.end_gesture();
        self.visited.rest(self.document.scene().camera);
        let (scene, camera) = (self.document.scene(), self.document.scene().camera);
        let found = match view {
            NamedView::Selection => self.frame(&of_selection(scene, &self.document.selection)),
            NamedView::All => self.frame(&of_objects(scene)),
            NamedView::From(side) => Some(seen_from(&camera, side)),
            NamedView::Own => self.document.saved_scene().map(|scene| scene.camera),
            NamedView::Previous => self.visited.back(),
            NamedView::Next => self.visited.forward(),
        };
        if let Some(camera) = found {
            self.show_camera(camera);
            self.document.end_gesture();
        }
    }

    /// The camera that shows these balls, or else all objects; `None`, with a message, where the scene has no extent.
    fn frame(&mut self, balls: &[Sphere]) -> Option<Camera> {
        let scene = self.document.scene();
        let aspect = f64::from(scene.film.width) / f64::from(scene.film.height);
        let framed = [balls, &of_objects(scene)].into_iter().find_map(|balls| framed(&scene.camera, aspect, balls));
        if framed.is_none() {
            self.toasts.info("Nothing to frame: the scene has no object with an extent");
        }
        self.canvas.show_all();
        framed
    }
}
