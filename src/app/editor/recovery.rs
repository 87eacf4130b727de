//! Writes unsaved changes, and recovers those of former windows.

use super::state::Editor;
use crate::app::document::{Document, Stamp};
use crate::app::shell::Dialog;
use crate::scene::{Location, SceneFile};
use egui::Context;
use std::time::Instant;

impl Editor {
    /// Writes the unsaved changes if it is time, and asks about the changes of former windows once they are found.
    pub(crate) fn poll_recovery(&mut self, ctx: &Context) {
        if let Some(error) = self.autosave.update(ctx, &self.document, Instant::now()) {
            self.toasts.warning(format!("Unsaved changes cannot be kept for a recovery: {error}"));
        }
        if self.dialog.is_none() && self.left_overs.poll() {
            self.dialog = Some(Dialog::Recovery(self.left_overs.rows()));
        }
    }

    /// Recovers the changes at this place in the list; those that stay in the list wait for a later window.
    pub(crate) fn recover(&mut self, index: usize) {
        let Some((slot, copy)) = self.left_overs.take(index) else { return };
        let base = match &copy.file.location {
            // A file that has changed since is not the one that the changes are based on: saving asks before it replaces it.
            Location::Disk(path) if copy.stamp != Stamp::of(path) => None,
            Location::Disk(path) => SceneFile::open(path).ok(),
            Location::BuiltIn(name) => SceneFile::built_in(name).ok(),
            Location::Unsaved => None,
        };
        self.replace_document(Document::recovered(copy.file, base, copy.stamp));
        self.autosave.adopt(slot, self.document.file());
        self.left_overs.release();
        self.dialog = None;
        self.toasts.success("The unsaved changes are recovered. Save the scene to keep them.");
    }

    /// Discards the changes at this place in the list.
    pub(crate) fn discard_left_over(&mut self, index: usize) {
        self.left_overs.discard(index);
        let rows = self.left_overs.rows();
        self.dialog = (!rows.is_empty()).then_some(Dialog::Recovery(rows));
    }
}
