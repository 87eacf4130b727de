//! The menu of ready-made materials.

use super::icons::{self, Icon};
use crate::app::document::presets::{FAMILIES, Preset};
use egui::{Atom, Button, IdSalt, ScrollArea, Ui, Vec2};

/// Height of the list, screen points, beyond which it scrolls: it fits in the smallest window.
const MOST_HEIGHT: f32 = 320.0;
/// Width of the list, screen points: it fits the longest name.
const WIDTH: f32 = 210.0;

/// All presets under headings, each with a swatch; `Some` when the user chose one.
pub(super) fn presets_ui(ui: &mut Ui) -> Option<&'static Preset> {
    let mut chosen = None;
    ui.set_width(WIDTH);
    ScrollArea::vertical().max_height(MOST_HEIGHT).show(ui, |ui| {
        for family in FAMILIES {
            ui.weak(family.heading);
            for preset in family.presets {
                if preset_ui(ui, preset) {
                    chosen = Some(preset);
                }
            }
        }
    });
    if chosen.is_some() {
        // Buttons in a scroll area do not close the menu by themselves.
        ui.close();
    }
    chosen
}

/// A button with a swatch and the preset's name; whether the user clicked it.
fn preset_ui(ui: &mut Ui, preset: &Preset) -> bool {
    let swatch = IdSalt::new("swatch");
    let height = ui.spacing().interact_size.y;
    let button = Button::selectable(false, (Atom::custom(swatch, Vec2::splat(icons::SIZE)), preset.name));
    let button = button.min_size(Vec2::new(ui.available_width(), height)).atom_ui(ui);
    let color = ui.style().interact(&button.response).text_color();
    if let Some(square) = button.rect(swatch) {
        Icon::of_model(&preset.model).paint(ui.painter(), square, color);
    }
    button.response.clicked()
}
