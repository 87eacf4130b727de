//! Opening, saving and exporting.

use super::state::{Editor, same_picture};
use crate::app::canvas::View;
use crate::app::commands::{Action, AppCommand, Next};
use crate::app::document::{Document, Edit, new_items};
use crate::app::files::{Outcome, PathField, Purpose, Request, complete};
use crate::app::shell::Dialog;
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
            Outcome::Unavailable => self.dialog = Some(Dialog::Path(PathField::instead(request))),
        }
    }

    /// A path was typed; one to write to has been confirmed where a file is there.
    pub(crate) fn path_entered(&mut self, ctx: &Context, path: PathBuf) {
        let Some(Dialog::Path(field)) = self.dialog.take() else { return };
        match complete(field.purpose, path.clone()) {
            Ok(complete) if !field.purpose.writes() && !complete.is_file() => {
                self.ask_again(field.purpose, &path, "There is no such file.".to_owned());
            }
            Ok(complete) => self.carry_out(ctx, field.purpose, complete),
            Err(error) => self.ask_again(field.purpose, &path, error),
        }
    }

    /// A path came from a dialog, which asked before replacing a file; not so where the extension was missing.
    fn use_path(&mut self, ctx: &Context, purpose: Purpose, path: PathBuf) {
        match complete(purpose, path.clone()) {
            Ok(complete) if complete != path && complete.exists() => {
                self.dialog = Some(Dialog::Path(PathField::again(purpose, &complete, None)));
            }
            Ok(complete) => self.carry_out(ctx, purpose, complete),
            Err(error) => self.ask_again(purpose, &path, error),
        }
    }

    /// The path did not serve: it can be corrected.
    pub(crate) fn ask_again(&mut self, purpose: Purpose, path: &Path, error: String) {
        if self.dialog.is_some() {
            // Whatever is asked there comes first.
            self.after_save = None;
            self.toasts.error(error);
        } else {
            self.dialog = Some(Dialog::Path(PathField::again(purpose, path, Some(error))));
        }
    }

    /// Does what the file was chosen for.
    pub(crate) fn carry_out(&mut self, ctx: &Context, purpose: Purpose, path: PathBuf) {
        match purpose {
            Purpose::OpenScene => self.apply(ctx, AppCommand::GoTo(Next::Open(path))),
            Purpose::SaveScene => self.save(ctx, path),
            Purpose::ExportPicture => self.start_export(path),
            Purpose::ExportSurface => self.export_surface(ctx, path),
            Purpose::AddSurface => match new_items::surface(self.document.scene(), &path) {
                Ok(object) => self.edit(Edit::AddObject(object)),
                Err(error) => self.dialog = Some(Dialog::error("The patches cannot be added".to_owned(), error)),
            },
            Purpose::AddTexture => {
                let texture = new_items::texture(self.document.scene(), &path);
                self.edit(Edit::AddTexture(texture));
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
            Err(error) => self.ask_again(Purpose::SaveScene, &path, error.to_string()),
        }
    }
}
