//! Everything that panels, canvas, menus and keys ask for. [`Editor::apply`](crate::app::editor::Editor) alone does it.

use super::action::Action;
use crate::app::document::{Edit, Selection};
use crate::app::files::Purpose;
use egui::ThemePreference;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// A request to the editor.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum AppCommand {
    /// Something without parameters.
    Do(Action),
    /// Change the scene.
    Edit(Edit),
    /// Talk about something else.
    Select(Selection),
    /// Choose a file to add something from.
    AddFrom(Purpose),
    /// A file was dropped onto the window.
    Drop(PathBuf),
    /// Give up the drag that goes on.
    CancelDrag,
    /// Go on to something for which the present scene is given up; asks where there is something to lose.
    GoTo(Next),
    /// The answer to that question.
    Answer(Answer),
    /// The path that was typed.
    PathEntered(PathBuf),
    /// The file dialog hangs or cannot be had: type the path.
    TypePath,
    /// Close the dialog that is shown.
    CloseDialog,
    /// Rest once the error estimate is no more than this; `None`: never.
    Target(Option<f64>),
    /// Choose a file for the surface, with so many quads along each side of a patch.
    ExportSurface(NonZeroUsize),
    /// Light or dark.
    Theme(ThemePreference),
}

/// What gives up the present scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Next {
    /// An empty scene.
    New,
    /// The scene in this file.
    Open(PathBuf),
    /// A scene that the program carries with it.
    Example(&'static str),
    /// The end.
    Quit,
}

/// To "Save the changes?".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Answer {
    /// Save, then go on.
    Save,
    /// Go on without.
    Discard,
    /// Stay.
    Cancel,
}
