//! The edited scene with its file, its selection and its undo history.

use super::edit::{Edit, EditKey};
use super::edit_name::edit_name;
use super::history::History;
use super::selection::Selection;
use super::stamp::Stamp;
use super::surface::Coupling;
use crate::scene::{Location, Scene, SceneFile};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The edited scene. Only edits, the undo history and saving change it.
#[derive(Debug)]
pub(crate) struct Document {
    file: Arc<SceneFile>,
    /// The scene as its file holds it; `None` for a recovered scene whose file cannot be opened.
    saved: Option<Arc<SceneFile>>,
    /// The scene's file; `None` for a built-in scene and for a scene that was never saved.
    path: Option<PathBuf>,
    /// The scene's file as it was opened or saved last.
    stamp: Option<Stamp>,
    /// Whether another program has deleted the scene's file.
    is_lost: bool,
    /// The item that the panels and the canvas show.
    pub(crate) selection: Selection,
    /// Which control points move together. The scene file does not hold it.
    pub(crate) coupling: Coupling,
    history: History<(Arc<SceneFile>, Selection), EditKey>,
}

impl Document {
    /// The document of a scene that was just opened, with its first Bezier object selected.
    pub(crate) fn new(file: SceneFile) -> Self {
        let path = match &file.location {
            Location::Disk(path) => Some(path.clone()),
            Location::BuiltIn(_) | Location::Unsaved => None,
        };
        let selection = Selection::first_of(&file.scene);
        let (file, stamp) = (Arc::new(file), path.as_deref().and_then(Stamp::of));
        Self {
            saved: Some(Arc::clone(&file)),
            file,
            path,
            stamp,
            is_lost: false,
            selection,
            coupling: Coupling::default(),
            history: History::default(),
        }
    }

    /// The document of recovered changes: `file` is the present scene, `stamp` the state of the scene's file that the changes are based
    /// on. The first undo step leads back to `base`, the scene in that file.
    pub(crate) fn recovered(file: SceneFile, base: Option<SceneFile>, stamp: Option<Stamp>) -> Self {
        let mut document = Self::new(file);
        document.stamp = stamp;
        document.saved = base.map(Arc::new);
        if let Some(base) = &document.saved {
            let before = (Arc::clone(base), Selection::first_of(&base.scene));
            document.history.record(before, ("recover", 0), || "recover the changes".to_owned());
            document.history.end_gesture();
        }
        document
    }

    /// The present state of the scene.
    pub(crate) fn scene(&self) -> &Scene {
        &self.file.scene
    }

    /// The scene as its file holds it; `None` for a recovered scene whose file cannot be opened.
    pub(crate) fn saved_scene(&self) -> Option<&Scene> {
        self.saved.as_ref().map(|file| &file.scene)
    }

    /// The scene with the location that its file paths are relative to.
    pub(crate) fn file(&self) -> &Arc<SceneFile> {
        &self.file
    }

    /// The scene's file; `None` for a built-in scene and for a scene that was never saved.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The scene's file as it was opened or saved last; `None` without a file.
    pub(crate) fn stamp(&self) -> Option<Stamp> {
        self.stamp
    }

    /// Whether another program has changed the scene's file since it was opened or saved last.
    pub(crate) fn is_changed_outside(&self) -> bool {
        let present = self.path.as_deref().and_then(Stamp::of);
        present.is_some() && present != self.stamp
    }

    /// Whether the scene differs from its saved state, or its file is gone.
    pub(crate) fn is_dirty(&self) -> bool {
        self.is_lost || self.saved.as_ref().is_none_or(|saved| !Arc::ptr_eq(&self.file, saved) && self.file != *saved)
    }

    /// The file's name for the title bar, after `*` while changes are unsaved.
    pub(crate) fn title(&self) -> String {
        let file = self.path.as_deref().and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
        let name = file.unwrap_or_else(|| match &self.file.location {
            Location::BuiltIn(name) => name.clone(),
            _ => "untitled".to_owned(),
        });
        format!("{}{name}", if self.is_dirty() { "*" } else { "" })
    }

    /// Changes the scene, moves the control points that follow moved ones, and selects an added item, or nothing after a
    /// removal. Edits with one key within one gesture make one undo step.
    pub(crate) fn edit(&mut self, edit: Edit) {
        let (key, selects) = (edit.key(), edit.selects(&self.file.scene));
        let name = edit_name(&edit, &self.file.scene);
        let mut scene = self.file.scene.clone();
        edit.apply(&mut scene);
        self.coupling.follow(&self.file.scene, &mut scene);
        if scene == self.file.scene {
            return;
        }
        self.history.record((Arc::clone(&self.file), self.selection.clone()), key, || name);
        self.file = Arc::new(SceneFile { scene, location: self.file.location.clone() });
        let selection = selects.map_or_else(|| std::mem::take(&mut self.selection), Selection::of);
        self.selection = selection.within(&self.file.scene);
    }

    /// Ends the gesture: the next edit starts a new undo step.
    pub(crate) fn end_gesture(&mut self) {
        self.history.end_gesture();
    }

    /// Reverts the edits of the current gesture, without a redo step.
    pub(crate) fn abandon_gesture(&mut self) {
        let present = (Arc::clone(&self.file), self.selection.clone());
        (self.file, self.selection) = self.history.abandon_gesture(present).unwrap_or_else(|present| present);
    }

    /// The name of the edit that undo would revert; `None` without such a step.
    pub(crate) fn undoable(&self) -> Option<&str> {
        self.history.undoable()
    }

    /// The name of the edit that redo would repeat; `None` without such a step.
    pub(crate) fn redoable(&self) -> Option<&str> {
        self.history.redoable()
    }

    /// The names of all undo steps, from the oldest: first the done ones, then the undone ones.
    pub(crate) fn steps(&self) -> impl Iterator<Item = &str> {
        self.history.steps()
    }

    /// How many of the undo steps are done.
    pub(crate) fn done_steps(&self) -> usize {
        self.history.done()
    }

    /// Undoes or repeats steps until this many are done.
    pub(crate) fn go_to(&mut self, done: usize) {
        for _ in done..self.history.done() {
            self.undo();
        }
        for _ in self.history.done()..done.min(self.history.steps().count()) {
            self.redo();
        }
    }

    /// Reverts the last undo step, if any.
    pub(crate) fn undo(&mut self) {
        let present = (Arc::clone(&self.file), self.selection.clone());
        (self.file, self.selection) = self.history.undo(present).unwrap_or_else(|present| present);
    }

    /// Repeats the last undone step, if any.
    pub(crate) fn redo(&mut self) {
        let present = (Arc::clone(&self.file), self.selection.clone());
        (self.file, self.selection) = self.history.redo(present).unwrap_or_else(|present| present);
    }

    /// Takes `file`, which another program has written with this stamp, as the present scene. An undo step leads back.
    pub(crate) fn reload(&mut self, file: SceneFile, stamp: Stamp) {
        self.history.end_gesture();
        let before = (Arc::clone(&self.file), self.selection.clone());
        self.history.record(before, ("reload", 0), || "reload the changed file".to_owned());
        self.history.end_gesture();
        self.file = Arc::new(file);
        self.saved = Some(Arc::clone(&self.file));
        self.selection = std::mem::take(&mut self.selection).within(&self.file.scene);
        self.has_file(Some(stamp));
    }

    /// Takes the scene of a snapshot of this name as the present one. An undo step leads back.
    pub(crate) fn restore(&mut self, file: &Arc<SceneFile>, name: &str) {
        self.history.end_gesture();
        let before = (Arc::clone(&self.file), self.selection.clone());
        self.history.record(before, ("restore", 0), || format!("restore {name}"));
        self.history.end_gesture();
        self.file = Arc::clone(file);
        self.selection = std::mem::take(&mut self.selection).within(&self.file.scene);
    }

    /// Keeps the present scene, although another program has written its file with this stamp.
    pub(crate) fn keep_over(&mut self, stamp: Stamp) {
        self.has_file(Some(stamp));
    }

    /// Keeps the present scene as unsaved: another program has deleted its file.
    pub(crate) fn lose_file(&mut self) {
        self.is_lost = true;
    }

    fn has_file(&mut self, stamp: Option<Stamp>) {
        self.stamp = stamp;
        self.is_lost = false;
    }

    /// Whether the scene's file last held this scene.
    pub(crate) fn is_saved_as(&self, file: &SceneFile) -> bool {
        self.saved.as_ref().is_some_and(|saved| saved.scene == file.scene)
    }

    /// Takes `saved` as the present scene: it was just written to `path`, and its file paths are relative to there.
    pub(crate) fn saved_as(&mut self, path: PathBuf, saved: SceneFile) {
        self.has_file(Stamp::of(&path));
        self.path = Some(path);
        self.file = Arc::new(saved);
        self.saved = Some(Arc::clone(&self.file));
        self.history.end_gesture();
    }
}

#[cfg(test)]
mod tests {
    use super::super::handles::Handle;
    use super::*;
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
    fn a_drag_is_one_undo_step() {
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
    fn a_scene_that_differs_from_the_saved_one_is_dirty() {
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
    fn the_history_leads_to_every_state() {
        let mut document = document();
        for _ in 0..4 {
            nudge(&mut document);
            document.end_gesture();
        }
        for (done, x) in [(1, 1.0), (4, 4.0), (0, 0.0), (99, 4.0), (2, 2.0)] {
            document.go_to(done);
            assert_eq!(lamp(&document), x * DVec3::X, "{done} steps done");
        }
        assert_eq!(document.steps().collect::<Vec<_>>(), ["move light lamp"; 4]);
    }

    #[test]
    fn an_edit_without_effect_adds_no_undo_step() {
        let mut document = document();
        document.edit(Edit::Name(String::new()));
        assert_eq!(document.undoable(), None);
    }
}
