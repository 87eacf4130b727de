//! The window's content, without the window and without the engine: frames come in, commands go out.

use crate::app::canvas::{Canvas, Picture};
use crate::app::commands::{AppCommand, Next, action};
use crate::app::document::Document;
use crate::app::files::{Chooser, Export};
use crate::app::panels::{outline_ui, progress_ui, properties_ui};
use crate::app::rendering::{Display, Rendering};
use crate::app::shell::{self, Dialog, menu_ui, notices_ui, status_bar_ui};
use crate::engine::{self, Frame, Status};
use crate::scene::{Problem, SceneFile, validate};
use egui::{CentralPanel, Context, Panel, ScrollArea, Ui, UiBuilder};
use egui_notify::{Anchor, Toasts};
use std::sync::Arc;

/// Enough for every section of a scene with ten objects, screen points.
const OUTLINE_HEIGHT: f32 = 390.0;

/// All that the window shows and remembers. The document changes in `apply` alone.
pub(crate) struct Editor {
    pub(crate) document: Document,
    pub(crate) rendering: Rendering,
    pub(crate) canvas: Canvas,
    pub(crate) display: Display,
    pub(crate) chooser: Chooser,
    pub(crate) export: Export,
    pub(crate) dialog: Option<Dialog>,
    pub(crate) toasts: Toasts,
    /// What to go on to once the scene is saved.
    pub(crate) after_save: Option<Next>,
    pub(crate) show_panels: bool,
    /// The user has agreed to lose or has saved what there was.
    pub(crate) may_close: bool,
    /// Why the scene as it is now cannot be rendered.
    pub(crate) problems: Vec<Problem>,
    /// For the engine, in this order.
    pub(crate) outbox: Vec<engine::Command>,
    checked: Option<Arc<SceneFile>>,
    pub(super) rendered: Option<Arc<SceneFile>>,
}

impl Editor {
    /// Begins with a scene.
    pub(crate) fn new(file: SceneFile) -> Self {
        let mut editor = Self {
            document: Document::new(file),
            rendering: Rendering::default(),
            canvas: Canvas::default(),
            display: Display::default(),
            chooser: Chooser::default(),
            export: Export::default(),
            dialog: None,
            toasts: Toasts::default().with_anchor(Anchor::BottomLeft).with_margin(egui::vec2(12.0, 34.0)),
            after_save: None,
            show_panels: true,
            may_close: false,
            problems: Vec::new(),
            outbox: Vec::new(),
            checked: None,
            rendered: None,
        };
        editor.outbox.push(engine::Command::Target(editor.rendering.target));
        editor.send_scene();
        editor
    }

    /// Takes what the engine has made since.
    pub(crate) fn receive(&mut self, frame: Option<Arc<Frame>>, status: Status) {
        self.rendering.set_status(status);
        if let Some(frame) = frame {
            self.rendering.receive(frame);
        }
    }

    /// What background threads have finished since; needs no visible window.
    pub(crate) fn poll(&mut self, ctx: &Context) {
        if let Some((request, outcome)) = self.chooser.poll() {
            self.chosen(ctx, request, outcome);
        }
        self.poll_export(ctx);
        if let Some(frame) = self.rendering.frame() {
            self.display.show(ctx, &frame.image, &self.document.scene().film);
        }
        self.display.poll(ctx);
    }

    /// Draws everything, then does what the user asked for.
    pub(crate) fn ui(&mut self, ui: &mut Ui) {
        let mut commands = Vec::new();
        if self.dialog.is_some() {
            // What lies under a dialog does not react and shows no tips; the dialog itself dims it.
            ui.disable();
            ui.set_opacity(1.0);
        } else {
            commands.extend(action::pressed(ui.ctx()).into_iter().map(AppCommand::Do));
            commands.extend(shell::dropped_files(ui.ctx()));
        }
        Panel::top("menu").show(ui, |ui| menu_ui(ui, self, &mut commands));
        Panel::bottom("status").show(ui, |ui| status_bar_ui(ui, self));
        if self.show_panels {
            self.panels_ui(ui, &mut commands);
        }
        CentralPanel::no_frame().show(ui, |ui| {
            let canvas = ui.available_rect_before_wrap();
            let current = self.problems.is_empty() && !matches!(self.rendering.status(), Status::Failed(_));
            let picture = Picture { texture: self.display.texture(), current };
            self.canvas.show(ui, &self.document, picture, &mut commands);
            // Over the picture, which therefore stays where it is when they come and go.
            ui.scope_builder(UiBuilder::new().max_rect(canvas), |ui| notices_ui(ui, self, &mut commands));
        });
        shell::dialog_ui(ui.ctx(), self, &mut commands);
        self.toasts.show(ui.ctx());
        for command in commands {
            self.apply(ui.ctx(), command);
        }
        if !ui.input(|input| input.pointer.any_down()) {
            self.document.end_gesture();
        }
        self.send_scene();
    }

    fn panels_ui(&self, ui: &mut Ui, commands: &mut Vec<AppCommand>) {
        Panel::left("progress").default_size(240.0).min_size(200.0).show(ui, |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                progress_ui(ui, &self.document, &self.rendering, commands);
            });
        });
        Panel::right("scene").default_size(372.0).min_size(370.0).show(ui, |ui| {
            let outline = OUTLINE_HEIGHT.min(0.5 * ui.available_height());
            Panel::top("outline").resizable(true).default_size(outline).min_size(80.0).show(ui, |ui| {
                ScrollArea::vertical().auto_shrink(false).show(ui, |ui| outline_ui(ui, &self.document, commands));
            });
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                ui.add_space(4.0);
                properties_ui(ui, &self.document, commands);
            });
        });
    }

    /// Sends the scene to the engine if it can be rendered and its picture would be another one.
    fn send_scene(&mut self) {
        let file = self.document.file();
        if self.checked.as_ref().is_some_and(|checked| Arc::ptr_eq(checked, file)) {
            return;
        }
        self.checked = Some(Arc::clone(file));
        self.problems = validate(&file.scene);
        let same = self.rendered.as_ref().is_some_and(|rendered| same_picture(rendered, file));
        if self.problems.is_empty() && !same {
            self.rendered = Some(Arc::clone(file));
            self.outbox.push(engine::Command::Show(Arc::clone(file)));
        }
    }
}

/// Whether two scenes have the same radiance in every pixel: names of things do not count, nor how the picture is shown.
pub(super) fn same_picture(a: &SceneFile, b: &SceneFile) -> bool {
    let without_display = |file: &SceneFile| {
        let mut scene = file.scene.clone();
        scene.name.clear();
        (scene.film.exposure, scene.film.tone_curve) = Default::default();
        scene
    };
    a.location == b.location && without_display(a) == without_display(b)
}
