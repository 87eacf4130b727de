//! New objects and lights, where the camera looks.

use super::state::Editor;
use crate::app::canvas::{Aim, free_ball};
use crate::app::document::{Edit, NewItem, new_items};
use crate::app::shell::Dialog;
use crate::geometry::Sphere;
use std::path::Path;

impl Editor {
    /// Adds an object or a light where the camera looks.
    pub(super) fn add(&mut self, new: NewItem) {
        let room = self.room(if new.is_light() { Aim::Above } else { Aim::Middle });
        let eye = self.viewpoint.seen().scene.camera.position;
        self.document.edit(new.added(self.document.scene(), &room, eye));
    }

    /// Adds the patches of a file where the camera looks.
    pub(super) fn add_surface(&mut self, path: &Path) {
        let room = self.room(Aim::Middle);
        match new_items::surface(self.document.scene(), path, &room) {
            Ok(object) => self.document.edit(Edit::AddObject(object)),
            Err(error) => self.dialog = Some(Dialog::Error("The patches cannot be added".to_owned(), error)),
        }
    }

    /// A free ball in the picture, in front of what is seen there.
    fn room(&mut self, aim: Aim) -> Sphere {
        self.canvas.sight.surfaces.update(self.document.file());
        free_ball(&self.viewpoint.seen().scene, &self.canvas.sight.surfaces, aim)
    }
}
