//! The scene that is edited, what is selected in it, and the way back.

use super::edit::{Edit, EditKey};
use super::history::History;
use super::selection::Selection;
use crate::scene::{Location, Scene, SceneFile};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The scene that is edited. Nothing but [`Document::edit`], [`Document::undo`] and [`Document::redo`] changes it.
#[derive(Debug)]
pub(crate) struct Document {
    file: Arc<SceneFile>,
    saved: Arc<SceneFile>,
    /// Where it is saved; `None` for what was never saved and for what the program carries with it.
    path: Option<PathBuf>,
    /// What the panels and the canvas talk about.
    pub(crate) selection: Selection,
    history: History<(Arc<SceneFile>, Selection), EditKey>,
}

impl Document {
    /// A scene as it was opened.
    pub(crate) fn new(file: SceneFile) -> Self {
        let path = match &file.location {
            Location::Disk(path) => Some(path.clone()),
            Location::BuiltIn(_) | Location::Unsaved => None,
        };
        let selection = Selection::first_of(&file.scene);
        let file = Arc::new(file);
        Self { saved: Arc::clone(&file), file, path, selection, history: History::default() }
    }

    /// The scene as it is now.
    pub(crate) fn scene(&self) -> &Scene {
        &self.file.scene
    }

    /// The scene with the place that its paths are relative to.
    pub(crate) fn file(&self) -> &Arc<SceneFile> {
        &self.file
    }

    /// Where it is saved, if it is a file.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Whether there is something to lose.
    pub(crate) fn is_dirty(&self) -> bool {
        !Arc::ptr_eq(&self.file, &self.saved) && self.file != self.saved
    }

    /// For the title bar.
    pub(crate) fn title(&self) -> String {
        let file = self.path.as_deref().and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
        let name = file.unwrap_or_else(|| match &self.file.location {
            Location::BuiltIn(name) => name.clone(),
            _ => "untitled".to_owned(),
        });
        format!("{}{name}", if self.is_dirty() { "*" } else { "" })
    }

    /// Changes the scene; within a gesture, edits of one key are one step to undo.
    pub(crate) fn edit(&mut self, edit: Edit) {
        let key = edit.key();
        let mut scene = self.file.scene.clone();
        edit.apply(&mut scene);
        if scene == self.file.scene {
            return;
        }
        self.history.record((Arc::clone(&self.file), self.selection.clone()), key);
        self.file = Arc::new(SceneFile { scene, location: self.file.location.clone() });
        self.selection = std::mem::take(&mut self.selection).within(&self.file.scene);
    }

    /// The next edit is a step of its own.
    pub(crate) fn end_gesture(&mut self) {
        self.history.end_gesture();
    }

    /// Takes back the edits of the gesture that goes on.
    pub(crate) fn abandon_gesture(&mut self) {
        let present = (Arc::clone(&self.file), self.selection.clone());
        (self.file, self.selection) = self.history.abandon_gesture(present).unwrap_or_else(|present| present);
    }

    /// What undo takes back, in words.
    pub(crate) fn undoable(&self) -> Option<&'static str> {
        self.history.undoable().map(|(label, _)| label)
    }

    /// What redo does again, in words.
    pub(crate) fn redoable(&self) -> Option<&'static str> {
        self.history.redoable().map(|(label, _)| label)
    }

    /// One step back, if there is one.
    pub(crate) fn undo(&mut self) {
        let present = (Arc::clone(&self.file), self.selection.clone());
        (self.file, self.selection) = self.history.undo(present).unwrap_or_else(|present| present);
    }

    /// One step forward, if there is one.
    pub(crate) fn redo(&mut self) {
        let present = (Arc::clone(&self.file), self.selection.clone());
        (self.file, self.selection) = self.history.redo(present).unwrap_or_else(|present| present);
    }

    /// The scene was written to `path`, where its paths are those of `saved`.
    pub(crate) fn saved_as(&mut self, path: PathBuf, saved: SceneFile) {
        self.path = Some(path);
        self.saved = Arc::new(saved);
        self.file = Arc::clone(&self.saved);
        self.history.end_gesture();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::Handle;
    use crate::math::Rgb;
    use crate::scene::{Emitter, Light};
    use glam::DVec3;

    fn document() -> Document {
        let emitter = Emitter::Point { position: DVec3::ZERO, intensity: Rgb::ONE };
        let scene = Scene { lights: vec![Light { name: "lamp".into(), emitter }], ..Scene::default() };
        Document::new(SceneFile { scene, location: Location::Unsaved })
    }

    fn lamp(document: &Document) -> DVec3 {
        Handle::Light(0).position(document.scene()).unwrap()
    }

    fn nudge(document: &mut Document) {
        document.edit(Edit::Move(vec![Handle::Light(0)], DVec3::X));
    }

    #[test]
    fn a_drag_is_undone_at_once() {
        let mut document = document();
        for _ in 0..5 {
            nudge(&mut document);
        }
        document.end_gesture();
        nudge(&mut document);
        document.undo();
        assert_eq!(lamp(&document), 5.0 * DVec3::X);
        document.undo();
        assert_eq!(lamp(&document), DVec3::ZERO);
        document.redo();
        assert_eq!(lamp(&document), 5.0 * DVec3::X);
    }

    #[test]
    fn dirty_is_what_differs_from_the_saved_scene() {
        let mut document = document();
        assert!(!document.is_dirty(), "as opened");
        nudge(&mut document);
        assert!(document.is_dirty(), "changed");
        document.undo();
        assert!(!document.is_dirty(), "as opened again");
        document.redo();
        let saved = (**document.file()).clone();
        document.saved_as("a.toml".into(), saved);
        assert!(!document.is_dirty(), "saved");
        document.undo();
        assert!(document.is_dirty(), "before the save");
    }

    #[test]
    fn an_edit_that_changes_nothing_is_no_step() {
        let mut document = document();
        document.edit(Edit::Name(String::new()));
        assert_eq!(document.undoable(), None);
    }
}
