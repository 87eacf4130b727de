//! Opening, saving and exporting.

use super::action::Action;
use super::chooser::{Outcome, Purpose, Request};
use super::dialogs::Dialog;
use super::document::Document;
use super::edit::Edit;
use super::editor::{Editor, same_picture};
use super::new_items;
use super::view::View;
use crate::scene::{SceneError, SceneFile};
use egui::Context;
use std::path::{Path, PathBuf};
use std::sync::Arc;

impl Editor {
    /// Open, Save, Save as, Export.
    pub(crate) fn file_action(&mut self, ctx: &Context, action: Action) {
        let purpose = match action {
            Action::Save => match self.document.path().map(Path::to_path_buf) {
                Some(path) => return self.save(ctx, path),
                None => Purpose::SaveScene,
            },
            Action::SaveAs => Purpose::SaveScene,
            Action::Export => Purpose::ExportPicture,
            _ => Purpose::OpenScene,
        };
        self.choose(ctx, purpose);
    }

    /// Opens a file dialog.
    pub(crate) fn choose(&mut self, ctx: &Context, purpose: Purpose) {
        let request = Request { purpose, proposal: self.proposal(purpose) };
        self.chooser.start(ctx, request);
    }

    /// Where to look first: beside the scene, under its name.
    fn proposal(&self, purpose: Purpose) -> PathBuf {
        let folder = self.document.path().and_then(Path::parent).map(Path::to_path_buf);
        let folder = folder.or_else(|| std::env::current_dir().ok()).unwrap_or_default();
        if !purpose.writes() {
            return folder.join("");
        }
        let name = self.document.title();
        let stem = Path::new(name.trim_start_matches('*')).file_stem().map(Path::new).unwrap_or(Path::new("scene"));
        folder.join(stem).with_extension(purpose.extensions()[0])
    }

    /// The file dialog is gone.
    pub(crate) fn chosen(&mut self, ctx: &Context, request: Request, outcome: Outcome) {
        match outcome {
            Outcome::Chosen(path) => self.use_path(ctx, request.purpose, path),
            Outcome::Cancelled => self.after_save = None,
            Outcome::Unavailable => self.dialog = Some(Dialog::path(request)),
        }
    }

    /// A path was typed; one to write to has been confirmed where a file is there.
    pub(crate) fn path_entered(&mut self, ctx: &Context, path: PathBuf) {
        if let Some(Dialog::Path(request, _)) = self.dialog.take() {
            self.carry_out(ctx, request.purpose, path);
        }
    }

    /// A path came from a dialog, which asked before replacing a file; not so where the extension was missing.
    fn use_path(&mut self, ctx: &Context, purpose: Purpose, path: PathBuf) {
        let complete = with_extension(purpose, path.clone());
        if complete != path && complete.exists() {
            self.dialog = Some(Dialog::path(Request { purpose, proposal: complete }));
        } else {
            self.carry_out(ctx, purpose, complete);
        }
    }

    fn carry_out(&mut self, ctx: &Context, purpose: Purpose, path: PathBuf) {
        match purpose {
            Purpose::OpenScene => self.apply(ctx, super::command::AppCommand::GoTo(super::command::Next::Open(path))),
            Purpose::SaveScene => self.save(ctx, path),
            Purpose::ExportPicture => self.start_export(path),
            Purpose::AddTexture => {
                let texture = new_items::texture(self.document.scene(), &path);
                self.document.edit(Edit::AddTexture(texture));
            }
        }
    }

    /// Shows a scene that was opened, or why it could not be; then the present one stays.
    pub(crate) fn open(&mut self, opened: Result<SceneFile, SceneError>, name: &str) {
        match opened {
            Ok(file) => self.replace(file),
            Err(error) => self.dialog = Some(Dialog::error(format!("{name} cannot be opened"), error.to_string())),
        }
    }

    /// Another scene, seen as a whole.
    pub(crate) fn replace(&mut self, file: SceneFile) {
        self.document = Document::new(file);
        self.canvas.view = View::Fit;
        self.export.forget_waiting();
    }

    fn save(&mut self, ctx: &Context, path: PathBuf) {
        let mut file = SceneFile::clone(self.document.file());
        match file.save(&path) {
            Ok(()) => {
                self.toasts.success(format!("Saved {}", path.display()));
                let shown = self.rendered.as_ref().is_some_and(|shown| same_picture(shown, self.document.file()));
                self.document.saved_as(path, file);
                if shown {
                    // From another place, with its paths written another way: the same picture, which goes on.
                    self.rendered = Some(Arc::clone(self.document.file()));
                }
                if let Some(next) = self.after_save.take() {
                    self.go(ctx, next);
                }
            }
            Err(error) => {
                self.after_save = None;
                self.dialog = Some(Dialog::error("The scene was not saved".to_owned(), error.to_string()));
            }
        }
    }
}

/// The path with the first extension that this purpose knows, unless it has one of them.
pub(crate) fn with_extension(purpose: Purpose, path: PathBuf) -> PathBuf {
    let known = |extension: &str| purpose.extensions().iter().any(|known| extension.eq_ignore_ascii_case(known));
    if !purpose.writes() || path.extension().is_some_and(|extension| known(&extension.to_string_lossy())) {
        return path;
    }
    // Appended, not replaced: in "view 1.5" the 5 is no extension.
    let mut name = path.into_os_string();
    name.push(".");
    name.push(purpose.extensions()[0]);
    PathBuf::from(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_extension_is_appended() {
        let path = |purpose, path: &str| with_extension(purpose, PathBuf::from(path)).display().to_string();
        assert_eq!(path(Purpose::ExportPicture, "a/view 1.5"), "a/view 1.5.png");
        assert_eq!(path(Purpose::ExportPicture, "a/b.EXR"), "a/b.EXR");
        assert_eq!(path(Purpose::SaveScene, "room"), "room.toml");
        assert_eq!(path(Purpose::OpenScene, "room"), "room");
    }
}
