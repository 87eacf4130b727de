//! The editor in a desktop window, with an engine.

use crate::app::commands::{AppCommand, Next};
use crate::app::editor::Editor;
use crate::app::keeping::{Folders, LoadedPreferences};
use crate::app::keyboard;
use crate::app::theme;
use crate::engine::{Engine, EngineError, EngineSettings};
use crate::scene::SceneFile;
use eframe::{App, CreationContext, Frame};
use egui::{Context, Ui, ViewportCommand};

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
        if let Some((folders, loaded)) = kept {
            editor.keep_in(&creation.egui_ctx, &folders, loaded);
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

impl App for Window {
    fn logic(&mut self, ctx: &Context, _frame: &mut Frame) {
        self.exchange();
        self.editor.poll(ctx);
        if ctx.input(|input| input.viewport().close_requested())
            && !self.editor.may_close
            && self.editor.document.is_dirty()
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
