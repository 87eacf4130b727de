//! The editor in a desktop window, with an engine.

use crate::app::commands::{AppCommand, Next};
use crate::app::editor::Editor;
use crate::app::keeping::{Folders, LoadedPreferences, WindowPlace};
use crate::app::keyboard;
use crate::app::theme;
use crate::engine::{Engine, EngineError, EngineSettings};
use crate::scene::SceneFile;
use eframe::{App, CreationContext, Frame};
use egui::{Context, Rect, Ui, ViewportCommand, pos2, vec2};

/// The desktop window: an editor and the engine that renders its scene.
pub(crate) struct Window {
    editor: Editor,
    engine: Engine,
    title: String,
}

impl Window {
    /// Starts an engine and sends it the scene. Without `kept`, nothing outlives the window but the files that the user saves.
    ///
    /// # Errors
    /// Returns an error when the engine's thread or thread pool cannot start.
    pub(crate) fn new(
        creation: &CreationContext<'_>,
        file: SceneFile,
        kept: Option<(Folders, LoadedPreferences)>,
    ) -> Result<Self, EngineError> {
        theme::install(&creation.egui_ctx);
        keyboard::install(&creation.egui_ctx);
        let ctx = creation.egui_ctx.clone();
        let engine = Engine::start(EngineSettings::default(), move || ctx.request_repaint())?;
        let mut editor = Editor::new(file);
        editor.open_snapshots();
        if let Some((folders, loaded)) = kept {
            editor.keep_in(&creation.egui_ctx, &folders, loaded);
        }
        if let (Some(place), Some(window)) = (editor.window_place, creation.winit_window()) {
            bring_within_reach(&creation.egui_ctx, place, &monitors(window));
        }
        Ok(Self { editor, engine, title: String::new() })
    }

    /// All that the window shows.
    pub(crate) fn editor(&self) -> &Editor {
        &self.editor
    }

    /// Lets the window close without asking about unsaved changes.
    pub(crate) fn discard(&mut self) {
        self.editor.may_close = true;
    }

    /// Sends the editor's commands to the engine, and takes the engine's newest frame.
    fn exchange(&mut self) {
        for command in self.editor.rendering.take_commands() {
            self.engine.send(command);
        }
        self.editor.rendering.receive(self.engine.newest_frame(), self.engine.status());
    }

    fn update_title(&mut self, ctx: &Context) {
        let title = format!("{} - patchlight", self.editor.document.title());
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }
}

/// Moves a window to the first monitor if the monitor of its remembered place is gone.
fn bring_within_reach(ctx: &Context, place: WindowPlace, monitors: &[Rect]) {
    if let [first, ..] = monitors
        && !place.is_reachable(monitors)
    {
        ctx.send_viewport_cmd(ViewportCommand::OuterPosition(first.min + vec2(40.0, 40.0)));
    }
}

/// The monitors of the desktop, screen points.
fn monitors(window: &winit::window::Window) -> Vec<Rect> {
    let points = |pixels: f64| (pixels / window.scale_factor()) as f32;
    let rect = |monitor: winit::monitor::MonitorHandle| {
        let (corner, size) = (monitor.position(), monitor.size());
        let corner = pos2(points(corner.x.into()), points(corner.y.into()));
        Rect::from_min_size(corner, vec2(points(size.width.into()), points(size.height.into())))
    };
    window.available_monitors().map(rect).collect()
}

impl App for Window {
    fn logic(&mut self, ctx: &Context, _frame: &mut Frame) {
        self.exchange();
        self.editor.poll(ctx);
        if ctx.input(|input| input.viewport().close_requested()) && !self.editor.may_close && self.editor.has_unsaved()
        {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.editor.apply(ctx, AppCommand::Leave(Next::Quit));
        }
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut Frame) {
        self.editor.ui(ui);
        self.exchange();
        self.update_title(ui.ctx());
    }
}
