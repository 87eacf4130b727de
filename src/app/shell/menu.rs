//! The menu bar, with buttons for frequent actions.

use super::inspect_menu::inspect_menu_ui;
use super::menu_item::{check_ui, item_ui};
use super::surface_menu::surface_menu_ui;
use crate::app::canvas::{Analysis, automatic_step, steps_around};
use crate::app::commands::{Action, AppCommand, LengthUnit, Next, PictureView};
use crate::app::document::{Document, Item};
use crate::app::viewpoint::{NamedView, Side};
use crate::scene::built_in_scenes;
use crate::transport::Component;
use egui::{Align, Button, Layout, MenuBar, ThemePreference, Ui};
use std::path::{Path, PathBuf};

/// The states that the user can switch, for the menu's check marks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Visibility {
    pub(crate) navigate: bool,
    pub(crate) look_around: bool,
    pub(crate) match_window: bool,
    /// Whether the screen shows less noise in the interreflection than the picture has.
    pub(crate) smooth: bool,
    pub(crate) handles: bool,
    pub(crate) x_ray: bool,
    pub(crate) analysis: Analysis,
    pub(crate) light_paths: bool,
    /// Whether soft selection is on.
    pub(crate) falloff: bool,
    /// The step of the snapping grid, scene units; `None` for the automatic step.
    pub(crate) grid: Option<f64>,
    pub(crate) panels: bool,
    /// What the canvas shows of the scene.
    pub(crate) view: PictureView,
    /// The component of the light that is rendered; `None` for all.
    pub(crate) only: Option<Component>,
    pub(crate) length_unit: LengthUnit,
    pub(crate) history: bool,
    pub(crate) guide: bool,
}

/// The menu bar: menus on the left, buttons on the right.
pub(crate) fn menu_ui(
    ui: &mut Ui,
    document: &Document,
    recent: &[PathBuf],
    paused: bool,
    visible: Visibility,
    commands: &mut Vec<AppCommand>,
) {
    MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| file_ui(ui, recent, commands));
        ui.menu_button("Edit", |ui| edit_ui(ui, document, visible, commands));
        ui.menu_button("Select", |ui| select_ui(ui, document, visible, commands));
        ui.menu_button("Surface", |ui| surface_menu_ui(ui, document, commands));
        ui.menu_button("View", |ui| view_ui(ui, visible, commands));
        ui.menu_button("Inspect", |ui| inspect_menu_ui(ui, visible.view, visible.only, commands));
        ui.menu_button("Render", |ui| {
            let pause = if paused { "Resume" } else { "Pause" };
            item_ui(ui, Action::TogglePause, pause, true, commands);
            for action in [Action::Restart, Action::Brighter, Action::Darker] {
                item_ui(ui, action, action.label(), true, commands);
            }
        });
        ui.menu_button("Help", |ui| {
            check_ui(ui, Action::ToggleGuide, visible.guide, commands);
            for action in [Action::Palette, Action::Help] {
                item_ui(ui, action, action.label(), true, commands);
            }
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            buttons_ui(ui, paused, commands);
            navigate_ui(ui, visible.navigate, commands);
        });
    });
}

fn file_ui(ui: &mut Ui, recent: &[PathBuf], commands: &mut Vec<AppCommand>) {
    for action in [Action::New, Action::Open] {
        item_ui(ui, action, action.label(), true, commands);
    }
    ui.add_enabled_ui(!recent.is_empty(), |ui| ui.menu_button("Open recent", |ui| recent_ui(ui, recent, commands)));
    ui.menu_button("Examples", |ui| {
        for example in built_in_scenes() {
            if ui.button(example.title).clicked() {
                commands.push(AppCommand::Leave(Next::Example(example.name)));
            }
        }
    });
    ui.separator();
    for action in [Action::Save, Action::SaveAs] {
        item_ui(ui, action, action.label(), true, commands);
    }
    ui.separator();
    for action in [Action::Export, Action::ExportShown, Action::ExportDeep, Action::CopyPicture, Action::ExportSurface]
    {
        item_ui(ui, action, action.label(), true, commands);
    }
    ui.separator();
    item_ui(ui, Action::Quit, Action::Quit.label(), true, commands);
}

fn recent_ui(ui: &mut Ui, recent: &[PathBuf], commands: &mut Vec<AppCommand>) {
    for path in recent {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let folder = path.parent().map_or_else(String::new, short_folder);
        let button = ui.add(Button::new(name).shortcut_text(folder));
        if button.on_hover_text(path.display().to_string()).clicked() {
            commands.push(AppCommand::Leave(Next::Open(path.clone())));
        }
    }
    ui.separator();
    if ui.button("Clear list").clicked() {
        commands.push(AppCommand::ClearRecent);
    }
}

/// The last two names of a folder's path, after a mark where more names stand before them.
fn short_folder(folder: &Path) -> String {
    let names: Vec<_> = folder.iter().map(|name| name.to_string_lossy()).collect();
    match names.len() {
        0..=3 => folder.display().to_string(),
        count => format!("…/{}", names[count - 2..].join("/")),
    }
}

fn edit_ui(ui: &mut Ui, document: &Document, visible: Visibility, commands: &mut Vec<AppCommand>) {
    for (action, what) in [(Action::Undo, document.undoable()), (Action::Redo, document.redoable())] {
        let label = format!("{} {}", action.label(), what.unwrap_or_default());
        item_ui(ui, action, label.trim_end(), what.is_some(), commands);
    }
    check_ui(ui, Action::ToggleHistory, visible.history, commands);
    ui.separator();
    item_ui(ui, Action::Duplicate, Action::Duplicate.label(), true, commands);
    ui.menu_button("Mirror copy", |ui| {
        let has_image = matches!(document.selection.item, Item::Object(_) | Item::Light(_));
        for action in [Action::MirrorCopyX, Action::MirrorCopyY, Action::MirrorCopyZ] {
            item_ui(ui, action, action.label(), has_image, commands);
        }
    });
    item_ui(ui, Action::Delete, Action::Delete.label(), true, commands);
}

fn view_ui(ui: &mut Ui, visible: Visibility, commands: &mut Vec<AppCommand>) {
    for action in [Action::Fit, Action::OneToOne, Action::ZoomIn, Action::ZoomOut] {
        item_ui(ui, action, action.label(), true, commands);
    }
    ui.separator();
    named_views_ui(ui, commands);
    ui.separator();
    for (action, on) in [
        (Action::Navigate, visible.navigate),
        (Action::LookAround, visible.look_around),
        (Action::MatchWindow, visible.match_window),
        (Action::ToggleSmoothing, visible.smooth),
        (Action::ToggleHandles, visible.handles),
        (Action::ToggleXRay, visible.x_ray),
        (Action::TogglePanels, visible.panels),
    ] {
        check_ui(ui, action, on, commands);
    }
    for action in
        [Action::ToggleIsolines, Action::ToggleMeanCurvature, Action::ToggleGaussianCurvature, Action::ToggleZebra]
    {
        check_ui(ui, action, visible.analysis.shows(action), commands);
    }
    check_ui(ui, Action::ToggleLightPaths, visible.light_paths, commands);
    ui.separator();
    item_ui(ui, Action::FullScreen, Action::FullScreen.label(), true, commands);
    ui.separator();
    ui.menu_button("Unit of length", |ui| {
        for unit in LengthUnit::ALL {
            if ui.radio(visible.length_unit == unit, unit.label()).clicked() {
                commands.push(AppCommand::LengthUnit(unit));
            }
        }
    });
    let current = ui.ctx().options(|options| options.theme_preference);
    for (theme, label) in [
        (ThemePreference::Dark, "Dark"),
        (ThemePreference::Light, "Light"),
        (ThemePreference::System, "Follow the system"),
    ] {
        if ui.radio(current == theme, label).clicked() {
            commands.push(AppCommand::Theme(theme));
        }
    }
}

/// Selection of control points, and how moves treat them.
fn select_ui(ui: &mut Ui, document: &Document, visible: Visibility, commands: &mut Vec<AppCommand>) {
    let has_points = document.selection.surface(document.scene()).is_some();
    let some = !document.selection.points.is_empty();
    for (action, enabled) in [
        (Action::SelectAll, has_points),
        (Action::SelectNone, some),
        (Action::SelectRectangle, has_points && visible.handles),
        (Action::SelectRow, some),
        (Action::SelectColumn, some),
    ] {
        item_ui(ui, action, action.label(), enabled, commands);
    }
    ui.separator();
    check_ui(ui, Action::ToggleFalloff, visible.falloff, commands);
    ui.menu_button("Snapping grid", |ui| grid_ui(ui, document, visible.grid, commands));
}

/// The step of the grid that drags with Ctrl snap to.
fn grid_ui(ui: &mut Ui, document: &Document, chosen: Option<f64>, commands: &mut Vec<AppCommand>) {
    let camera = &document.scene().camera;
    let automatic = format!("Automatic, now {}", automatic_step(camera));
    if ui.radio(chosen.is_none(), automatic).clicked() {
        commands.push(AppCommand::Grid(None));
    }
    let mut steps = steps_around(camera).to_vec();
    // The chosen step stays in the list when the camera has moved.
    steps.extend(chosen.filter(|step| !steps.contains(step)));
    for step in steps {
        if ui.radio(chosen == Some(step), step.to_string()).clicked() {
            commands.push(AppCommand::Grid(Some(step)));
        }
    }
}

fn named_views_ui(ui: &mut Ui, commands: &mut Vec<AppCommand>) {
    let mut view_ui = |ui: &mut Ui, view| {
        let action = Action::View(view);
        item_ui(ui, action, action.label(), true, commands);
    };
    ui.menu_button("View from", |ui| {
        for side in [Side::Front, Side::Right, Side::Top, Side::Opposite] {
            view_ui(ui, NamedView::From(side));
        }
    });
    for view in [NamedView::Own, NamedView::Selection, NamedView::All, NamedView::Previous, NamedView::Next] {
        view_ui(ui, view);
    }
}

fn buttons_ui(ui: &mut Ui, paused: bool, commands: &mut Vec<AppCommand>) {
    let pause = if paused { "▶ Resume" } else { "⏸ Pause" };
    // The layout adds buttons from right to left.
    for (action, label) in
        [(Action::OneToOne, "1:1"), (Action::Fit, "Fit"), (Action::Restart, "↺ Restart"), (Action::TogglePause, pause)]
    {
        let tip = format!("{} ({})", action.label(), action.shortcut(ui.ctx()));
        if ui.button(label).on_hover_text(tip).clicked() {
            commands.push(AppCommand::Do(action));
        }
    }
}

/// A button that is pressed while drags navigate.
fn navigate_ui(ui: &mut Ui, on: bool, commands: &mut Vec<AppCommand>) {
    let tip = format!(
        "Drag to orbit, drag with the right button to pan, turn the wheel to move nearer ({}); with Alt held at any time",
        Action::Navigate.shortcut(ui.ctx())
    );
    if ui.add(Button::selectable(on, "Navigate")).on_hover_text(tip).clicked() {
        commands.push(AppCommand::Do(Action::Navigate));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_folder_is_shortened() {
        let short = |folder: &str| short_folder(Path::new(folder));
        assert_eq!(short("/home/ada"), "/home/ada");
        assert_eq!(short("/home/ada/work/scenes"), "…/work/scenes");
    }
}
