//! The camera, the picture and the limits of light transport.

use super::fields::{Number, color, count, number, number_row, rows, text_row, vector_row};
use super::glossary::{caption, caption_with_unit, explained};
use super::lengths::Lengths;
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit};
use crate::scene::{Film, Render, ToneCurve};
use egui::{ComboBox, Slider, Ui};

/// The camera's position, direction and field of view.
pub(super) fn camera_ui(ui: &mut Ui, document: &Document, lengths: &Lengths, commands: &mut Vec<AppCommand>) {
    let camera = document.scene().camera;
    let mut edited = camera;
    let length = lengths.coordinate();
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
    caption(ui, "Exposure");
    exposure_ui(ui, film);
    ui.end_row();
    caption(ui, "Tone curve");
    tone_curve_ui(ui, film);
    ui.end_row();
}

fn size_ui(ui: &mut Ui, film: &mut Film) {
    caption(ui, "Size");
    ui.horizontal(|ui| {
        count(ui, "Width", &mut film.width, 1..=16384, 1.0);
        ui.label("×");
        count(ui, "Height", &mut film.height, 1..=16384, 1.0);
        ui.weak("px");
    });
    ui.end_row();
}

/// The exposure slider, stops.
fn exposure_ui(ui: &mut Ui, film: &mut Film) {
    const TIP: &str = "Exposure of the display and of PNG files in stops; does not restart rendering";
    let spec = Number::any(0.02).within(-Film::MOST_EXPOSURE..=Film::MOST_EXPOSURE).tip(TIP);
    ui.horizontal(|ui| {
        let slider = Slider::new(&mut film.exposure, -8.0..=8.0).step_by(0.1).show_value(false);
        ui.add(slider.clamping(egui::SliderClamping::Edits)).accessible_name("Exposure").on_hover_text(TIP);
        number(ui, "Exposure", &mut film.exposure, &spec);
    });
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
    explained(response.response.accessible_name("Tone curve"), "Tone curve");
}

fn render_ui(ui: &mut Ui, render: &mut Render) {
    caption(ui, "Bounces");
    let field = count(ui, "Bounces", &mut render.max_bounces, 1..=1024, 0.1);
    field.on_hover_text("Maximum scattering events on a path; 1 renders direct light only");
    ui.end_row();
    caption_with_unit(ui, "Background", "W/sr/m²");
    ui.horizontal(|ui| color(ui, "Background", &mut render.background, &Number::strength(0.005)));
    ui.end_row();
}
