//! A path that is typed: where no file dialog can be had, or where what was chosen did not work.

use super::chooser::{Purpose, Request};
use crate::app::commands::AppCommand;
use crate::app::theme;
use egui::{Button, Id, Key, TextEdit, Ui};
use std::path::PathBuf;

/// Longer words are no extensions.
const LONGEST_EXTENSION: usize = 5;

/// The path as it is typed now.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PathField {
    pub(crate) purpose: Purpose,
    text: String,
    /// Why there is no file dialog.
    note: &'static str,
    /// Why the path that was entered last does not serve.
    error: Option<String>,
}

impl PathField {
    /// In place of a file dialog.
    pub(crate) fn instead(request: Request) -> Self {
        let note = "This desktop shows no file dialog (it takes xdg-desktop-portal or zenity). Type the path here:";
        let text = request.proposal.display().to_string();
        Self { purpose: request.purpose, text, note, error: None }
    }

    /// Once more, after this path.
    pub(crate) fn again(purpose: Purpose, path: &std::path::Path, error: Option<String>) -> Self {
        Self { purpose, text: path.display().to_string(), note: "", error }
    }

    /// The field with its buttons. Enter confirms; it asks again before it replaces a file.
    pub(crate) fn ui(&mut self, ui: &mut Ui, commands: &mut Vec<AppCommand>) {
        let palette = theme::palette(ui.visuals().dark_mode);
        ui.heading(self.purpose.title());
        if !self.note.is_empty() {
            ui.label(self.note);
        }
        // An id of its own: it keeps the keyboard when the text above it comes or goes.
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
            ui.colored_label(palette.warning, format!("{} exists and will be replaced.", target.display()));
        }
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            let verb = match self.purpose {
                _ if replaces => "Replace",
                Purpose::ExportPicture | Purpose::ExportSurface => "Export",
                Purpose::SaveScene => "Save",
                Purpose::OpenScene | Purpose::AddSurface | Purpose::AddTexture => "Open",
            };
            let usable = !self.text.trim().is_empty();
            let button = ui.add_enabled(usable, Button::new(verb));
            if button.clicked() || (entered && usable && !replaces) {
                commands.push(AppCommand::PathEntered(path));
            } else if entered && usable {
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

/// The path with an extension that this purpose knows, or why it cannot have one.
pub(crate) fn complete(purpose: Purpose, path: PathBuf) -> Result<PathBuf, String> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    let known = |extension: &String| purpose.extensions().contains(&extension.as_str());
    if !purpose.writes() || extension.as_ref().is_some_and(known) {
        return Ok(path);
    }
    let is_extension = |text: &String| {
        text.len() <= LONGEST_EXTENSION
            && text.starts_with(|c: char| c.is_ascii_alphabetic())
            && text.chars().all(|c| c.is_ascii_alphanumeric())
    };
    if let Some(other) = extension.filter(is_extension) {
        return Err(format!("A .{other} file cannot be written."));
    }
    // Appended, not replaced: in "view 1.5" the 5 is no extension.
    let mut name = path.into_os_string();
    name.push(".");
    name.push(purpose.extensions()[0]);
    Ok(PathBuf::from(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_extension_is_appended_and_another_refused() {
        let path = |purpose, path: &str| complete(purpose, PathBuf::from(path)).map(|path| path.display().to_string());
        assert_eq!(path(Purpose::ExportPicture, "a/view 1.5"), Ok("a/view 1.5.png".to_owned()));
        assert_eq!(path(Purpose::ExportPicture, "a/b.EXR"), Ok("a/b.EXR".to_owned()));
        assert_eq!(path(Purpose::SaveScene, "room"), Ok("room.toml".to_owned()));
        assert_eq!(path(Purpose::OpenScene, "room"), Ok("room".to_owned()));
        assert_eq!(path(Purpose::ExportPicture, "x.bmp"), Err("A .bmp file cannot be written.".to_owned()));
    }
}
