//! The scene as the window shows it: with the document's camera and film size, or with others that only the window has.

use crate::scene::{Camera, SceneFile};
use std::sync::Arc;

/// The scene as the window shows it.
#[derive(Debug)]
pub(crate) struct Viewpoint {
    document: Arc<SceneFile>,
    /// The window's own camera, while the user looks around.
    camera: Option<Camera>,
    /// The window's own film size, pixels, while the picture matches the window.
    film_size: Option<[u32; 2]>,
    seen: Arc<SceneFile>,
}

impl Viewpoint {
    /// Shows the document with its own camera and film size.
    pub(crate) fn new(document: &Arc<SceneFile>) -> Self {
        Self { document: Arc::clone(document), camera: None, film_size: None, seen: Arc::clone(document) }
    }

    /// The document's scene with the camera and the film size that the window shows.
    pub(crate) fn seen(&self) -> &Arc<SceneFile> {
        &self.seen
    }

    /// Whether the user looks around with a camera that only the window has.
    pub(crate) fn looks_around(&self) -> bool {
        self.camera.is_some()
    }

    /// Shows the present state of the document.
    pub(crate) fn follow(&mut self, document: &Arc<SceneFile>) {
        if !Arc::ptr_eq(&self.document, document) {
            self.document = Arc::clone(document);
            self.see();
        }
    }

    /// Looks around with this camera; with `None` through the document's camera again.
    pub(crate) fn look(&mut self, camera: Option<Camera>) {
        if self.camera != camera {
            self.camera = camera;
            self.see();
        }
    }

    /// Shows a film of this size, pixels; with `None` of the document's size again.
    pub(crate) fn resize(&mut self, film_size: Option<[u32; 2]>) {
        if self.film_size != film_size {
            self.film_size = film_size;
            self.see();
        }
    }

    fn see(&mut self) {
        self.seen = Arc::clone(&self.document);
        if self.camera.is_none() && self.film_size.is_none() {
            return;
        }
        let scene = &mut Arc::make_mut(&mut self.seen).scene;
        scene.camera = self.camera.unwrap_or(scene.camera);
        [scene.film.width, scene.film.height] = self.film_size.unwrap_or([scene.film.width, scene.film.height]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn the_windows_camera_and_film_size_replace_the_documents() {
        let document = Arc::new(SceneFile::built_in("cornell").unwrap());
        let mut viewpoint = Viewpoint::new(&document);
        assert!(Arc::ptr_eq(viewpoint.seen(), &document));
        let camera = Camera { position: DVec3::ONE, ..document.scene.camera };
        viewpoint.look(Some(camera));
        viewpoint.resize(Some([30, 20]));
        let seen = &viewpoint.seen().scene;
        assert_eq!((seen.camera, seen.film.width, seen.film.height), (camera, 30, 20));
        let mut edited = SceneFile::clone(&document);
        edited.scene.film.exposure = 2.0;
        viewpoint.follow(&Arc::new(edited));
        let seen = &viewpoint.seen().scene;
        assert_eq!((seen.camera, seen.film.width, seen.film.exposure), (camera, 30, 2.0));
        viewpoint.follow(&document);
        viewpoint.look(None);
        viewpoint.resize(None);
        assert!(Arc::ptr_eq(viewpoint.seen(), &document), "the document itself again");
    }

    #[test]
    fn without_a_change_the_scene_stays_the_same_object() {
        let document = Arc::new(SceneFile::built_in("cornell").unwrap());
        let mut viewpoint = Viewpoint::new(&document);
        viewpoint.resize(Some([30, 20]));
        let before = Arc::clone(viewpoint.seen());
        viewpoint.follow(&document);
        viewpoint.look(None);
        viewpoint.resize(Some([30, 20]));
        assert!(Arc::ptr_eq(viewpoint.seen(), &before), "so that it is validated once");
    }
}
