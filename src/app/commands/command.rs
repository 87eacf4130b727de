//! Every request of the user. The editor's `apply` alone carries requests out.

use super::action::Action;
use super::comparison::SnapshotCommand;
use super::length_unit::LengthUnit;
use super::picture_view::PictureView;
use super::purpose::Purpose;
use crate::app::document::surface::Coupling;
use crate::app::document::{Edit, NewItem, Selection};
use crate::engine::Limits;
use crate::scene::{Camera, SurfaceOptions};
use crate::transport::Component;
use egui::{Pos2, ThemePreference};
use std::path::PathBuf;

/// A request of the user to the editor.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum AppCommand {
    /// Perform an action without parameters.
    Do(Action),
    /// Change the scene.
    Edit(Edit),
    /// Change the selection.
    Select(Selection),
    /// Show the scene with this camera, under this name of the change.
    View(Camera, &'static str),
    /// Change which control points move together.
    Couple(Coupling),
    /// Add an object or a light where the camera looks.
    Add(NewItem),
    /// Ask for a file to add to the scene.
    AddFrom(Purpose),
    /// Use a file that was dropped onto the window.
    Drop(PathBuf),
    /// Undo or repeat steps until this many are done.
    GoTo(usize),
    /// Revert the current drag.
    CancelDrag,
    /// Leave the present scene; asks first while changes are unsaved.
    Leave(Next),
    /// Answer "Save the changes?".
    Answer(Answer),
    /// Save the scene over its file, which another program has changed.
    Replace(PathBuf),
    /// Discard the unsaved changes at this place in the list of a former window's changes.
    DiscardLeftOver(usize),
    /// Empty the list of recent files.
    ClearRecent,
    /// Take over the scene that another program has written to the scene's file.
    Reload,
    /// Keep the present scene over the one that another program has written to its file.
    KeepMine,
    /// Use the typed path.
    PathEntered(PathBuf),
    /// Dismiss a slow file dialog and ask for a typed path.
    TypePath,
    /// Close the open dialog.
    CloseDialog,
    /// Close the hint for a first start.
    CloseHint,
    /// Stop rendering at this relative error; `None` never stops.
    Target(Option<f64>),
    /// Stop rendering after this time or these iterations.
    Limits(Limits),
    /// Ask for a file to export the surface to.
    ExportSurface(SurfaceOptions),
    /// Take, compare or restore snapshots.
    Snapshot(SnapshotCommand),
    /// Show this of the scene.
    Show(PictureView),
    /// Render this component of the light alone, or all.
    Only(Option<Component>),
    /// The line of a profile between two points in film pixels; `None` for none.
    ProfileLine(Option<[Pos2; 2]>),
    /// Snap to a grid with this step, scene units; `None` for the automatic step.
    Grid(Option<f64>),
    /// Name the unit of lengths.
    LengthUnit(LengthUnit),
    /// Choose the light or the dark theme.
    Theme(ThemePreference),
}

/// The step that follows after the present scene is left.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Next {
    /// Open a new scene.
    New,
    /// Open the scene in this file.
    Open(PathBuf),
    /// Open the built-in scene of this name.
    Example(&'static str),
    /// Recover the unsaved changes at this place in the list of a former window's changes.
    Recover(usize),
    /// Close the window.
    Quit,
}

/// The user's answer to "Save the changes?".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Answer {
    /// Save, then leave the scene.
    Save,
    /// Leave the scene without saving.
    Discard,
    /// Keep the scene open.
    Cancel,
}
