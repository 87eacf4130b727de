//! The properties of a material.

use super::fields::{Number, choice_row, color, color_row, kind_row, number, number_row, rows, text_row};
use super::glossary::{caption, caption_with_unit, explained};
use super::lengths::Lengths;
use super::presets::presets_ui;
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit, kinds};
use crate::math::Rgb;
use crate::scene::{Color, MaterialModel, Relief, Scene, TextureUse};
use egui::Ui;
use glam::DVec2;

/// Whether a panel edits the material's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Naming {
    /// The material's own panel edits the name.
    Editable,
    /// An object's panel shows the material under a fixed name, beside the object's name field.
    Fixed,
}

/// The material's kind and parameters, with its name where `naming` allows.
pub(super) fn material_ui(
    ui: &mut Ui,
    document: &Document,
    index: usize,
    naming: Naming,
    lengths: &Lengths,
    commands: &mut Vec<AppCommand>,
) {
    let scene = document.scene();
    let Some(material) = scene.materials.get(index) else { return };
    let mut edited = material.clone();
    rows(ui, "material", |ui| {
        if naming == Naming::Editable {
            text_row(ui, "Name", &mut edited.name, ("material", index, &material.name));
        }
        let kinds = kinds::MODEL_KINDS.map(|kind| (kind, kind));
        if let Some(kind) = kind_row(ui, "Type", kinds::model_kind(&material.model), &kinds) {
            edited.model = kinds::model_like(&material.model, kind);
        }
        caption(ui, "Preset");
        let menu = ui.menu_button("Choose…", presets_ui);
        if let Some(preset) = menu.inner.flatten() {
            edited = preset.applied_to(material);
        }
        explained(menu.response.accessible_name("Presets"), "Preset");
        ui.end_row();
        model_ui(ui, &mut edited.model, scene, lengths);
        relief_ui(ui, &mut edited.relief, scene, lengths);
    });
    let users = scene.objects.iter().filter(|object| object.material == material.name).count();
    ui.weak(format!("Used by {users} object{}", if users == 1 { "" } else { "s" }));
    if edited != *material {
        commands.push(AppCommand::Edit(Edit::Material(index, edited)));
    }
}

fn model_ui(ui: &mut Ui, model: &mut MaterialModel, scene: &Scene, lengths: &Lengths) {
    match model {
        MaterialModel::Diffuse { albedo } => surface_color_ui(ui, "Albedo", albedo, scene),
        MaterialModel::Phong { albedo, specular, exponent } => {
            surface_color_ui(ui, "Albedo", albedo, scene);
            surface_color_ui(ui, "Specular", specular, scene);
            let spec = Number::positive(0.5).tip("Phong exponent: a larger one makes a sharper highlight");
            number_row(ui, "Exponent", exponent, &spec);
        }
        MaterialModel::Polished { albedo, reflectance } => {
            surface_color_ui(ui, "Albedo", albedo, scene);
            surface_color_ui(ui, "Reflectance", reflectance, scene);
        }
        MaterialModel::Mirror { reflectance } => surface_color_ui(ui, "Reflectance", reflectance, scene),
        MaterialModel::Glass { ior, tint, absorption, priority } => {
            let spec =
                Number::positive(0.002).within(1.0..=4.0).tip("Index of refraction: 1.33 for water, 1.5 for glass");
            number_row(ui, "Index of refraction", ior, &spec);
            surface_color_ui(ui, "Tint", tint, scene);
            caption_with_unit(ui, "Absorption", lengths.unit.reciprocal());
            ui.horizontal(|ui| color(ui, "Absorption", absorption, &Number::strength(0.01)));
            ui.end_row();
            priority_ui(ui, priority);
        }
    }
}

fn priority_ui(ui: &mut Ui, priority: &mut i32) {
    let mut value = f64::from(*priority);
    let spec = Number::any(0.05)
        .within(f64::from(i32::MIN)..=f64::from(i32::MAX))
        .tip("Where bodies of glass overlap, the one with the highest priority counts; among equals the smaller one");
    number_row(ui, "Priority", &mut value, &spec);
    *priority = value.round() as i32;
}

/// A colour, or a texture if the scene has textures.
fn surface_color_ui(ui: &mut Ui, name: &str, color: &mut Color, scene: &Scene) {
    match color {
        Color::Constant(value) => color_row(ui, name, value),
        Color::Texture(map) => texture_ui(ui, name, map, scene),
    }
    if scene.textures.is_empty() {
        return;
    }
    ui.label("");
    let mut textured = matches!(color, Color::Texture(_));
    let field = ui.checkbox(&mut textured, format!("{name} from a texture"));
    if field.on_hover_text("Takes the colour from an image of the list of textures").changed() {
        *color = match (textured, scene.textures.first()) {
            (true, Some(first)) => Color::Texture(TextureUse { texture: first.name.clone(), scale: DVec2::ONE }),
            _ => Color::Constant(Rgb::splat(0.5)),
        };
    }
    ui.end_row();
}

fn texture_ui(ui: &mut Ui, name: &str, map: &mut TextureUse, scene: &Scene) {
    let names = scene.textures.iter().map(|texture| texture.name.as_str());
    choice_row(ui, name, &mut map.texture, names);
    ui.label("");
    ui.horizontal(|ui| {
        let spec = Number::factor(0.02).tip("Repetitions of the texture along u and v");
        ui.weak("repeat u");
        number(ui, &format!("{name} repeat u"), &mut map.scale.x, &spec);
        ui.weak("v");
        number(ui, &format!("{name} repeat v"), &mut map.scale.y, &spec);
    });
    ui.end_row();
}

fn relief_ui(ui: &mut Ui, relief: &mut Option<Relief>, scene: &Scene, lengths: &Lengths) {
    let Some(first) = scene.textures.first() else { return };
    let current = match relief {
        None => "none",
        Some(Relief::Normal { .. }) => "normal map",
        Some(Relief::Height { .. }) => "height map",
    };
    let kinds = ["none", "normal map", "height map"].map(|kind| (kind, kind));
    if let Some(kind) = kind_row(ui, "Bump or normal map", current, &kinds) {
        let map = match relief.take() {
            Some(Relief::Normal { map, .. } | Relief::Height { map, .. }) => map,
            None => TextureUse { texture: first.name.clone(), scale: DVec2::ONE },
        };
        *relief = match kind {
            "normal map" => Some(Relief::Normal { map, strength: 1.0 }),
            "height map" => Some(Relief::Height { map, depth: 0.02 }),
            _ => None,
        };
    }
    match relief {
        Some(Relief::Normal { map, strength }) => {
            texture_ui(ui, "Normal map", map, scene);
            number_row(ui, "Strength", strength, &Number::any(0.01).within(-1e3..=1e3));
        }
        Some(Relief::Height { map, depth }) => {
            texture_ui(ui, "Height map", map, scene);
            number_row(ui, "Depth", depth, &Number::any(0.001).unit(lengths.unit.suffix()));
        }
        None => {}
    }
}
