use super::*;
use crate::app::canvas::{Analysis, Shading};
use crate::app::commands::{Action, AppCommand, LengthUnit, Next};
use crate::app::keeping::{Folders, LoadedPreferences};
use crate::scene::Location;
use egui::ThemePreference;
use std::fs;
use std::path::Path;

/// An editor that keeps its preferences and recent files in `home`.
fn open_in(home: &Path) -> Ui {
    let mut ui = open("cornell");
    let folders = Folders { state: home.join("state"), config: home.join("config") };
    let loaded = LoadedPreferences::read(&folders.preferences());
    let ctx = ui.ctx.clone();
    ui.state_mut().keep_in(&ctx, &folders, loaded);
    ui.run_steps(4);
    ui
}

fn apply(ui: &mut Ui, command: AppCommand) {
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, command);
    ui.run_steps(2);
}

fn theme(ui: &Ui) -> ThemePreference {
    ui.ctx.options(|options| options.theme_preference)
}

#[test]
fn the_next_window_has_the_looks_of_the_window_before() {
    let home = folder();
    let mut first = open_in(home.path());
    for action in [Action::ToggleHandles, Action::ToggleHistory, Action::ToggleSmoothing] {
        apply(&mut first, AppCommand::Do(action));
    }
    apply(&mut first, AppCommand::Theme(ThemePreference::Light));
    apply(&mut first, AppCommand::Target(None));
    drop(first);
    let mut second = open_in(home.path());
    let editor = second.state();
    assert_eq!((editor.canvas.show_handles, editor.show_history, editor.show_panels), (false, true, true));
    assert!(!editor.rendering.is_smooth(), "the usual window smooths");
    assert_eq!((editor.rendering.target(), theme(&second)), (None, ThemePreference::Light));
    apply(&mut second, AppCommand::Target(Some(0.02)));
    apply(&mut second, AppCommand::Do(Action::TogglePanels));
    drop(second);
    let third = open_in(home.path());
    assert_eq!((third.state().rendering.target(), third.state().show_panels), (Some(0.02), false));
}

#[test]
fn the_next_window_has_the_aids_of_the_window_before() {
    let home = folder();
    let mut first = open_in(home.path());
    let before = first.state().canvas.grasp.falloff.on;
    for action in [
        Action::ToggleXRay,
        Action::ToggleFalloff,
        Action::MatchWindow,
        Action::ToggleIsolines,
        Action::ToggleZebra,
        Action::ToggleLightPaths,
    ] {
        apply(&mut first, AppCommand::Do(action));
    }
    apply(&mut first, AppCommand::Grid(Some(0.25)));
    apply(&mut first, AppCommand::LengthUnit(LengthUnit::Millimetres));
    drop(first);
    let second = open_in(home.path());
    let canvas = &second.state().canvas;
    assert!(canvas.sight.x_ray && canvas.grasp.falloff.on && canvas.matches_window && !before);
    assert_eq!(canvas.analysis.analysis, Analysis { isolines: true, shading: Some(Shading::Zebra) });
    assert!(canvas.light_paths.on);
    assert_eq!(canvas.grasp.grid, Some(0.25));
    assert!(second.query_all_by_label("mm").count() > 0, "the unit after a length");
}

#[test]
fn panels_keep_the_width_that_the_user_gave_them() {
    let home = folder();
    let mut first = open_in(home.path());
    let edge = egui::pos2(first.state().panel_sizes.progress, 600.0);
    let before = first.state().panel_sizes;
    first.hover_at(edge);
    first.run_steps(2);
    first.drag_at(edge);
    first.run_steps(2);
    first.hover_at(edge + egui::vec2(60.0, 0.0));
    first.run_steps(2);
    first.drop_at(edge + egui::vec2(60.0, 0.0));
    first.run_steps(3);
    let dragged = first.state().panel_sizes;
    assert!(dragged.progress > before.progress + 40.0, "dragged: {before:?} {dragged:?}");
    drop(first);
    // The panels of a new window are shown first with the remembered sizes.
    let folders = Folders { state: home.path().join("state"), config: home.path().join("config") };
    let loaded = LoadedPreferences::read(&folders.preferences());
    assert_eq!(loaded.preferences.panels, dragged);
}

#[test]
fn damaged_preferences_are_told_and_ignored() {
    let home = folder();
    fs::create_dir(home.path().join("config")).unwrap();
    fs::write(home.path().join("config/preferences.toml"), "show_panels = 7").unwrap();
    let ui = open_in(home.path());
    assert_eq!(ui.state().toasts.len(), 1, "the notice");
    assert!(ui.state().show_panels);
}

#[test]
fn a_file_dialog_opens_in_the_folder_that_was_chosen_last() {
    let (home, pictures) = (folder(), folder());
    let mut first = open_in(home.path());
    answer_dialogs(&mut first, Some(pictures.path().join("a.png")));
    press(&mut first, Key::E);
    wait_until(&mut first, "the answer", |ui| ui.state().chooser.pending().is_none());
    drop(first);
    let mut second = open_in(home.path());
    let asked = Arc::new(std::sync::Mutex::new(PathBuf::new()));
    let seen = Arc::clone(&asked);
    second.state_mut().chooser = Chooser::new(Arc::new(move |request: &Request| {
        seen.lock().unwrap().clone_from(&request.proposal);
        Some(request.proposal.clone())
    }));
    press(&mut second, Key::E);
    wait_until(&mut second, "the answer", |ui| ui.state().chooser.pending().is_none());
    assert_eq!(*asked.lock().unwrap(), pictures.path().join("cornell.png"));
}

#[test]
fn recent_files_open_from_the_menu_of_the_next_window() {
    let (home, work) = (folder(), folder());
    let path = |name: &str| work.path().join(name);
    for name in ["a.toml", "b.toml"] {
        SceneFile::built_in("water").unwrap().save(&path(name)).unwrap();
    }
    let mut first = open_in(home.path());
    for name in ["a.toml", "b.toml"] {
        apply(&mut first, AppCommand::Leave(Next::Open(path(name))));
    }
    drop(first);
    let mut second = open_in(home.path());
    assert_eq!(second.state().recent.paths(), [path("b.toml"), path("a.toml")]);
    choose_from_menu(&mut second, &["File", "Open recent"]);
    second.get_by_label_contains("a.toml").click();
    second.run_steps(3);
    assert_eq!(second.state().document.path(), Some(path("a.toml").as_path()));
    assert_eq!(second.state().recent.paths(), [path("a.toml"), path("b.toml")]);

    fs::remove_file(path("b.toml")).unwrap();
    choose_from_menu(&mut second, &["File", "Open recent"]);
    second.get_by_label_contains("b.toml").click();
    second.run_steps(3);
    assert!(matches!(second.state().dialog, Some(Dialog::Error(..))), "a message");
    assert_eq!(second.state().recent.paths(), [path("a.toml")], "a missing file leaves the list");
    click(&mut second, "Close");
    choose_from_menu(&mut second, &["File", "Open recent", "Clear list"]);
    assert!(second.state().recent.paths().is_empty());
}

#[test]
fn a_saved_scene_is_a_recent_file() {
    let work = folder();
    let mut ui = open("cornell");
    let path = work.path().join("mine.toml");
    answer_dialogs(&mut ui, Some(path.clone()));
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the save", |ui| ui.state().document.file().location == Location::Disk(path.clone()));
    assert_eq!(ui.state().recent.paths(), [path]);
}
