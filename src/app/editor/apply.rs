//! The one place that carries out commands.

use super::state::Editor;
use crate::app::commands::{Action, AppCommand, Comparison, Next, Purpose};
use crate::app::document::surface::Cut;
use crate::app::document::{Direction, Edit, Item, new_items, user_of};
use crate::app::shell::{Dialog, Palette};
use crate::scene::Film;
use egui::{Context, ViewportCommand};

/// Factor of one step of the zoom keys.
const ZOOM_STEP: f32 = 1.25;
/// One step of the exposure keys, stops.
const EXPOSURE_STEP: f64 = 0.5;

impl Editor {
    /// Carries out a command.
    pub(crate) fn apply(&mut self, ctx: &Context, command: AppCommand) {
        self.carry_out(ctx, command);
        self.viewpoint.follow(self.document.file());
    }

    fn carry_out(&mut self, ctx: &Context, command: AppCommand) {
        match command {
            AppCommand::Do(action) => self.act(ctx, action),
            AppCommand::Edit(edit) => self.edit(edit),
            AppCommand::Select(selection) => self.select(selection),
            AppCommand::View(camera, name) => self.show_camera(camera, name),
            AppCommand::Couple(coupling) => self.document.coupling = coupling,
            AppCommand::Add(new) => self.add(new),
            AppCommand::AddFrom(purpose) => self.ask_for_path(ctx, purpose),
            AppCommand::Drop(path) => self.drop_file(ctx, path),
            AppCommand::GoTo(done) => self.document.go_to(done),
            AppCommand::CancelDrag => self.cancel_drag(),
            AppCommand::Leave(next) => self.leave(ctx, next),
            AppCommand::Answer(answer) => self.answer(ctx, answer),
            AppCommand::Replace(path) => self.replace(ctx, path),
            AppCommand::DiscardLeftOver(index) => self.discard_left_over(index),
            AppCommand::ClearRecent => self.recent.clear(),
            AppCommand::Reload => self.reload(),
            AppCommand::KeepMine => self.keep_mine(),
            AppCommand::PathEntered(path) => self.path_entered(ctx, path),
            AppCommand::TypePath => self.ask_for_typed_path(),
            AppCommand::CloseDialog => self.close_dialog(),
            AppCommand::CloseHint => self.show_hint = false,
            AppCommand::ExportSurface(options) => self.ask_for_surface_path(ctx, options),
            AppCommand::Show(view) => self.show_of_scene(view),
            AppCommand::Only(component) => self.rendering.set_only(component),
            AppCommand::ProfileLine(line) => self.inspection.set_line(line),
            AppCommand::Snapshot(command) => self.change_snapshots(command),
            AppCommand::Grid(step) => self.canvas.grasp.grid = step,
            AppCommand::LengthUnit(unit) => self.length_unit = unit,
            AppCommand::Theme(theme) => ctx.set_theme(theme),
            AppCommand::Limits(limits) => self.rendering.set_limits(limits),
            AppCommand::Target(target) => self.rendering.set_target(target),
        }
    }

    fn act(&mut self, ctx: &Context, action: Action) {
        match action {
            Action::New => self.leave(ctx, Next::New),
            Action::Open => self.ask_for_path(ctx, Purpose::OpenScene),
            Action::Save => self.save(ctx),
            Action::SaveAs => self.save_as(ctx),
            Action::Export => self.ask_for_path(ctx, Purpose::ExportPicture),
            Action::ExportShown => self.ask_for_path(ctx, Purpose::ExportShown),
            Action::CopyPicture => self.copy_picture(ctx),
            Action::ExportDeep => self.ask_for_path(ctx, Purpose::ExportDeep),
            Action::ExportSurface => self.ask_for_surface(),
            Action::Quit => self.leave(ctx, Next::Quit),
            Action::Undo => self.document.undo(),
            Action::Redo => self.document.redo(),
            Action::ToggleHistory => self.show_history = !self.show_history,
            Action::Duplicate => self.duplicate(),
            Action::Delete => self.delete(),
            Action::SplitU => self.split(Cut::U),
            Action::SplitV => self.split(Cut::V),
            Action::SplitBoth => self.split(Cut::Both),
            Action::Flatten | Action::Smooth | Action::ResetPoints => self.fair(action),
            Action::ToggleTangents => self.document.coupling.tangents = !self.document.coupling.tangents,
            Action::NextMirror => self.next_mirror(),
            Action::ConvertToPatches => self.convert_to_patches(),
            Action::Thicken => self.thicken(),
            Action::MirrorCopyX => self.mirror_copy(0),
            Action::MirrorCopyY => self.mirror_copy(1),
            Action::MirrorCopyZ => self.mirror_copy(2),
            Action::TogglePause => self.rendering.toggle_pause(),
            Action::Restart => self.rendering.restart(),
            Action::Fit => self.canvas.fit(),
            Action::OneToOne => self.canvas.one_to_one(ctx.pixels_per_point()),
            Action::ZoomIn => self.canvas.zoom(ZOOM_STEP),
            Action::ZoomOut => self.canvas.zoom(1.0 / ZOOM_STEP),
            Action::Brighter => self.expose(EXPOSURE_STEP),
            Action::Darker => self.expose(-EXPOSURE_STEP),
            Action::View(view) => self.show_view(view),
            Action::Navigate => self.canvas.navigation.always = !self.canvas.navigation.always,
            Action::LookAround => self.toggle_look_around(),
            Action::UseView => self.use_view(),
            Action::MatchWindow => self.canvas.matches_window = !self.canvas.matches_window,
            Action::ToggleSmoothing => self.rendering.set_smooth(!self.rendering.is_smooth()),
            Action::ToggleHandles => self.canvas.show_handles = !self.canvas.show_handles,
            Action::ToggleXRay => self.canvas.sight.x_ray = !self.canvas.sight.x_ray,
            Action::SelectAll => self.select_all(),
            Action::SelectNone => self.select_none(),
            Action::SelectRectangle => self.select_rectangle(),
            Action::SelectRow => self.select_lines(Direction::Row),
            Action::SelectColumn => self.select_lines(Direction::Column),
            Action::ToggleFalloff => self.toggle_falloff(),
            Action::ToggleIsolines
            | Action::ToggleMeanCurvature
            | Action::ToggleGaussianCurvature
            | Action::ToggleZebra => self.canvas.analysis.analysis.toggle(action),
            Action::ToggleLightPaths => self.canvas.light_paths.on = !self.canvas.light_paths.on,
            Action::ToggleIrradiance => self.toggle_irradiance(),
            Action::DrawProfile => self.draw_profile(),
            Action::ExportProfile => self.export_profile(ctx),
            Action::TakeSnapshot => self.take_snapshot(),
            Action::OpenReference => self.ask_for_path(ctx, Purpose::OpenReference),
            Action::CompareFlip => self.toggle_comparison(Comparison::Flip),
            Action::CompareSplit => self.toggle_comparison(Comparison::Split),
            Action::CompareDifference => self.toggle_comparison(Comparison::Difference),
            Action::TogglePanels => self.show_panels = !self.show_panels,
            Action::FullScreen => toggle_full_screen(ctx),
            Action::Palette => self.dialog = Some(Dialog::Palette(Palette::default())),
            Action::ToggleGuide => self.show_guide = !self.show_guide,
            Action::Help => self.dialog = Some(Dialog::Help),
        }
    }

    /// Edits the scene. A name that another item has becomes a free name, with a message; a texture's file that is no
    /// picture gets a message.
    fn edit(&mut self, mut edit: Edit) {
        if let Edit::Texture(index, texture) = &edit
            && self.document.scene().textures.get(*index).is_some_and(|before| before.file != texture.file)
            && let Err(error) = self.document.file().location.check_picture(&texture.file)
        {
            self.toasts.warning(error);
        }
        if let Some(free) = edit.free_its_name(self.document.scene()) {
            self.toasts.info(format!("This name is taken, so the new name is \"{free}\""));
        }
        self.document.edit(edit);
    }

    fn duplicate(&mut self) {
        if let Some(edit) = new_items::duplicate(&self.viewpoint.seen().scene, self.document.selection.item) {
            self.document.edit(edit);
        }
    }

    /// Deletes the selected item; warns where another item uses it, and where control points are selected.
    fn delete(&mut self) {
        let item = self.document.selection.item;
        if !self.document.selection.points.is_empty() {
            self.toasts.warning(
                "A patch keeps its 16 control points. To delete the object, select it by its square handle or in the list.",
            );
            return;
        }
        let kind = if matches!(item, Item::Texture(_)) { "texture" } else { "material" };
        if let Some(user) = user_of(self.document.scene(), item) {
            self.toasts.warning(format!("\"{user}\" uses this {kind}"));
        } else {
            self.document.edit(Edit::Remove(item));
        }
    }

    fn expose(&mut self, stops: f64) {
        let mut film = self.document.scene().film;
        film.exposure = (film.exposure + stops).clamp(-Film::MOST_EXPOSURE, Film::MOST_EXPOSURE);
        self.document.edit(Edit::Film(film));
    }

    fn close_dialog(&mut self) {
        if let Some(Dialog::Recovery(_)) = self.dialog.take() {
            self.left_overs.release();
        }
        self.outside = None;
        self.after_save = None;
    }
}

fn toggle_full_screen(ctx: &Context) {
    let is_full = ctx.input(|input| input.viewport().fullscreen.unwrap_or(false));
    ctx.send_viewport_cmd(ViewportCommand::Fullscreen(!is_full));
}
