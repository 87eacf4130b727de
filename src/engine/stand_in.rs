//! The scene before an edit and its picture, which stands in for the light that the edit has hardly changed.

use super::draft::Before;
use super::session::{Rendered, Session};
use crate::film::LinearImage;
use crate::scene::SceneFile;
use crate::transport::DraftSize;
use crate::world::Camera;
use std::sync::Arc;

/// A scene before an edit, and its picture.
pub(super) struct StandIn {
    scene: Arc<SceneFile>,
    session: Session,
    image: Arc<LinearImage>,
    /// The iterations in the picture, as full ones.
    pub(super) weight: f64,
}

impl StandIn {
    /// The picture that the session of a scene has so far, or `smoothed`, which has less noise; and what the session has rendered.
    pub(super) fn new(scene: Arc<SceneFile>, session: Session, smoothed: Option<Arc<LinearImage>>) -> (Self, Rendered) {
        let (film, weight) = (session.film(), session.film().weight());
        let image = smoothed.unwrap_or_else(|| Arc::new(film.image()));
        let (session, rendered) = session.without_film();
        (Self { scene, image, weight, session }, rendered)
    }

    /// Whether the picture may stand in for one of this scene, whose camera has the film's grid: either the camera sees the scene from the
    /// same place, or nothing else is different.
    pub(super) fn fits(&self, scene: &SceneFile, camera: Camera) -> bool {
        let own = self.session.camera();
        let with_same_camera = || {
            let mut scene = scene.clone();
            scene.scene.camera = self.scene.scene.camera;
            scene == *self.scene
        };
        own == camera || ((own.width, own.height) == (camera.width, camera.height) && with_same_camera())
    }

    /// The picture, with a draft of its scene of this size; the draft is kept for the next call.
    pub(super) fn with_draft(&mut self, size: DraftSize) -> Option<Before<'_>> {
        let camera = self.session.camera();
        // Fails only if it is cancelled.
        let draft = self.session.whole_draft(size)?;
        Some(Before { image: &self.image, weight: self.weight, camera, draft })
    }
}
