//! The one place where commands are carried out.

use super::state::Editor;
use crate::app::canvas::View;
use crate::app::commands::{Action, Answer, AppCommand, Next};
use crate::app::document::{Edit, Item, Selection, new_items, user_of};
use crate::app::files::{PathField, Purpose};
use crate::app::shell::Dialog;
use crate::engine;
use crate::scene::{Location, SceneFile};
use egui::{Context, ViewportCommand};

/// One step of the zoom keys.
const ZOOM_STEP: f32 = 1.25;
/// One step of the exposure keys, stops.
const EXPOSURE_STEP: f64 = 0.5;

impl Editor {
    /// Does what was asked for.
    pub(crate) fn apply(&mut self, ctx: &Context, command: AppCommand) {
        match command {
            AppCommand::Do(action) => self.act(ctx, action),
            AppCommand::Edit(edit) => self.edit(edit),
            AppCommand::Select(selection) => self.document.selection = selection.within(self.document.scene()),
            AppCommand::AddFrom(purpose) => self.choose(ctx, purpose),
            AppCommand::Drop(path) => self.carry_out(ctx, Purpose::of_dropped(&path), path),
            AppCommand::CancelDrag => self.document.abandon_gesture(),
            AppCommand::GoTo(next) => self.go_to(ctx, next),
            AppCommand::Answer(answer) => self.answer(ctx, answer),
            AppCommand::PathEntered(path) => self.path_entered(ctx, path),
            AppCommand::TypePath => {
                if let Some(request) = self.chooser.give_up() {
                    self.dialog = Some(Dialog::Path(PathField::instead(request)));
                }
            }
            AppCommand::CloseDialog => self.close_dialog(),
            AppCommand::ExportSurface(steps) => {
                self.dialog = None;
                self.export.steps = steps;
                self.choose(ctx, Purpose::ExportSurface);
            }
            AppCommand::Theme(theme) => ctx.set_theme(theme),
            AppCommand::Target(target) => {
                self.rendering.target = target;
                self.outbox.push(engine::Command::Target(target));
            }
        }
    }

    fn act(&mut self, ctx: &Context, action: Action) {
        match action {
            Action::New => self.go_to(ctx, Next::New),
            Action::Open | Action::Save | Action::SaveAs | Action::Export => self.file_action(ctx, action),
            Action::ExportSurface => self.ask_for_surface(),
            Action::Quit => self.go_to(ctx, Next::Quit),
            Action::Undo => self.document.undo(),
            Action::Redo => self.document.redo(),
            Action::Duplicate => {
                if let Some(edit) = new_items::duplicate(self.document.scene(), self.document.selection.item) {
                    self.edit(edit);
                }
            }
            Action::Delete => self.delete(),
            Action::TogglePause => {
                self.rendering.paused = !self.rendering.paused;
                self.outbox.push(if self.rendering.paused { engine::Command::Pause } else { engine::Command::Resume });
            }
            Action::Restart => self.outbox.push(engine::Command::Restart),
            Action::Brighter => self.expose(EXPOSURE_STEP),
            Action::Darker => self.expose(-EXPOSURE_STEP),
            Action::ToggleHandles => self.canvas.show_handles = !self.canvas.show_handles,
            Action::TogglePanels => self.show_panels = !self.show_panels,
            Action::FullScreen => {
                let now = ctx.input(|input| input.viewport().fullscreen.unwrap_or(false));
                ctx.send_viewport_cmd(ViewportCommand::Fullscreen(!now));
            }
            Action::Help => self.dialog = Some(Dialog::Help),
            Action::Fit | Action::OneToOne | Action::ZoomIn | Action::ZoomOut => self.look(ctx, action),
        }
    }

    fn look(&mut self, ctx: &Context, action: Action) {
        let Some(placement) = self.canvas.placement else { return };
        let middle = placement.canvas.center();
        self.canvas.view = match action {
            Action::OneToOne => placement.one_to_one(ctx.pixels_per_point()),
            Action::ZoomIn => placement.zoomed(ZOOM_STEP, middle),
            Action::ZoomOut => placement.zoomed(1.0 / ZOOM_STEP, middle),
            _ => View::Fit,
        };
    }

    pub(crate) fn edit(&mut self, edit: Edit) {
        let scene = self.document.scene();
        let added = match &edit {
            Edit::AddObject(_) => Some(Item::Object(scene.objects.len())),
            Edit::AddMaterial(_) => Some(Item::Material(scene.materials.len())),
            Edit::AddLight(_) => Some(Item::Light(scene.lights.len())),
            Edit::AddTexture(_) => Some(Item::Texture(scene.textures.len())),
            _ => None,
        };
        self.document.edit(edit);
        if let Some(item) = added {
            self.document.selection = Selection::of(item);
        }
    }

    fn delete(&mut self) {
        let item = self.document.selection.item;
        if let Some(user) = user_of(self.document.scene(), item) {
            let text = format!(
                "\"{user}\" still has this {}",
                if matches!(item, Item::Texture(_)) { "texture" } else { "material" }
            );
            self.toasts.warning(text);
        } else {
            self.document.edit(Edit::Remove(item));
        }
    }

    fn expose(&mut self, stops: f64) {
        let mut film = self.document.scene().film;
        film.exposure += stops;
        self.document.edit(Edit::Film(film));
    }

    /// Goes on at once, or asks first where there is something to lose.
    fn go_to(&mut self, ctx: &Context, next: Next) {
        if self.document.is_dirty() {
            self.dialog = Some(Dialog::Unsaved(next));
        } else {
            self.go(ctx, next);
        }
    }

    /// Goes on; what is not saved is lost.
    pub(crate) fn go(&mut self, ctx: &Context, next: Next) {
        match next {
            Next::New => {
                self.replace(SceneFile { scene: new_items::empty_scene(), location: Location::Unsaved });
            }
            Next::Open(path) => self.open(SceneFile::open(&path), &path.display().to_string()),
            Next::Example(name) => self.open(SceneFile::built_in(name), name),
            Next::Quit => {
                self.may_close = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    fn answer(&mut self, ctx: &Context, answer: Answer) {
        let Some(Dialog::Unsaved(next)) = self.dialog.take() else { return };
        match answer {
            Answer::Save => {
                self.after_save = Some(next);
                self.file_action(ctx, Action::Save);
            }
            Answer::Discard => self.go(ctx, next),
            Answer::Cancel => {}
        }
    }

    fn close_dialog(&mut self) {
        self.dialog = None;
        self.after_save = None;
    }
}
