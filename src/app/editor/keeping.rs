//! What the editor keeps in the user's folders.

use super::state::Editor;
use crate::app::keeping::{Folders, LoadedPreferences};
use egui::Context;
use std::path::Path;

impl Editor {
    /// Applies the preferences, offers the unsaved changes of former windows, and keeps preferences, unsaved changes and the list of recent
    /// files in these folders from now on.
    pub(crate) fn keep_in(&mut self, ctx: &Context, folders: &Folders, loaded: LoadedPreferences) {
        if let Some(damage) = loaded.damage {
            self.toasts.warning(damage);
        }
        self.preferences_file.keep_in(folders.preferences(), &loaded.preferences);
        self.apply_preferences(ctx, loaded.preferences);
        self.recent.keep_in(folders.recent());
        if let Some(path) = self.document.path().map(Path::to_path_buf) {
            self.recent.add(&path);
        }
        self.autosave.keep_in(folders.unsaved());
        self.left_overs.search(ctx, folders.unsaved());
    }
}
