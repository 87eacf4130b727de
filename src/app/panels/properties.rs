//! The properties of the selected item.

use super::lengths::Lengths;
use super::{lights, materials, objects, settings, textures};
use crate::app::commands::{AppCommand, LengthUnit};
use crate::app::document::{Document, Item};
use egui::Ui;

/// The properties of the selected item.
pub(crate) fn properties_ui(ui: &mut Ui, document: &Document, unit: LengthUnit, commands: &mut Vec<AppCommand>) {
    let scene = document.scene();
    let lengths = &Lengths::of(&scene.camera, unit);
    match document.selection.item {
        Item::Nothing => {
            ui.weak("Nothing is selected. Click an item above or a handle in the picture.");
        }
        Item::Camera => settings::camera_ui(ui, document, lengths, commands),
        Item::Settings => settings::settings_ui(ui, document, commands),
        Item::Object(index) => {
            if let Some(object) = scene.objects.get(index) {
                objects::object_ui(ui, document, index, object, lengths, commands);
            }
        }
        Item::Material(index) => {
            ui.strong("Material");
            materials::material_ui(ui, document, index, materials::Naming::Editable, lengths, commands);
        }
        Item::Light(index) => {
            if let Some(light) = scene.lights.get(index) {
                lights::light_ui(ui, index, light, lengths, commands);
            }
        }
        Item::Texture(index) => {
            if let Some(texture) = scene.textures.get(index) {
                textures::texture_ui(ui, index, texture, commands);
            }
        }
    }
}
