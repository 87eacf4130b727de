//! Modal dialogs: unsaved changes, reloading, recovery, errors, paths, surface export, help, the command palette.

use super::palette::Palette;
use super::primary::primary_ui;
use super::recovery::recovery_ui;
use crate::app::commands::{Action, Answer, AppCommand, Next};
use crate::app::document::Document;
use crate::app::files::PathField;
use crate::app::keeping::LeftOverRow;
use crate::app::panels::count;
use crate::scene::SurfaceOptions;
use egui::{Context, Grid, Id, Modal, ScrollArea, TextEdit, Ui};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// A modal dialog with its state.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Dialog {
    /// Asks whether to save the changes first.
    Unsaved(Next),
    /// Asks whether to replace the scene's file, which another program has changed.
    ChangedOutside(PathBuf),
    /// Asks whether to reload the scene's file, which another program has changed while the scene has unsaved changes.
    Reload(PathBuf),
    /// Asks what to do with the unsaved changes of windows that ended without saving.
    Recovery(Vec<LeftOverRow>),
    /// Reports an error: title, text.
    Error(String, String),
    /// Asks for a path.
    Path(PathField),
    /// Asks how to export a surface: the surface's name, the quads along each side of a patch.
    Surface(String, SurfaceOptions),
    /// Lists keys and mouse gestures.
    Help,
    /// Finds commands by name.
    Palette(Palette),
}

/// Shows a dialog over a document.
pub(crate) fn dialog_ui(ctx: &Context, dialog: &mut Dialog, document: &Document, commands: &mut Vec<AppCommand>) {
    let modal = Modal::new(Id::unique("dialog")).show(ctx, |ui| {
        ui.set_max_width(560.0);
        match dialog {
            Dialog::Unsaved(next) => unsaved_ui(ui, &document.title(), next, commands),
            Dialog::ChangedOutside(path) => changed_ui(ui, path, commands),
            Dialog::Reload(path) => reload_ui(ui, path, commands),
            Dialog::Recovery(rows) => recovery_ui(ui, rows, commands),
            Dialog::Error(title, text) => error_ui(ui, title, text, commands),
            Dialog::Path(field) => field.ui(ui, commands),
            Dialog::Surface(name, options) => surface_ui(ui, name, options, commands),
            Dialog::Help => help_ui(ui, commands),
            Dialog::Palette(palette) => palette.ui(ui, document.scene(), commands),
        }
    });
    if modal.should_close() {
        commands.push(AppCommand::CloseDialog);
    }
}

fn unsaved_ui(ui: &mut Ui, title: &str, next: &Next, commands: &mut Vec<AppCommand>) {
    let before = match next {
        Next::Quit => "closing the window",
        Next::New | Next::Open(_) | Next::Example(_) | Next::Recover(_) => "opening another scene",
    };
    ui.heading("Save the changes?");
    ui.label(format!("{} has unsaved changes. Save the changes before {before}?", title.trim_start_matches('*')));
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        if primary_ui(ui, "Save") {
            commands.push(AppCommand::Answer(Answer::Save));
        }
        for (label, answer) in [("Don't save", Answer::Discard), ("Cancel", Answer::Cancel)] {
            if ui.button(label).clicked() {
                commands.push(AppCommand::Answer(answer));
            }
        }
    });
}

fn changed_ui(ui: &mut Ui, path: &Path, commands: &mut Vec<AppCommand>) {
    ui.heading("Replace the changed file?");
    ui.label(format!(
        "Another program has changed {} since it was opened or saved here. Replacing it discards the changes of the \
         other program.",
        path.display()
    ));
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        if primary_ui(ui, "Save as…") {
            commands.push(AppCommand::Do(Action::SaveAs));
        }
        if ui.button("Replace").clicked() {
            commands.push(AppCommand::Replace(path.to_owned()));
        }
        if ui.button("Cancel").clicked() {
            commands.push(AppCommand::CloseDialog);
        }
    });
}

fn reload_ui(ui: &mut Ui, path: &Path, commands: &mut Vec<AppCommand>) {
    ui.heading("Reload the changed file?");
    ui.label(format!(
        "Another program has changed {}, and the scene has unsaved changes here. After reloading, undo brings your scene \
         back. If you keep yours, saving replaces the changes of the other program.",
        path.display()
    ));
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        if primary_ui(ui, "Keep mine") {
            commands.push(AppCommand::KeepMine);
        }
        if ui.button("Reload").clicked() {
            commands.push(AppCommand::Reload);
        }
    });
}

fn error_ui(ui: &mut Ui, title: &str, text: &str, commands: &mut Vec<AppCommand>) {
    ui.heading(title);
    ScrollArea::vertical().max_height(content_height(ui).min(300.0)).show(ui, |ui| {
        // A text field over a `&str` is read-only, and its text can be copied.
        let mut shown = text;
        let field = TextEdit::multiline(&mut shown).code_editor().desired_width(f32::INFINITY);
        ui.add(field).accessible_name("Message");
    });
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        close_ui(ui, commands);
        if ui.button("Copy").clicked() {
            ui.ctx().copy_text(text.to_owned());
        }
    });
}

fn surface_ui(ui: &mut Ui, name: &str, options: &mut SurfaceOptions, commands: &mut Vec<AppCommand>) {
    ui.heading("Export surface");
    ui.label(format!(
        "Exports {name} in world space: as a mesh (.obj, .stl), as control points (.bpt), or as exact surfaces for CAD programs (.step)."
    ));
    ui.horizontal(|ui| {
        ui.label("Quads along each side of a patch");
        let mut steps = options.steps.get();
        count(ui, "Quads along each side of a patch", &mut steps, 1..=1024, 0.2);
        options.steps = NonZeroUsize::new(steps).unwrap_or(options.steps);
        ui.weak("(.obj and .stl)");
    });
    ui.horizontal(|ui| {
        ui.checkbox(&mut options.free_form, "Bezier surfaces in place of the mesh")
            .on_hover_text("Exact, as `cstype bezier`; few programs read it");
        ui.weak("(.obj)");
    });
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        if primary_ui(ui, "Choose file…") {
            commands.push(AppCommand::ExportSurface(*options));
        }
        if ui.button("Cancel").clicked() {
            commands.push(AppCommand::CloseDialog);
        }
    });
}

fn help_ui(ui: &mut Ui, commands: &mut Vec<AppCommand>) {
    const MOUSE: [(&str, &str); 17] = [
        ("Drag a handle", "moves the handle in the plane that faces the camera"),
        ("Drag an arrow or a square", "moves the selection along an axis or the surface normal, or in a plane"),
        ("Drag with X, Y, Z or N held", "moves along this axis of the world, or along the surface normal"),
        ("Drag with Ctrl held", "snaps to the grid of the Select menu"),
        ("Wheel during a drag", "changes the radius of soft selection"),
        ("Esc", "reverts the drag in progress, or else selects no control point"),
        ("Arrow keys", "move the selection by one screen point, with Shift by ten"),
        ("Page up, Page down", "move the selection away or nearer, as do Ctrl+Up and Ctrl+Down"),
        ("Click, Shift+click", "selects a control point, adds it to the selection"),
        ("Ctrl+drag beside the handles", "selects control points by a rectangle, with Shift adds them"),
        ("Click in the picture", "selects the nearest object"),
        ("Wheel", "zooms about the pointer"),
        ("Drag the picture", "pans; the middle and right mouse buttons pan over handles too"),
        ("Alt+drag", "moves the camera around the selection, or around the point under the pointer"),
        ("Alt+Shift+drag, Alt+middle drag", "moves the camera sideways"),
        ("Alt+right drag, Alt+wheel", "moves the camera towards the pointer"),
        ("Drag a number", "changes the number, slowly with Shift; a click starts typing, also of +0.1, -=0.1, *2, /2"),
    ];
    ui.heading("Keys and mouse");
    ScrollArea::vertical().max_height(content_height(ui)).show(ui, |ui| {
        Grid::new("help").num_columns(2).spacing([24.0, 3.0]).show(ui, |ui| {
            for (gesture, effect) in MOUSE {
                ui.strong(gesture);
                ui.label(effect);
                ui.end_row();
            }
            for action in Action::all() {
                let shortcuts = action.shortcuts(ui.ctx());
                if shortcuts.is_empty() {
                    continue;
                }
                ui.strong(shortcuts.join(", "));
                ui.label(action.label());
                ui.end_row();
            }
        });
    });
    close_ui(ui, commands);
}

/// A button that closes the dialog.
fn close_ui(ui: &mut Ui, commands: &mut Vec<AppCommand>) {
    if primary_ui(ui, "Close") {
        commands.push(AppCommand::CloseDialog);
    }
}

/// Maximum height of a dialog's content, screen points, so that its title and buttons stay within the window.
fn content_height(ui: &Ui) -> f32 {
    (ui.ctx().content_rect().height() - 120.0).max(60.0)
}
