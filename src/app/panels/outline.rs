//! The list of everything in the scene.

use crate::app::action::Action;
use crate::app::command::AppCommand;
use crate::app::document::Document;
use crate::app::edit::Edit;
use crate::app::new_items;
use crate::app::selection::{Item, Selection};
use crate::scene::{Emitter, MaterialModel, Shape};
use egui::{Button, CollapsingHeader, Ui};

/// The scene as a list; a click selects.
pub(crate) fn outline_ui(ui: &mut Ui, document: &Document, commands: &mut Vec<AppCommand>) {
    let scene = document.scene();
    row_ui(ui, document, Item::Camera, "Camera", "", commands);
    row_ui(ui, document, Item::Settings, "Picture and rendering", "", commands);
    let objects = scene.objects.iter().map(|object| (object.name.as_str(), shape_kind(&object.shape)));
    section_ui(ui, "Objects", objects, document, Item::Object, commands, |ui, commands| {
        for (label, shape) in new_items::shapes() {
            if ui.button(label).clicked() {
                commands.push(AppCommand::Edit(Edit::AddObject(new_items::object(scene, label, shape))));
            }
        }
    });
    let lights = scene.lights.iter().map(|light| (light.name.as_str(), emitter_kind(&light.emitter)));
    section_ui(ui, "Lights", lights, document, Item::Light, commands, |ui, commands| {
        for (label, emitter) in new_items::emitters() {
            if ui.button(label).clicked() {
                commands.push(AppCommand::Edit(Edit::AddLight(new_items::light(scene, label, emitter))));
            }
        }
    });
    let materials = scene.materials.iter().map(|material| (material.name.as_str(), model_kind(&material.model)));
    section_ui(ui, "Materials", materials, document, Item::Material, commands, |ui, commands| {
        for (label, model) in new_items::models() {
            if ui.button(label).clicked() {
                commands.push(AppCommand::Edit(Edit::AddMaterial(new_items::material(scene, label, model))));
            }
        }
    });
}

fn section_ui<'a>(
    ui: &mut Ui,
    title: &'static str,
    entries: impl ExactSizeIterator<Item = (&'a str, &'static str)>,
    document: &Document,
    item: impl Fn(usize) -> Item,
    commands: &mut Vec<AppCommand>,
    add_ui: impl FnOnce(&mut Ui, &mut Vec<AppCommand>),
) {
    let header = format!("{title} ({})", entries.len());
    CollapsingHeader::new(header).id_salt(title).default_open(true).show(ui, |ui| {
        for (index, (name, kind)) in entries.enumerate() {
            row_ui(ui, document, item(index), name, kind, commands);
        }
        ui.menu_button("Add…", |ui| add_ui(ui, commands)).response.on_hover_text(format!("Add to {title}"));
    });
}

fn row_ui(ui: &mut Ui, document: &Document, item: Item, name: &str, kind: &str, commands: &mut Vec<AppCommand>) {
    let selected = document.selection.item == item;
    let button = Button::selectable(selected, name).right_text(egui::RichText::new(kind).weak().small()).truncate();
    let response = ui.add_sized([ui.available_width(), ui.spacing().interact_size.y], button);
    if response.clicked() || response.secondary_clicked() {
        commands.push(AppCommand::Select(Selection::of(item)));
    }
    if matches!(item, Item::Object(_) | Item::Light(_) | Item::Material(_)) {
        response.context_menu(|ui| {
            for action in [Action::Duplicate, Action::Delete] {
                if ui.add(Button::new(action.label()).shortcut_text(action.shortcut(ui.ctx()))).clicked() {
                    commands.push(AppCommand::Do(action));
                }
            }
        });
    }
}

/// What a shape is called.
pub(super) fn shape_kind(shape: &Shape) -> &'static str {
    match shape {
        Shape::Quad { .. } => "quad",
        Shape::Sphere { .. } => "sphere",
        Shape::Plane { .. } => "plane",
        Shape::Bezier(_) => "bezier",
    }
}

/// What a kind of light is called.
pub(super) fn emitter_kind(emitter: &Emitter) -> &'static str {
    match emitter {
        Emitter::Point { .. } => "point",
        Emitter::Sphere { .. } => "sphere",
        Emitter::Quad { .. } => "quad",
    }
}

/// What a kind of material is called.
pub(super) fn model_kind(model: &MaterialModel) -> &'static str {
    match model {
        MaterialModel::Diffuse { .. } => "diffuse",
        MaterialModel::Phong { .. } => "phong",
        MaterialModel::Polished { .. } => "polished",
        MaterialModel::Mirror { .. } => "mirror",
        MaterialModel::Glass { .. } => "glass",
    }
}
