//! A field for a typed path: where no file dialog is available, or where a chosen path did not work.

use super::chooser::Request;
use super::paths::{complete, typed};
use crate::app::commands::{AppCommand, Purpose};
use crate::app::theme;
use egui::text::{CCursor, CCursorRange};
use egui::text_edit::TextEditState;
use egui::{Button, Id, Key, Response, RichText, TextEdit, Ui};
use std::path::{Path, PathBuf};

/// A path that the user types, for one purpose.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PathField {
    pub(crate) purpose: Purpose,
    text: String,
    /// The folder that a relative path starts at.
    folder: PathBuf,
    /// Whether the user has not typed yet: the first key replaces the text.
    untouched: bool,
    /// The reason for typing, above the field.
    note: &'static str,
    /// The reason why the last entered path did not work.
    error: Option<String>,
}

impl PathField {
    /// A field in place of a file dialog that is unavailable.
    pub(crate) fn instead_of_dialog(request: Request) -> Self {
        let note =
            "No file dialog is available: this desktop has neither xdg-desktop-portal nor zenity. Type the path here:";
        let (purpose, text) = (request.purpose, request.proposal.display().to_string());
        // To read a file, the proposal is a folder.
        let parent = request.proposal.parent().filter(|_| purpose.writes()).map(Path::to_path_buf);
        Self { purpose, text, folder: parent.unwrap_or(request.proposal), untouched: true, note, error: None }
    }

    /// A field to correct `path`, with the reason why it did not work.
    pub(crate) fn correcting(purpose: Purpose, path: &Path, error: Option<String>) -> Self {
        let folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
        Self { purpose, text: path.display().to_string(), folder, untouched: false, note: "", error }
    }

    /// The field with its buttons. Enter confirms, but replaces an existing file only after a second confirmation.
    pub(crate) fn ui(&mut self, ui: &mut Ui, commands: &mut Vec<AppCommand>) {
        ui.heading(self.purpose.title());
        if !self.note.is_empty() {
            ui.label(self.note);
        }
        let field = self.text_ui(ui);
        let confirmed = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        ui.weak(format!("File types: {}", self.purpose.formats()));
        let replaced = self.replaced_file();
        self.message_ui(ui, replaced.as_deref());
        ui.add_space(4.0);
        ui.horizontal(|ui| self.buttons_ui(ui, confirmed, replaced.is_some(), commands));
        if ui.memory(|memory| memory.focused().is_none()) {
            field.request_focus();
            if self.untouched {
                self.select_all(ui, field.id);
            }
        }
    }

    fn text_ui(&mut self, ui: &mut Ui) -> Response {
        // A fixed id keeps the keyboard focus when the text above the field changes.
        let field = TextEdit::singleline(&mut self.text).id(Id::unique("typed path")).desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name("Path");
        if field.changed() {
            self.untouched = false;
            self.error = None;
        }
        field
    }

    fn select_all(&self, ui: &Ui, id: Id) {
        let mut state = TextEditState::load(ui.ctx(), id).unwrap_or_default();
        let whole = CCursorRange::two(CCursor::new(0), CCursor::new(self.text.chars().count()));
        state.cursor.set_char_range(Some(whole));
        state.store(ui.ctx(), id);
    }

    /// The existing file that this path would replace; `None` for a new file, and for a file to read.
    fn replaced_file(&self) -> Option<PathBuf> {
        let target = complete(self.purpose, self.path()).ok()?;
        (self.purpose.writes() && target.is_file()).then_some(target)
    }

    fn message_ui(&self, ui: &mut Ui, replaced: Option<&Path>) {
        let palette = theme::palette(ui.visuals().dark_mode);
        if let Some(error) = &self.error {
            ui.colored_label(palette.error, error);
        } else if let Some(replaced) = replaced {
            ui.colored_label(palette.warning, format!("{} already exists and will be replaced.", replaced.display()));
        }
    }

    /// The buttons. `confirmed` by Enter acts as the first button, or focuses it where that would replace a file.
    fn buttons_ui(&self, ui: &mut Ui, confirmed: bool, replaces: bool, commands: &mut Vec<AppCommand>) {
        let verb = match self.purpose {
            _ if replaces => "Replace",
            Purpose::ExportPicture
            | Purpose::ExportShown
            | Purpose::ExportDeep
            | Purpose::ExportSurface
            | Purpose::ExportProfile => "Export",
            Purpose::SaveScene => "Save",
            Purpose::OpenScene | Purpose::AddSurface | Purpose::AddTexture | Purpose::OpenReference => "Open",
        };
        let is_entered = !self.text.trim().is_empty();
        let selection = ui.visuals().selection;
        let primary = Button::new(RichText::new(verb).color(selection.stroke.color)).fill(selection.bg_fill);
        let button = ui.add_enabled(is_entered, primary);
        if button.clicked() || (confirmed && is_entered && !replaces) {
            commands.push(AppCommand::PathEntered(self.path()));
        } else if confirmed && is_entered {
            button.request_focus();
        }
        if ui.button("Cancel").clicked() {
            commands.push(AppCommand::CloseDialog);
        }
    }

    fn path(&self) -> PathBuf {
        typed(&self.text, &self.folder, std::env::home_dir())
    }
}
