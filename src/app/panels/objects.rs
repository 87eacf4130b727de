//! The properties of an object.

use super::control_points::control_points_ui;
use super::coupling::coupling_ui;
use super::fields::{Number, choice_row, number_row, rows, text_row, vector_row};
use super::glossary::caption;
use super::lengths::Lengths;
use super::materials::{Naming, material_ui};
use super::revolution::{profile_ui, turn_ui};
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit, kinds};
use crate::scene::{MaterialModel, Object, Scene, Shape, Transform};
use egui::{CollapsingHeader, Ui};
use glam::DVec3;

/// The object's name, shape and material.
pub(super) fn object_ui(
    ui: &mut Ui,
    document: &Document,
    index: usize,
    object: &Object,
    lengths: &Lengths,
    commands: &mut Vec<AppCommand>,
) {
    ui.strong(format!("Object: {}", kinds::shape_kind(&object.shape)));
    let mut edited = object.clone();
    let materials = document.scene().materials.iter().map(|material| material.name.as_str());
    rows(ui, "object", |ui| {
        text_row(ui, "Name", &mut edited.name, ("object", index, &object.name));
        choice_row(ui, "Material", &mut edited.material, materials);
        body_ui(ui, document.scene(), index, &mut edited);
        shape_ui(ui, &mut edited.shape, lengths);
    });
    if edited != *object {
        commands.push(AppCommand::Edit(Edit::Object(index, edited)));
    }
    if let Shape::Bezier(bezier) = &object.shape {
        let points = CollapsingHeader::new("Control points").default_open(true).show(ui, |ui| {
            control_points_ui(ui, document, index, bezier, lengths, commands);
            coupling_ui(ui, document, bezier, lengths, commands);
        });
        points.header_response.on_hover_text("The points that shape the patches, and which of them move together");
    }
    if let Shape::Revolution(revolution) = &object.shape {
        let profile = CollapsingHeader::new("Profile").default_open(true).show(ui, |ui| {
            let changed = profile_ui(ui, document, revolution, lengths, commands);
            if changed != *revolution {
                let shape = Shape::Revolution(changed);
                commands.push(AppCommand::Edit(Edit::Object(index, Object { shape, ..object.clone() })));
            }
        });
        profile.header_response.on_hover_text("The control points that turn around the axis, by radius and height");
    }
    let material = document.scene().materials.iter().position(|material| material.name == object.material);
    if let Some(index) = material {
        let header = CollapsingHeader::new(format!("Material: {}", object.material)).id_salt("material");
        let fold = header.default_open(true).show(ui, |ui| {
            material_ui(ui, document, index, Naming::Fixed, lengths, commands);
        });
        fold.header_response.on_hover_text("How the surface scatters light; all objects of the material change");
    }
}

/// The body of an object of glass; an empty name stands for the body of all objects with the material.
fn body_ui(ui: &mut Ui, scene: &Scene, index: usize, object: &mut Object) {
    let material = scene.materials.iter().find(|material| material.name == object.material);
    if !material.is_some_and(|material| matches!(material.model, MaterialModel::Glass { .. })) {
        return;
    }
    let before = object.body.clone().unwrap_or_default();
    let mut name = before.clone();
    text_row(ui, "Body", &mut name, ("body", index, &before));
    object.body = (!name.is_empty()).then_some(name);
}

fn shape_ui(ui: &mut Ui, shape: &mut Shape, lengths: &Lengths) {
    let length = lengths.coordinate();
    match shape {
        Shape::Quad { corner, edge_u, edge_v } => {
            vector_row(ui, "Corner", corner, &length);
            vector_row(ui, "Edge u", edge_u, &length);
            vector_row(ui, "Edge v", edge_v, &length);
        }
        Shape::Sphere { center, radius } => {
            vector_row(ui, "Centre", center, &length);
            number_row(ui, "Radius", radius, &lengths.positive());
        }
        Shape::Plane { point, normal, u_axis } => {
            vector_row(ui, "Point", point, &length);
            vector_row(ui, "Normal", normal, &Number::any(0.01));
            u_axis_ui(ui, u_axis);
        }
        Shape::Bezier(bezier) => transform_ui(ui, &mut bezier.transform, lengths),
        Shape::Revolution(revolution) => {
            turn_ui(ui, revolution);
            transform_ui(ui, revolution.transform_mut(), lengths);
        }
    }
}

fn u_axis_ui(ui: &mut Ui, u_axis: &mut Option<DVec3>) {
    caption(ui, "Texture");
    let mut custom = u_axis.is_some();
    if ui
        .checkbox(&mut custom, "custom u axis")
        .on_hover_text("By default u runs along x, or along z where the normal is along x")
        .changed()
    {
        *u_axis = custom.then_some(DVec3::X);
    }
    ui.end_row();
    if let Some(axis) = u_axis {
        vector_row(ui, "u axis", axis, &Number::any(0.01));
    }
}

fn transform_ui(ui: &mut Ui, transform: &mut Transform, lengths: &Lengths) {
    vector_row(ui, "Translate", &mut transform.translate, &lengths.coordinate());
    vector_row(ui, "Rotate", &mut transform.rotate, &Number::any(0.5).unit("°"));
    vector_row(ui, "Scale", &mut transform.scale, &Number::factor(0.005));
}
