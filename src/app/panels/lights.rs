//! The properties of a light.

use super::fields::{Number, kind_row, number_row, rows, strength_row, text_row, vector_row};
use super::lengths::Lengths;
use crate::app::commands::AppCommand;
use crate::app::document::{Edit, kinds};
use crate::scene::{Emitter, Light};
use egui::Ui;

/// The light's name, kind, position and strength.
pub(super) fn light_ui(ui: &mut Ui, index: usize, light: &Light, lengths: &Lengths, commands: &mut Vec<AppCommand>) {
    ui.strong("Light");
    let mut edited = light.clone();
    rows(ui, "light", |ui| {
        text_row(ui, "Name", &mut edited.name, ("light", index, &light.name));
        let kinds = kinds::EMITTER_KINDS.map(|kind| (kind, kind));
        if let Some(kind) = kind_row(ui, "Type", kinds::emitter_kind(&light.emitter), &kinds) {
            edited.emitter = kinds::emitter_like(&light.emitter, kind);
        }
        emitter_ui(ui, &mut edited.emitter, &light.name, lengths);
    });
    if edited != *light {
        commands.push(AppCommand::Edit(Edit::Light(index, edited)));
    }
}

fn emitter_ui(ui: &mut Ui, emitter: &mut Emitter, name: &str, lengths: &Lengths) {
    let (length, component) = (lengths.coordinate(), Number::any(0.01));
    match emitter {
        Emitter::Point { position, intensity } => {
            vector_row(ui, "Position", position, &length);
            strength_row(ui, "Intensity", intensity, "W/sr", name);
        }
        Emitter::Sphere { center, radius, radiance } => {
            vector_row(ui, "Centre", center, &length);
            number_row(ui, "Radius", radius, &lengths.positive());
            strength_row(ui, "Radiance", radiance, "W/sr/m²", name);
        }
        Emitter::Quad { corner, edge_u, edge_v, radiance } => {
            vector_row(ui, "Corner", corner, &length);
            vector_row(ui, "Edge u", edge_u, &length);
            vector_row(ui, "Edge v", edge_v, &length);
            strength_row(ui, "Radiance", radiance, "W/sr/m²", name);
        }
        Emitter::Sun { direction, irradiance, diameter } => {
            vector_row(ui, "Direction", direction, &component);
            strength_row(ui, "Irradiance", irradiance, "W/m²", name);
            number_row(ui, "Diameter", diameter, &Number::any(0.01).within(0.0..=Emitter::MOST_DIAMETER).unit("°"));
        }
        Emitter::Beam { center, direction, radius, power } => {
            vector_row(ui, "Centre", center, &length);
            vector_row(ui, "Direction", direction, &component);
            number_row(ui, "Radius", radius, &lengths.positive());
            strength_row(ui, "Power", power, "W", name);
        }
    }
}
