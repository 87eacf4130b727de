//! Opens, saves and leaves scenes.

use super::opened_scene::OpenedScene;
use super::state::Editor;
use crate::app::commands::{Answer, Next, Purpose};
use crate::app::document::{Document, new_items};
use crate::app::shell::Dialog;
use crate::app::viewpoint::Visited;
use crate::scene::{Location, SceneError, SceneFile};
use egui::{Context, ViewportCommand};
use std::path::{Path, PathBuf};

impl Editor {
    /// Leaves the present scene, or asks first while changes are unsaved. A scene that does not open is reported without a
    /// question.
    pub(crate) fn leave(&mut self, ctx: &Context, next: Next) {
        if !self.has_unsaved() {
            return self.proceed(ctx, next);
        }
        if let Next::Open(path) = &next {
            match OpenedScene::read(path) {
                Ok(opened) => self.opened = Some(opened),
                Err(error) => return self.open_failed(path, &error),
            }
        }
        self.dialog = Some(Dialog::Unsaved(next));
    }

    /// Follows the user's answer to "Save the changes?".
    pub(crate) fn answer(&mut self, ctx: &Context, answer: Answer) {
        let Some(Dialog::Unsaved(next)) = self.dialog.take() else { return };
        match answer {
            Answer::Save => {
                self.after_save = Some(next);
                self.save(ctx);
            }
            Answer::Discard => self.proceed(ctx, next),
            Answer::Cancel => self.opened = None,
        }
    }

    /// Saves the scene to its file. Asks first where another program has changed the file, and asks for a path where the
    /// scene has no file.
    pub(crate) fn save(&mut self, ctx: &Context) {
        match self.document.path().map(Path::to_path_buf) {
            Some(path) if self.document.is_changed_outside() => self.dialog = Some(Dialog::ChangedOutside(path)),
            Some(path) => self.save_to(ctx, path),
            None => self.ask_for_path(ctx, Purpose::SaveScene),
        }
    }

    /// Asks for a path to save the scene to, also in answer to an open dialog.
    pub(crate) fn save_as(&mut self, ctx: &Context) {
        self.dialog = None;
        self.ask_for_path(ctx, Purpose::SaveScene);
    }

    /// Saves the scene over its file, after the user's confirmation.
    pub(crate) fn replace(&mut self, ctx: &Context, path: PathBuf) {
        self.dialog = None;
        self.save_to(ctx, path);
    }

    /// Saves the scene to `path`, then leaves it if the user asked to save before leaving.
    pub(crate) fn save_to(&mut self, ctx: &Context, path: PathBuf) {
        let mut file = SceneFile::clone(self.document.file());
        if let Err(error) = file.save(&path) {
            return self.ask_again(Purpose::SaveScene, &path, error.to_string());
        }
        self.toasts.success(format!("Saved {}", path.display()));
        self.recent.add(&path);
        self.save_snapshots(&path);
        self.unreadable = None;
        let rendered = self.rendering.renders(self.viewpoint.seen());
        self.document.saved_as(path, file);
        if rendered {
            self.viewpoint.follow(self.document.file());
            self.rendering.relocate(self.viewpoint.seen());
        }
        if let Some(next) = self.after_save.take() {
            self.proceed(ctx, next);
        }
    }

    /// Leaves the present scene and discards unsaved changes.
    fn proceed(&mut self, ctx: &Context, next: Next) {
        match next {
            Next::New => self.show(SceneFile { scene: new_items::empty_scene(), location: Location::Unsaved }),
            Next::Open(path) => self.open_file(&path),
            Next::Example(name) => self.open(SceneFile::built_in(name), name),
            Next::Recover(index) => self.recover(index),
            Next::Quit => {
                self.autosave.end();
                self.may_close = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    /// Opens a scene file, unless it was opened before the question about unsaved changes, and puts it at the top of the recent files.
    fn open_file(&mut self, path: &Path) {
        let opened = self.opened.take().filter(|opened| opened.is_present(path));
        match opened.map_or_else(|| SceneFile::open(path), |opened| Ok(opened.file)) {
            Ok(file) => {
                self.recent.add(path);
                self.show(file);
            }
            Err(error) => self.open_failed(path, &error),
        }
    }

    /// Reports a scene file that does not open. A missing file leaves the recent files.
    fn open_failed(&mut self, path: &Path, error: &SceneError) {
        if !path.exists() {
            self.recent.remove(path);
        }
        self.report(&path.display().to_string(), error);
    }

    /// Shows an opened scene. Where opening failed, keeps the present scene and reports the error.
    fn open(&mut self, opened: Result<SceneFile, SceneError>, name: &str) {
        match opened {
            Ok(file) => self.show(file),
            Err(error) => self.report(name, &error),
        }
    }

    fn report(&mut self, name: &str, error: &SceneError) {
        self.dialog = Some(Dialog::Error(format!("{name} cannot be opened"), error.to_string()));
    }

    fn show(&mut self, file: SceneFile) {
        self.replace_document(Document::new(file));
    }

    /// Replaces the document by another one, and shows the whole picture.
    pub(crate) fn replace_document(&mut self, document: Document) {
        self.document = document;
        self.open_snapshots();
        self.show_all_light();
        self.viewpoint.look(None);
        self.visited = Visited::new(self.document.scene().camera);
        self.unreadable = None;
        self.canvas.fit();
        self.export.cancel_picture();
    }
}
