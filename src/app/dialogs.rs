//! Questions and messages that must be answered before anything else, and files dropped onto the window.

use super::action::Action;
use super::chooser::Request;
use super::command::{Answer, AppCommand, Next};
use super::editor::Editor;
use super::files::with_extension;
use super::theme;
use egui::{Button, Context, Grid, Id, Key, Modal, ScrollArea, TextEdit, Ui};
use std::path::PathBuf;

/// The dialog that is shown; there is one at most.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Dialog {
    /// Save the changes before this?
    Unsaved(Next),
    /// Something went wrong: title, text.
    Error(String, String),
    /// A path is typed, since no file dialog can be had.
    Path(Request, String),
    /// Keys and mouse.
    Help,
}

impl Dialog {
    /// A message.
    pub(crate) fn error(title: String, text: String) -> Self {
        Self::Error(title, text)
    }

    /// A field for a path.
    pub(crate) fn path(request: Request) -> Self {
        let text = request.proposal.display().to_string();
        Self::Path(request, text)
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
            Dialog::Path(request, text) => path_ui(ui, request, text, commands),
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
    ScrollArea::vertical().max_height(300.0).show(ui, |ui| {
        // A reference to text is a text field that can be read and copied, not changed.
        let mut shown = text;
        let field = TextEdit::multiline(&mut shown).code_editor().desired_width(f32::INFINITY);
        ui.add(field).accessible_name("Message");
    });
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        if ui.button("Close").clicked() {
            commands.push(AppCommand::CloseDialog);
        }
        if ui.button("Copy").clicked() {
            ui.ctx().copy_text(text.to_owned());
        }
    });
}

fn path_ui(ui: &mut Ui, request: &Request, text: &mut String, commands: &mut Vec<AppCommand>) {
    ui.heading(request.purpose.title());
    ui.label("This desktop shows no file dialog (it takes xdg-desktop-portal or zenity). Type the path here:");
    let response = ui.add(TextEdit::singleline(text).desired_width(f32::INFINITY)).accessible_name("Path");
    let entered = response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    if ui.memory(|memory| memory.focused().is_none()) {
        response.request_focus();
    }
    let path = with_extension(request.purpose, PathBuf::from(text.trim()));
    let replaces = request.purpose.writes() && path.is_file();
    if replaces {
        let color = theme::palette(ui.visuals().dark_mode).warning;
        ui.colored_label(color, format!("{} exists and will be replaced.", path.display()));
    }
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        let verb = if replaces {
            "Replace"
        } else if request.purpose.writes() {
            "Save"
        } else {
            "Open"
        };
        let usable = !text.trim().is_empty() && !path.is_dir();
        let clicked = ui.add_enabled(usable, Button::new(verb)).clicked();
        // Enter alone does not replace a file.
        if clicked || (entered && usable && !replaces) {
            commands.push(AppCommand::PathEntered(path));
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
    ScrollArea::vertical().max_height(460.0).show(ui, |ui| {
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
    if ui.button("Close").clicked() {
        commands.push(AppCommand::CloseDialog);
    }
}

/// Opens the scene file that was dropped onto the window.
pub(crate) fn dropped_files(ctx: &Context) -> Option<AppCommand> {
    let dropped = ctx.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_path_buf()));
    dropped.map(|path| AppCommand::GoTo(Next::Open(path)))
}
