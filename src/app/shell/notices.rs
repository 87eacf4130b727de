//! Messages over the picture: a camera of the window alone, unreadable files, failures, problems of the scene, a lack of light, a slow
//! file dialog.

use crate::app::commands::{Action, AppCommand};
use crate::app::document::kinds;
use crate::app::files::{Chooser, Request};
use crate::app::rendering::Rendering;
use crate::app::theme;
use crate::app::viewpoint::NamedView;
use crate::engine::Status;
use crate::math::Rgb;
use crate::scene::{Problem, Scene};
use egui::{Color32, Frame, ScrollArea, Ui};

/// Maximum height of the list of problems, screen points: the picture stays visible.
const MAX_HEIGHT: f32 = 120.0;

/// Shows a changed file that cannot be opened, a failure of the engine, the problems that keep the scene from being rendered, the
/// lack of light, a black picture, and a slow file dialog.
pub(crate) fn notices_ui(
    ui: &mut Ui,
    scene: &Scene,
    rendering: &Rendering,
    chooser: &Chooser,
    unreadable: Option<&str>,
    commands: &mut Vec<AppCommand>,
) {
    if let Some(message) = unreadable {
        unreadable_ui(ui, message);
    }
    if let Status::Failed(message) = rendering.status() {
        failure_ui(ui, message);
    }
    if !rendering.problems().is_empty() {
        problems_ui(ui, rendering.problems());
    } else if is_unlit(scene) {
        unlit_ui(ui);
    } else if is_black(rendering) {
        black_ui(ui, commands);
    }
    if let Some(request) = chooser.pending().filter(|_| chooser.is_slow(ui.ctx())) {
        slow_dialog_ui(ui, request, commands);
    }
}

/// Says that the user looks around, with the ways to end it.
pub(crate) fn looking_ui(ui: &mut Ui, commands: &mut Vec<AppCommand>) {
    let color = theme::palette(ui.visuals().dark_mode).plot;
    notice_ui(ui, color, |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.label("Looking around: the scene keeps its own camera.");
            for (label, action) in
                [("Use as camera", Action::UseView), ("Back to the scene's camera", Action::LookAround)]
            {
                if ui.button(label).clicked() {
                    commands.push(AppCommand::Do(action));
                }
            }
        });
    });
}

/// Tells of a changed file that cannot be opened.
fn unreadable_ui(ui: &mut Ui, message: &str) {
    let color = theme::palette(ui.visuals().dark_mode).warning;
    notice_ui(ui, color, |ui| {
        ui.colored_label(color, "⚠ Another program has changed the scene's file, but the file cannot be opened yet:");
        ui.label(message);
    });
}

fn failure_ui(ui: &mut Ui, message: &str) {
    let color = theme::palette(ui.visuals().dark_mode).error;
    notice_ui(ui, color, |ui| {
        ui.colored_label(color, format!("⚠ Rendering failed: {message}"));
        ui.label("The scene is unchanged. Edit it, or restart rendering.");
    });
}

fn problems_ui(ui: &mut Ui, problems: &[Problem]) {
    let color = theme::palette(ui.visuals().dark_mode).warning;
    notice_ui(ui, color, |ui| {
        ui.colored_label(color, "⚠ This scene cannot be rendered. The picture shows the last valid scene. Problems:");
        ScrollArea::vertical().max_height(MAX_HEIGHT).show(ui, |ui| {
            for problem in problems {
                ui.label(problem.to_string());
            }
        });
    });
}

/// Whether no light of the scene shines, and its background is black.
fn is_unlit(scene: &Scene) -> bool {
    scene.render.background == Rgb::ZERO && scene.lights.iter().all(|light| kinds::is_dark(&light.emitter))
}

fn unlit_ui(ui: &mut Ui) {
    let color = theme::palette(ui.visuals().dark_mode).warning;
    notice_ui(ui, color, |ui| {
        ui.colored_label(color, "⚠ The picture is black, because the scene has no light.");
        ui.label(
            "Add a light or make a light stronger under \"Lights\", or set a background under \"Picture and rendering\".",
        );
    });
}

/// Iterations after which a black picture hardly becomes brighter.
const BLACK_ITERATIONS: u64 = 4;

/// Whether the picture is black, although iterations have ended.
fn is_black(rendering: &Rendering) -> bool {
    let frame = rendering.full_frame().filter(|frame| frame.iteration >= BLACK_ITERATIONS);
    frame.is_some_and(|frame| frame.image.pixels.iter().all(|pixel| *pixel == Rgb::ZERO))
}

fn black_ui(ui: &mut Ui, commands: &mut Vec<AppCommand>) {
    let color = theme::palette(ui.visuals().dark_mode).warning;
    notice_ui(ui, color, |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.colored_label(
                color,
                "⚠ The picture is black: the camera sees nothing that is lit. It may be behind a wall.",
            );
            for (label, view) in [("The scene's own view", NamedView::Own), ("Frame all", NamedView::All)] {
                let action = Action::View(view);
                if ui.button(label).clicked() {
                    commands.push(AppCommand::Do(action));
                }
            }
        });
    });
}

fn slow_dialog_ui(ui: &mut Ui, request: &Request, commands: &mut Vec<AppCommand>) {
    let color = theme::palette(ui.visuals().dark_mode).plot;
    notice_ui(ui, color, |ui| {
        ui.horizontal(|ui| {
            ui.label(format!("Waiting for the file dialog \"{}\"…", request.purpose.title()));
            if ui.button("Type the path instead").clicked() {
                commands.push(AppCommand::TypePath);
            }
        });
    });
}

/// A framed message.
fn notice_ui(ui: &mut Ui, edge: Color32, content: impl FnOnce(&mut Ui)) {
    let frame =
        Frame::group(ui.style()).fill(ui.visuals().panel_fill).stroke(egui::Stroke::new(1.0, edge)).outer_margin(4.0);
    frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        content(ui);
    });
}
