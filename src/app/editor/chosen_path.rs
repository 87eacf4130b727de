//! Uses a chosen path: open, save, export, add.

use super::state::Editor;
use crate::app::commands::{Next, Purpose};
use crate::app::document::{Edit, new_items};
use crate::app::files::{Outcome, PathField, Request, complete, surface_of};
use crate::app::shell::{Dialog, drop_hint};
use crate::scene::SurfaceOptions;
use egui::Context;

use std::path::PathBuf;

impl Editor {
    /// Uses the result of a file dialog.
    pub(crate) fn dialog_ended(&mut self, ctx: &Context, request: Request, outcome: Outcome) {
        match outcome {
            Outcome::Chosen(path) => self.path_chosen(ctx, request.purpose, path),
            Outcome::Cancelled => self.after_save = None,
            Outcome::Unavailable => self.dialog = Some(Dialog::Path(PathField::instead_of_dialog(request))),
        }
    }

    /// Uses a typed path. The path field has confirmed that an existing file will be replaced.
    pub(crate) fn path_entered(&mut self, ctx: &Context, path: PathBuf) {
        let Some(Dialog::Path(field)) = self.dialog.take() else { return };
        match complete(field.purpose, path.clone()) {
            Ok(complete) if !field.purpose.writes() && !complete.is_file() => {
                self.ask_again(field.purpose, &path, "This file does not exist.".to_owned());
            }
            Ok(complete) => self.use_path(ctx, field.purpose, complete),
            Err(error) => self.ask_again(field.purpose, &path, error),
        }
    }

    /// Uses a path from a file dialog. The dialog has confirmed that an existing file will be replaced, except where the
    /// extension was missing.
    fn path_chosen(&mut self, ctx: &Context, purpose: Purpose, path: PathBuf) {
        match complete(purpose, path.clone()) {
            Ok(complete) if complete != path && complete.exists() => {
                self.dialog = Some(Dialog::Path(PathField::correcting(purpose, &complete, None)));
            }
            Ok(complete) => self.use_path(ctx, purpose, complete),
            Err(error) => self.ask_again(purpose, &path, error),
        }
    }

    /// Opens, saves, exports or adds the file at `path`.
    pub(crate) fn use_path(&mut self, ctx: &Context, purpose: Purpose, path: PathBuf) {
        self.last_folders.remember(purpose, &path);
        match purpose {
            Purpose::OpenScene => self.leave(ctx, Next::Open(path)),
            Purpose::SaveScene => self.save_to(ctx, path),
            Purpose::ExportPicture | Purpose::ExportShown | Purpose::ExportDeep => self.export_picture(purpose, path),
            Purpose::ExportSurface => {
                if let Some(surface) = surface_of(&self.document) {
                    self.export.write_surface(ctx, surface, path);
                }
            }
            Purpose::AddSurface => self.add_surface(&path),
            Purpose::ExportProfile => self.write_profile(ctx, path),
            Purpose::OpenReference => self.add_reference(&path),
            Purpose::AddTexture => match new_items::texture(self.document.scene(), &path) {
                Ok(texture) => self.document.edit(Edit::AddTexture(texture)),
                Err(error) => self.dialog = Some(Dialog::Error("The texture cannot be added".to_owned(), error)),
            },
        }
    }

    /// Uses a file that was dropped onto the window; warns where the window cannot read it.
    pub(crate) fn drop_file(&mut self, ctx: &Context, path: PathBuf) {
        match Purpose::of_dropped(&path) {
            Some(purpose) => self.use_path(ctx, purpose, path),
            None => {
                self.toasts.warning(format!("{} cannot be opened. {}", path.display(), drop_hint(None)));
            }
        }
    }

    /// Copies the picture on the screen to the clipboard.
    pub(crate) fn copy_picture(&mut self, ctx: &Context) {
        if let Some(picture) = self.display.picture() {
            let [width, height] = picture.size;
            ctx.copy_image(egui::ColorImage::clone(picture));
            self.toasts.info(format!("Copied {width} × {height} pixels"));
        }
    }

    fn export_picture(&mut self, purpose: Purpose, path: PathBuf) {
        if self.rendering.full_frame().is_none() {
            self.toasts.info("The picture is still a draft. It will be written after its first iteration.");
        }
        self.export.request_picture(purpose, path);
    }

    /// Asks how to export the surface; warns in a scene without a Bezier object.
    pub(crate) fn ask_for_surface(&mut self) {
        match surface_of(&self.document) {
            Some(surface) => self.dialog = Some(Dialog::Surface(surface.name, self.export.surface_options)),
            None => {
                self.toasts.warning("The scene has no Bezier object to export");
            }
        }
    }

    /// Asks for a path to export the surface to.
    pub(crate) fn ask_for_surface_path(&mut self, ctx: &Context, options: SurfaceOptions) {
        self.dialog = None;
        self.export.surface_options = options;
        self.ask_for_path(ctx, Purpose::ExportSurface);
    }

    /// Continues the exports, and reports the finished exports.
    pub(crate) fn poll_export(&mut self, ctx: &Context) {
        for exported in self.export.poll(ctx, self.rendering.full_frame(), self.viewpoint.seen(), self.rendering.only())
        {
            match exported.result {
                Ok(()) => {
                    self.toasts.success(format!("Exported {}", exported.path.display()));
                }
                Err(error) => self.ask_again(exported.purpose, &exported.path, error),
            }
        }
    }
}
