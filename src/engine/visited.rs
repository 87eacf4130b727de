//! Pictures of scenes that an edit left: undo shows them at once, and rendering goes on where it was.

use super::session::{Rendered, Session};
use crate::scene::{Scene, SceneFile};
use std::sync::Arc;

/// Iterations, as full ones, from which on a picture is worth its memory: one with fewer is rendered again in no time.
const LEAST_WEIGHT: f64 = 8.0;
/// Most pixels of all pictures together, each of which takes about 250 bytes.
const MOST_PIXELS: usize = 1 << 20;

/// The scenes that were left last, with what was rendered of them, from the oldest to the newest.
#[derive(Default)]
pub(super) struct Visited {
    scenes: Vec<(Arc<SceneFile>, Rendered)>,
}

impl Visited {
    /// Keeps what was rendered of a scene; forgets the oldest scenes where memory is short.
    pub(super) fn keep(&mut self, scene: Arc<SceneFile>, rendered: Rendered) {
        if rendered.weight() < LEAST_WEIGHT {
            return;
        }
        self.scenes.retain(|(known, _)| !is_same(known, &scene));
        self.scenes.push((scene, rendered));
        let mut pixels = 0;
        let newest = self.scenes.iter().rev().take_while(|(_, rendered)| {
            pixels += rendered.pixels();
            pixels <= MOST_PIXELS
        });
        let kept = newest.count();
        self.scenes.drain(..self.scenes.len() - kept);
    }

    /// The session, with what was rendered of its scene before if that was kept.
    pub(super) fn resumed(&mut self, scene: &SceneFile, session: Session) -> Session {
        match self.scenes.iter().position(|(known, _)| is_same(known, scene)) {
            Some(index) => session.with_rendered(self.scenes.remove(index).1),
            None => session,
        }
    }

    /// Forgets all scenes.
    pub(super) fn clear(&mut self) {
        self.scenes.clear();
    }
}

/// Whether two scenes differ at most in their title and in how the screen shows them.
fn is_same(a: &SceneFile, b: &SceneFile) -> bool {
    let shown_alike = || {
        let mut film = b.scene.film;
        (film.exposure, film.tone_curve) = (a.scene.film.exposure, a.scene.film.tone_curve);
        Scene { name: a.scene.name.clone(), film, ..b.scene.clone() }
    };
    a.location == b.location && a.scene == shown_alike()
}
