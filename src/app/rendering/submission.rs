//! The scene that the engine renders, and the problems that keep a scene from it.

use super::same_picture::same_picture;
use crate::scene::{Problem, SceneFile, validate};
use std::sync::Arc;

/// The scene that was validated last, and the scene that was sent to the engine last.
#[derive(Debug, Default)]
pub(crate) struct Submission {
    validated: Option<Arc<SceneFile>>,
    sent: Option<Arc<SceneFile>>,
    /// The scene that was sent last, with the names that it had then.
    named: Option<Arc<SceneFile>>,
    problems: Vec<Problem>,
}

impl Submission {
    /// Validates a changed scene. Returns the scene to send to the engine; `None` while the scene has problems, and where
    /// its picture equals the picture of the scene that was sent last.
    pub(crate) fn update(&mut self, file: &Arc<SceneFile>) -> Option<Arc<SceneFile>> {
        if self.validated.as_ref().is_some_and(|validated| Arc::ptr_eq(validated, file)) {
            return None;
        }
        self.validated = Some(Arc::clone(file));
        self.problems = validate(&file.scene);
        if !self.problems.is_empty() || self.is_sent(file) {
            return None;
        }
        self.sent = Some(Arc::clone(file));
        self.named = self.sent.clone();
        self.sent.clone()
    }

    /// Whether the scene that was sent last has the picture of `file`.
    pub(crate) fn is_sent(&self, file: &SceneFile) -> bool {
        self.sent.as_ref().is_some_and(|sent| same_picture(sent, file))
    }

    /// The scene with the names that the engine knows; `None` before the first one.
    pub(crate) fn named(&self) -> Option<&SceneFile> {
        self.named.as_deref()
    }

    /// Takes `file` as the scene that was sent last: saving changed its location and file paths, but not its picture.
    pub(crate) fn relocate(&mut self, file: &Arc<SceneFile>) {
        self.sent = Some(Arc::clone(file));
    }

    /// The problems of the scene that was validated last; the engine cannot render a scene with problems.
    pub(crate) fn problems(&self) -> &[Problem] {
        &self.problems
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(file: &Arc<SceneFile>, change: impl FnOnce(&mut SceneFile)) -> Arc<SceneFile> {
        let mut file = SceneFile::clone(file);
        change(&mut file);
        Arc::new(file)
    }

    #[test]
    fn only_scenes_with_another_picture_are_sent() {
        let mut submission = Submission::default();
        let cornell = Arc::new(SceneFile::built_in("cornell").unwrap());
        assert_eq!(submission.update(&cornell), Some(Arc::clone(&cornell)), "the first scene");
        assert_eq!(submission.update(&cornell), None, "an unchanged scene");
        assert_eq!(submission.update(&changed(&cornell, |file| file.scene.film.exposure = 1.0)), None, "exposure");
        let moved = changed(&cornell, |file| file.scene.camera.position.z += 0.1);
        assert_eq!(submission.update(&moved), Some(moved), "another camera");
    }

    #[test]
    fn a_scene_with_problems_is_not_sent() {
        let mut submission = Submission::default();
        let cornell = Arc::new(SceneFile::built_in("cornell").unwrap());
        assert_eq!(submission.update(&changed(&cornell, |file| file.scene.camera.fov_y = 0.0)), None);
        assert!(!submission.problems().is_empty(), "an angle of view of zero is a problem");
        assert!(submission.update(&cornell).is_some(), "the repaired scene");
        assert!(submission.problems().is_empty(), "the repaired scene has no problems");
    }
}
