//! Questions and messages that must be answered before anything else, and files dropped onto the window.

use crate::app::commands::{Action, Answer, AppCommand, Next};
use crate::app::editor::Editor;
use crate::app::files::PathField;
use egui::{Context, DragValue, Grid, Id, Key, Modal, ScrollArea, TextEdit, Ui};
use std::num::NonZeroUsize;

/// The dialog that is shown; there is one at most.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Dialog {
    /// Save the changes before this?
    Unsaved(Next),
    /// Something went wrong: title, text.
    Error(String, String),
    /// A path is typed.
    Path(PathField),
    /// What is exported as a surface: its name, and quads along each side of a patch.
    Surface(String, usize),
    /// Keys and mouse.
    Help,
}

impl Dialog {
    /// A message.
    pub(crate) fn error(title: String, text: String) -> Self {
        Self::Error(title, text)
    }
}

/// Shows the dialog there is.
pub(crate) fn dialog_ui(ctx: &Context, editor: &mut Editor, commands: &mut Vec<AppCommand>) {
    let title = editor.document.title();
    let Some(dialog) = &mut editor.dialog else { return };
    let modal = Modal::new(Id::unique("dialog")).show(ctx, |ui| {
        ui.set_max_width(560.0);
        match dialog {
            Dialog::Unsaved(next) => unsaved_ui(ui, &title, next, commands),
            Dialog::Error(title, text) => error_ui(ui, title, text, commands),
            Dialog::Path(field) => field.ui(ui, commands),
            Dialog::Surface(name, steps) => surface_ui(ui, name, steps, commands),
            Dialog::Help => help_ui(ui, commands),
        }
    });
    if modal.should_close() {
        commands.push(AppCommand::CloseDialog);
    }
}

fn unsaved_ui(ui: &mut Ui, title: &str, next: &Next, commands: &mut Vec<AppCommand>) {
    let before = match next {
        Next::Quit => "closing the window",
        Next::New | Next::Open(_) | Next::Example(_) => "opening another scene",
    };
    ui.heading("Save the changes?");
    ui.label(format!("{} has changes that are not saved. Save them before {before}?", title.trim_start_matches('*')));
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        for (label, answer) in [("Save", Answer::Save), ("Don't save", Answer::Discard), ("Cancel", Answer::Cancel)] {
            if ui.button(label).clicked() {
                commands.push(AppCommand::Answer(answer));
            }
        }
    });
}

fn error_ui(ui: &mut Ui, title: &str, text: &str, commands: &mut Vec<AppCommand>) {
    ui.heading(title);
    ScrollArea::vertical().max_height(content_height(ui).min(300.0)).show(ui, |ui| {
        // A reference to text is a text field that can be read and copied, not changed.
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

fn surface_ui(ui: &mut Ui, name: &str, steps: &mut usize, commands: &mut Vec<AppCommand>) {
    ui.heading("Export surface");
    ui.label(format!("{name}, where it stands in the scene: as a mesh (.obj) or as control points (.bpt)."));
    ui.horizontal(|ui| {
        let label = ui.label("Quads along each side of a patch");
        ui.add(DragValue::new(steps).range(1..=1024).speed(0.2)).labelled_by(label.id);
        ui.weak("in an .obj");
    });
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        let choose = ui.button("Choose file…");
        let typing = ui.memory(|memory| memory.focused().is_some());
        if choose.clicked() || (!typing && ui.input(|input| input.key_pressed(Key::Enter))) {
            commands.extend(NonZeroUsize::new(*steps).map(AppCommand::ExportSurface));
        }
        if ui.button("Cancel").clicked() {
            commands.push(AppCommand::CloseDialog);
        }
    });
}

fn help_ui(ui: &mut Ui, commands: &mut Vec<AppCommand>) {
    const MOUSE: [(&str, &str); 8] = [
        ("Drag a handle", "moves it in the plane that faces the camera"),
        ("X, Y or Z held meanwhile", "moves it along this axis"),
        ("Esc meanwhile", "takes the drag back"),
        ("Click, Shift+click", "selects a control point, adds it to the others"),
        ("Click in the picture", "selects what is seen there"),
        ("Wheel", "zooms to the pointer"),
        ("Drag beside the handles", "moves the picture, as does any other button"),
        ("Drag a number", "changes it, slowly with Shift; click it to type"),
    ];
    ui.heading("Keys and mouse");
    ScrollArea::vertical().max_height(content_height(ui)).show(ui, |ui| {
        Grid::new("help").num_columns(2).spacing([24.0, 3.0]).show(ui, |ui| {
            for (what, does) in MOUSE {
                ui.strong(what);
                ui.label(does);
                ui.end_row();
            }
            for action in Action::all() {
                ui.strong(action.shortcuts(ui.ctx()).join(", "));
                ui.label(action.label());
                ui.end_row();
            }
        });
    });
    close_ui(ui, commands);
}

/// What there is to read is done with; Enter says so too.
fn close_ui(ui: &mut Ui, commands: &mut Vec<AppCommand>) {
    let free = ui.memory(|memory| memory.focused().is_none());
    if ui.button("Close").clicked() || (free && ui.input(|input| input.key_pressed(Key::Enter))) {
        commands.push(AppCommand::CloseDialog);
    }
}

/// What a dialog's content may be high for its title and buttons to stay within the window.
fn content_height(ui: &Ui) -> f32 {
    (ui.ctx().content_rect().height() - 120.0).max(60.0)
}

/// The files that were dropped onto the window.
pub(crate) fn dropped_files(ctx: &Context) -> Vec<AppCommand> {
    ctx.input(|input| input.raw.dropped_files.iter().map(|file| AppCommand::Drop(file.path().to_path_buf())).collect())
}
