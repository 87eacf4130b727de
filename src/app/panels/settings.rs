//! The camera, the picture and the limits of light transport.

use super::fields::{Number, color, length_speed, number_row, rows, text_row, vector_row};
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit};
use crate::scene::{Film, Render, ToneCurve};
use egui::{ComboBox, DragValue, Slider, Ui};

/// The camera's position, direction and field of view.
pub(super) fn camera_ui(ui: &mut Ui, document: &Document, commands: &mut Vec<AppCommand>) {
    let camera = document.scene().camera;
    let mut edited = camera;
    let length = Number::any(length_speed(&document.scene().camera));
    ui.strong("Camera");
    rows(ui, "camera", |ui| {
        vector_row(ui, "Position", &mut edited.position, &length);
        vector_row(ui, "Target", &mut edited.target, &length);
        vector_row(ui, "Up", &mut edited.up, &Number::any(0.01));
        let fov = Number::any(0.1).within(0.1..=179.0).unit("°").tip("Vertical field of view");
        number_row(ui, "Field of view", &mut edited.fov_y, &fov);
    });
    if edited != camera {
        commands.push(AppCommand::Edit(Edit::Camera(edited)));
    }
}

/// The scene's name, the picture and the limits of light transport.
pub(super) fn settings_ui(ui: &mut Ui, document: &Document, commands: &mut Vec<AppCommand>) {
    let scene = document.scene();
    let (mut name, mut film, mut render) = (scene.name.clone(), scene.film, scene.render);
    ui.strong("Picture and rendering");
    rows(ui, "settings", |ui| {
        text_row(ui, "Scene name", &mut name, "scene");
        size_ui(ui, &mut film);
        display_rows(ui, &mut film);
        render_ui(ui, &mut render);
    });
    if name != scene.name {
        commands.push(AppCommand::Edit(Edit::Name(name)));
    }
    if film != scene.film {
        commands.push(AppCommand::Edit(Edit::Film(film)));
    }
    if render != scene.render {
        commands.push(AppCommand::Edit(Edit::Render(render)));
    }
}

/// The exposure and the tone curve, as two rows.
pub(super) fn display_rows(ui: &mut Ui, film: &mut Film) {
    ui.label("Exposure");
    exposure_ui(ui, film);
    ui.end_row();
    ui.label("Tone curve");
    tone_curve_ui(ui, film);
    ui.end_row();
}

fn size_ui(ui: &mut Ui, film: &mut Film) {
    ui.label("Size");
    ui.horizontal(|ui| {
        ui.add(DragValue::new(&mut film.width).range(1..=16384).suffix(" px").update_while_editing(false))
            .accessible_name("Width");
        ui.label("×");
        ui.add(DragValue::new(&mut film.height).range(1..=16384).suffix(" px").update_while_editing(false))
            .accessible_name("Height");
    });
    ui.end_row();
}

/// The exposure slider, stops.
fn exposure_ui(ui: &mut Ui, film: &mut Film) {
    let slider = Slider::new(&mut film.exposure, -8.0..=8.0).fixed_decimals(1).step_by(0.1).suffix(" EV");
    let slider = slider.clamping(egui::SliderClamping::Edits);
    ui.add(slider)
        .accessible_name("Exposure")
        .on_hover_text("Exposure of the display and of PNG files; does not restart rendering");
}

/// The choice of the tone curve.
fn tone_curve_ui(ui: &mut Ui, film: &mut Film) {
    let label = |curve| match curve {
        ToneCurve::Srgb => "sRGB, clipped",
        ToneCurve::Filmic => "filmic",
    };
    let response =
        ComboBox::from_id_salt("tone curve").selected_text(label(film.tone_curve)).width(130.0).show_ui(ui, |ui| {
            for curve in [ToneCurve::Srgb, ToneCurve::Filmic] {
                ui.selectable_value(&mut film.tone_curve, curve, label(curve));
            }
        });
    response.response.accessible_name("Tone curve");
}

fn render_ui(ui: &mut Ui, render: &mut Render) {
    ui.label("Bounces");
    let field = DragValue::new(&mut render.max_bounces).range(1..=1024).speed(0.1).update_while_editing(false);
    ui.add(field)
        .accessible_name("Bounces")
        .on_hover_text("Maximum scattering events on a path; 1 renders direct light only");
    ui.end_row();
    ui.label("Background");
    ui.horizontal(|ui| color(ui, "Background", &mut render.background, &Number::strength(0.005)));
    ui.end_row();
}
