//! The properties of a texture.

use super::fields::{rows, text_row};
use super::glossary::caption;
use crate::app::commands::AppCommand;
use crate::app::document::Edit;
use crate::scene::{Encoding, Texture};
use egui::Ui;

/// The texture's name, file and encoding.
pub(super) fn texture_ui(ui: &mut Ui, index: usize, texture: &Texture, commands: &mut Vec<AppCommand>) {
    ui.strong("Texture");
    let mut edited = texture.clone();
    rows(ui, "texture", |ui| {
        text_row(ui, "Name", &mut edited.name, ("texture", index, &texture.name));
        text_row(ui, "File", &mut edited.file, ("texture file", index, &texture.file));
        caption(ui, "Encoding");
        ui.horizontal(|ui| {
            ui.radio_value(&mut edited.encoding, Encoding::Srgb, "sRGB").on_hover_text("The image holds sRGB colours");
            ui.radio_value(&mut edited.encoding, Encoding::Linear, "linear")
                .on_hover_text("The image holds linear values, as normal and height maps do");
        });
        ui.end_row();
    });
    ui.weak("A PNG or JPEG file; a relative path starts at the scene file's folder");
    if edited != *texture {
        commands.push(AppCommand::Edit(Edit::Texture(index, edited)));
    }
}
