//! A field for a typed path: where no file dialog is available, or where a chosen path did not work.

use super::chooser::Request;
use super::paths::complete;
use crate::app::commands::{AppCommand, Purpose};
use crate::app::theme;
use egui::{Button, Id, Key, TextEdit, Ui};
use std::path::{Path, PathBuf};

/// A path that the user types, for one purpose.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PathField {
    pub(crate) purpose: Purpose,
    text: String,
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
        let text = request.proposal.display().to_string();
        Self { purpose: request.purpose, text, note, error: None }
    }

    /// A field to correct `path`, with the reason why it did not work.
    pub(crate) fn correcting(purpose: Purpose, path: &Path, error: Option<String>) -> Self {
        Self { purpose, text: path.display().to_string(), note: "", error }
    }

    /// The field with its buttons. Enter confirms, but replaces an existing file only after a second confirmation.
    pub(crate) fn ui(&mut self, ui: &mut Ui, commands: &mut Vec<AppCommand>) {
        let palette = theme::palette(ui.visuals().dark_mode);
        ui.heading(self.purpose.title());
        if !self.note.is_empty() {
            ui.label(self.note);
        }
        // A fixed id keeps the keyboard focus when the text above the field changes.
        let field = TextEdit::singleline(&mut self.text).id(Id::unique("typed path")).desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name("Path");
        if field.changed() {
            self.error = None;
        }
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        ui.weak(format!("File types: {}", self.purpose.formats()));
        let path = PathBuf::from(self.text.trim());
        let target = complete(self.purpose, path.clone()).unwrap_or_default();
        let replaces = self.purpose.writes() && target.is_file();
        if let Some(error) = &self.error {
            ui.colored_label(palette.error, error);
        } else if replaces {
            ui.colored_label(palette.warning, format!("{} already exists and will be replaced.", target.display()));
        }
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            let verb = match self.purpose {
                _ if replaces => "Replace",
                Purpose::ExportPicture | Purpose::ExportSurface => "Export",
                Purpose::SaveScene => "Save",
                Purpose::OpenScene | Purpose::AddSurface | Purpose::AddTexture => "Open",
            };
            let is_entered = !self.text.trim().is_empty();
            let button = ui.add_enabled(is_entered, Button::new(verb));
            if button.clicked() || (entered && is_entered && !replaces) {
                commands.push(AppCommand::PathEntered(path));
            } else if entered && is_entered {
                button.request_focus();
            }
            if ui.button("Cancel").clicked() {
                commands.push(AppCommand::CloseDialog);
            }
        });
        if ui.memory(|memory| memory.focused().is_none()) {
            field.request_focus();
        }
    }
}
