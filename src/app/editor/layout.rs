//! Draws the window's content, then carries out the commands that its parts push.

use super::state::Editor;
use crate::app::canvas::Picture;
use crate::app::commands::{AppCommand, action};
use crate::app::comparison::{Shown, strip_ui};
use crate::app::document::Item;
use crate::app::inspection::{legend_ui, line_ui, profile_ui};
use crate::app::panels::{outline_ui, progress_ui, properties_ui, refusals};
use crate::app::rendering::Sampling;
use crate::app::shell::{
    Visibility, dialog_ui, drop_hint_ui, first_hint_ui, guide_ui, history_ui, looking_ui, menu_ui, notices_ui,
    status_bar_ui,
};
use egui::{CentralPanel, Context, Panel, ScrollArea, Ui, UiBuilder};

/// Least width of the window's free part that shows the progress panel, screen points.
const PROGRESS_WIDTH: f32 = 240.0;
/// Least width of the scene panel, screen points: it fits the rows of vectors.
const SCENE_WIDTH: f32 = 372.0;
/// Least width of the picture, screen points: in a narrower window the progress panel gives way.
const PICTURE_WIDTH: f32 = 240.0;

impl Editor {
    /// Takes the results of background threads. Needs no visible window.
    pub(crate) fn poll(&mut self, ctx: &Context) {
        if let Some((request, outcome)) = self.chooser.poll() {
            self.dialog_ended(ctx, request, outcome);
        }
        self.poll_export(ctx);
        self.poll_recovery(ctx);
        self.poll_preferences(ctx);
        self.poll_watch(ctx);
        if let Some(frame) = self.rendering.frame() {
            self.display.show(ctx, frame.shown(), &self.viewpoint.seen().scene.film);
        }
        self.display.poll(ctx);
        self.poll_snapshots(ctx);
        self.poll_inspection(ctx);
    }

    /// Draws the window's content, then carries out the user's requests.
    pub(crate) fn ui(&mut self, ui: &mut Ui) {
        let mut commands = Vec::new();
        self.viewpoint.follow(self.document.file());
        if self.dialog.is_some() {
            // Under a dialog no widget reacts and no tooltip opens. The dialog dims the window itself.
            ui.disable();
            ui.set_opacity(1.0);
        } else {
            commands.extend(action::pressed(ui.ctx()).into_iter().map(AppCommand::Do));
            commands.extend(dropped_files(ui.ctx()));
        }
        self.bars_ui(ui, &mut commands);
        if self.show_panels {
            self.panels_ui(ui, &mut commands);
        }
        if self.show_panels && !self.snapshots.is_empty() {
            Panel::bottom("snapshots").show(ui, |ui| {
                let present = self.rendering.frame().map(|frame| &frame.image);
                strip_ui(ui, &self.snapshots, present, &mut commands);
            });
        }
        CentralPanel::no_frame().show(ui, |ui| self.canvas_ui(ui, &mut commands));
        if let Some(dialog) = &mut self.dialog {
            dialog_ui(ui.ctx(), dialog, &self.document, &mut commands);
        }
        drop_hint_ui(ui.ctx());
        for message in refusals(ui.ctx()) {
            self.toasts.warning(message);
        }
        self.toasts.show(ui.ctx());
        for command in commands {
            self.apply(ui.ctx(), command);
        }
        let (is_down, time) = ui.input(|input| (input.pointer.any_down(), input.time));
        let canvas = &self.canvas;
        if !is_down && !canvas.navigation.is_wheel_turning(time) && !canvas.grasp.is_nudging(time) {
            self.end_gesture();
        }
        self.match_window(ui.ctx());
        self.rendering.submit(self.viewpoint.seen());
    }

    fn bars_ui(&self, ui: &mut Ui, commands: &mut Vec<AppCommand>) {
        let canvas = &self.canvas;
        let visible = Visibility {
            navigate: canvas.navigation.always,
            look_around: self.viewpoint.looks_around(),
            match_window: canvas.matches_window,
            smooth: self.rendering.is_smooth(),
            handles: canvas.show_handles,
            x_ray: canvas.sight.x_ray,
            analysis: canvas.analysis.analysis,
            light_paths: canvas.light_paths.on,
            view: self.inspection.view(),
            only: self.rendering.only(),
            falloff: canvas.grasp.falloff.on,
            grid: canvas.grasp.grid,
            panels: self.show_panels,
            length_unit: self.length_unit,
            history: self.show_history,
            guide: self.show_guide,
        };
        Panel::top("menu").show(ui, |ui| {
            menu_ui(ui, &self.document, self.recent.paths(), self.rendering.is_paused(), visible, commands);
        });
        let film = &self.viewpoint.seen().scene.film;
        Panel::bottom("status").show(ui, |ui| status_bar_ui(ui, film, &self.rendering, &self.canvas));
    }

    fn panels_ui(&mut self, ui: &mut Ui, commands: &mut Vec<AppCommand>) {
        let widest = ui.available_width() - SCENE_WIDTH - PICTURE_WIDTH;
        if widest >= PROGRESS_WIDTH {
            let size = self.panel_sizes.progress;
            let panel = Panel::left("progress").default_size(size).size_range(200.0..=widest).show(ui, |ui| {
                contained(ui, |ui| {
                    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                        progress_ui(ui, &self.document, &self.rendering, commands);
                    });
                });
            });
            self.panel_sizes.progress = panel.response.rect.width();
        }
        let widest = (ui.available_width() - PICTURE_WIDTH).max(SCENE_WIDTH);
        let size = self.panel_sizes.scene;
        let panel = Panel::right("scene").default_size(size).size_range(SCENE_WIDTH..=widest).show(ui, |ui| {
            contained(ui, |ui| self.scene_ui(ui, commands));
        });
        self.panel_sizes.scene = panel.response.rect.width();
    }

    fn scene_ui(&mut self, ui: &mut Ui, commands: &mut Vec<AppCommand>) {
        let (wanted, half) = (self.panel_sizes.outline, 0.5 * ui.available_height());
        // A window that is too low for the wanted height has a height of its own, and the wanted one stays for a higher window.
        let (id, outline) = if wanted > half { ("low outline", half) } else { ("outline", wanted) };
        // The properties stay visible in a low window.
        let highest = (0.6 * ui.available_height()).max(80.0);
        let panel = Panel::top(id).resizable(true).default_size(outline).size_range(80.0..=highest);
        let panel = panel.show(ui, |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| outline_ui(ui, &self.document, commands));
        });
        if wanted <= half {
            self.panel_sizes.outline = panel.response.rect.height();
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.add_space(4.0);
            properties_ui(ui, &self.document, self.length_unit, commands);
        });
    }

    fn canvas_ui(&mut self, ui: &mut Ui, commands: &mut Vec<AppCommand>) {
        let canvas = ui.available_rect_before_wrap();
        let film = &self.viewpoint.seen().scene.film;
        let present = self.rendering.frame().map(|frame| &frame.image);
        let compared = self.snapshots.shown(present);
        let (texture, image) = match &compared {
            Some(Shown { texture: Some(texture), image, .. }) => (Some(*texture), *image),
            _ => (self.inspection.texture().or(self.display.texture()), present.map(|image| &**image)),
        };
        let picture = Picture {
            texture,
            image: image.filter(|image| (image.width, image.height) == (film.width, film.height)),
            current: self.rendering.is_current() || compared.as_ref().is_some_and(|shown| shown.texture.is_some()),
            beside: compared.as_ref().and_then(|shown| shown.beside),
        };
        self.canvas.show(ui, &self.document, &self.viewpoint.seen().scene, picture, commands);
        if let Some(transform) = self.canvas.transform {
            ui.scope(|ui| {
                ui.set_clip_rect(transform.canvas);
                line_ui(ui, &self.inspection, transform.picture(), transform.film, commands);
            });
        }
        // In this frame, because no other may follow.
        let scale = self.canvas.transform.map_or(1.0, |transform| transform.scale * ui.ctx().pixels_per_point());
        self.display.sample(ui.ctx(), Sampling::at(scale));
        if self.show_hint && self.dialog.is_none() && self.document.undoable().is_none() {
            first_hint_ui(ui, canvas, commands);
        }
        // Notices lie over the picture, so the picture stays in place when they come and go.
        ui.scope_builder(UiBuilder::new().max_rect(canvas), |ui| {
            if self.viewpoint.looks_around() {
                looking_ui(ui, commands);
            }
            let unreadable = self.unreadable.as_deref();
            notices_ui(ui, self.document.scene(), &self.rendering, &self.chooser, unreadable, commands);
        });
        if compared.is_none() {
            let scene = self.document.scene();
            let selected = match self.document.selection.item {
                Item::Object(index) => scene.objects.get(index).map(|object| (object.name.as_str(), index)),
                _ => None,
            };
            let error = self.rendering.full_frame().and_then(|frame| frame.stats.error_estimate);
            legend_ui(ui, canvas, &self.inspection, self.canvas.pixel, selected, error);
            profile_ui(ui, canvas, &self.inspection, commands);
        }
        if self.show_guide && self.dialog.is_none() {
            guide_ui(ui.ctx(), canvas, &mut self.guide, commands);
        }
        if self.show_history && self.dialog.is_none() {
            history_ui(ui.ctx(), canvas, &self.document, commands);
        }
    }
}

/// Shows the content of a panel. Only the user resizes a panel: content that is too wide is clipped.
fn contained(ui: &mut Ui, content: impl FnOnce(&mut Ui)) {
    let rect = ui.available_rect_before_wrap();
    let mut child = ui.new_child(UiBuilder::new().max_rect(rect));
    child.set_clip_rect(rect.intersect(ui.clip_rect()));
    content(&mut child);
    ui.advance_cursor_after_rect(rect);
}

/// A command for each file that was dropped onto the window in this frame.
fn dropped_files(ctx: &Context) -> Vec<AppCommand> {
    ctx.input(|input| input.raw.dropped_files.iter().map(|file| AppCommand::Drop(file.path().to_path_buf())).collect())
}
