//! Asks the user for a path, by file dialog or by path field.

use super::state::Editor;
use crate::app::commands::Purpose;
use crate::app::files::{PathField, Request, proposed};
use crate::app::shell::Dialog;
use egui::Context;
use std::path::Path;

impl Editor {
    /// Opens a file dialog for this purpose, unless one is open: its answer would get lost.
    pub(crate) fn ask_for_path(&mut self, ctx: &Context, purpose: Purpose) {
        if let Some(open) = self.chooser.pending() {
            // Only the answer to "Save scene" ends in leaving the scene.
            self.after_save.take_if(|_| open.purpose != Purpose::SaveScene);
            self.toasts.warning(format!("First answer the open file dialog \"{}\"", open.purpose.title()));
            return;
        }
        let request = Request { purpose, proposal: proposed(&self.document, purpose, self.last_folders.of(purpose)) };
        self.chooser.start(ctx, request);
    }

    /// Dismisses the file dialog, and asks for a typed path instead.
    pub(crate) fn ask_for_typed_path(&mut self) {
        if let Some(request) = self.chooser.dismiss() {
            self.dialog = Some(Dialog::Path(PathField::instead_of_dialog(request)));
        }
    }

    /// Asks the user to correct a path that did not work. While another dialog is open, reports the error only.
    pub(crate) fn ask_again(&mut self, purpose: Purpose, path: &Path, error: String) {
        if self.dialog.is_some() {
            self.after_save = None;
            self.toasts.error(error);
        } else {
            self.dialog = Some(Dialog::Path(PathField::correcting(purpose, path, Some(error))));
        }
    }
}
