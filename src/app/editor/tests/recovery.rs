use super::*;
use crate::app::commands::{AppCommand, Next};
use crate::app::document::Edit;
use crate::app::keeping::{Folders, LoadedPreferences, Pace};
use std::fs;
use std::path::Path;

/// An editor of the scene file that keeps unsaved changes in `home` without delay.
fn open_in(home: &Path, scene: &Path) -> Ui {
    let mut ui = open("cornell");
    keep_in(&mut ui, home);
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Leave(Next::Open(scene.to_owned())));
    ui.run_steps(3);
    ui
}

fn keep_in(ui: &mut Ui, home: &Path) {
    let ctx = ui.ctx.clone();
    ui.state_mut().autosave.pace = Pace { rest: Duration::ZERO, most: Duration::ZERO };
    let folders = Folders { state: home.to_owned(), config: home.to_owned() };
    ui.state_mut().keep_in(&ctx, &folders, LoadedPreferences::default());
}

/// A scene file in a folder, with a texture beside it.
fn scene_in(folder: &Path) -> PathBuf {
    let path = folder.join("room.toml");
    SceneFile::built_in("report").unwrap().save(&path).unwrap();
    path
}

/// The files with unsaved changes.
fn kept(home: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(home.join("unsaved")).into_iter().flatten().flatten().map(|entry| entry.path());
    entries.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect()
}

fn brighten(ui: &mut Ui, exposure: f64) {
    let film = crate::scene::Film { exposure, ..scene(ui).film };
    ui.state_mut().document.edit(Edit::Film(film));
    ui.state_mut().document.end_gesture();
    ui.run_steps(2);
}

/// Ends the editor as `kill -9` does: its file stays, and its lock is released.
fn kill(mut ui: Ui) {
    wait_until(&mut ui, "the file", |ui| !ui.state().autosave.is_busy());
    drop(ui);
}

fn wait_for_question(ui: &mut Ui) {
    wait_until(ui, "the question", |ui| ui.query_by_label("Recover unsaved changes?").is_some());
    // The dialog settles its place.
    ui.run_steps(3);
}

#[test]
fn unsaved_changes_are_recovered_after_the_end_of_a_window() {
    let (home, work) = (folder(), folder());
    let path = scene_in(work.path());
    let before = SceneFile::open(&path).unwrap();
    let mut first = open_in(home.path(), &path);
    brighten(&mut first, 1.5);
    wait_until(&mut first, "the file", |_| kept(home.path()).len() == 1);
    brighten(&mut first, 2.5);
    kill(first);

    let mut second = open("water");
    keep_in(&mut second, home.path());
    wait_for_question(&mut second);
    assert!(second.query_by_label("room.toml").is_some(), "the name of the scene");
    click(&mut second, "Recover");
    let document = &second.state().document;
    assert_eq!(document.scene().film.exposure, 2.5, "the last state");
    assert_eq!((document.path(), document.is_dirty()), (Some(path.as_path()), true));
    assert!(document.file().files().iter().all(|file| file.exists()), "its textures are found");
    assert_eq!(kept(home.path()).len(), 1, "the changes are safe until they are saved");
    press(&mut second, Key::Z);
    assert_eq!(*scene(&second), before.scene, "undo leads to the saved scene");
    press(&mut second, Key::Y);
    press(&mut second, Key::S);
    assert_eq!(SceneFile::open(&path).unwrap().scene.film.exposure, 2.5, "saved to its file");
    wait_until(&mut second, "the end of the file", |_| kept(home.path()).is_empty());
}

#[test]
fn recovered_changes_do_not_replace_a_file_that_has_changed_since() {
    let (home, work) = (folder(), folder());
    let path = scene_in(work.path());
    let mut ui = open_in(home.path(), &path);
    brighten(&mut ui, 2.0);
    kill(ui);
    SceneFile::built_in("lens").unwrap().save(&path).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let mut ui = open_in(home.path(), &path);
    wait_for_question(&mut ui);
    click(&mut ui, "Recover");
    assert!(ui.state().document.is_dirty(), "the recovered changes");
    wait_until(&mut ui, "the question", |ui| matches!(ui.state().dialog, Some(Dialog::Reload(_))));
    assert_eq!(fs::read_to_string(&path).unwrap(), text, "the file of the other program stays");
}

#[test]
fn a_saved_or_discarded_scene_leaves_nothing_behind() {
    let (home, work) = (folder(), folder());
    let path = scene_in(work.path());
    let mut ui = open_in(home.path(), &path);
    for exposure in [1.5, 2.5] {
        brighten(&mut ui, exposure);
        wait_until(&mut ui, "the file", |_| !kept(home.path()).is_empty());
        press(&mut ui, Key::S);
        wait_until(&mut ui, "the end of the file", |_| kept(home.path()).is_empty());
    }
    brighten(&mut ui, 3.5);
    wait_until(&mut ui, "the file", |_| !kept(home.path()).is_empty());
    press(&mut ui, Key::Q);
    click(&mut ui, "Don't save");
    ui.run_steps(3);
    assert!(ui.state().may_close);
    drop(ui);
    assert_eq!(fs::read_dir(home.path().join("unsaved")).unwrap().count(), 0, "neither a file nor a lock");
}

#[test]
fn a_window_that_runs_keeps_its_changes_to_itself() {
    let (home, work) = (folder(), folder());
    let path = scene_in(work.path());
    let mut first = open_in(home.path(), &path);
    brighten(&mut first, 1.5);
    wait_until(&mut first, "the file", |_| kept(home.path()).len() == 1);
    let mut second = open_in(home.path(), &path);
    second.run_steps(20);
    assert_eq!(second.state().dialog, None, "the first window runs");
    brighten(&mut second, 2.5);
    wait_until(&mut second, "its own file", |_| kept(home.path()).len() == 2);
    kill(first);
    kill(second);

    let mut third = open_in(home.path(), &path);
    wait_for_question(&mut third);
    assert_eq!(third.query_all_by_label("Recover").count(), 2);
    let mut fourth = open_in(home.path(), &path);
    fourth.run_steps(20);
    assert_eq!(fourth.state().dialog, None, "the third window asks already");
    click(&mut third, "Later");
    drop((third, fourth));
    assert_eq!(kept(home.path()).len(), 2, "kept for later");
}

#[test]
fn discarded_changes_are_gone_and_damaged_files_stay() {
    let home = folder();
    fs::create_dir(home.path().join("unsaved")).unwrap();
    fs::write(home.path().join("unsaved/old.toml"), "version = ").unwrap();
    let mut first = open("cornell");
    keep_in(&mut first, home.path());
    wait_for_question(&mut first);
    assert!(first.query_by_label_contains("cannot be recovered: it has no header").is_some(), "a clear message");
    assert!(first.query_by_label("Recover").is_none(), "nothing to recover");
    click(&mut first, "Later");
    brighten(&mut first, 1.5);
    wait_until(&mut first, "the file", |_| kept(home.path()).len() == 2);
    kill(first);

    let mut second = open("water");
    keep_in(&mut second, home.path());
    wait_for_question(&mut second);
    assert!(second.query_by_label("example cornell").is_some());
    second.get_all_by_label("Discard").next().unwrap().click();
    second.run_steps(3);
    assert_eq!(kept(home.path()), [home.path().join("unsaved/old.toml")], "the damaged file stays");
    assert_eq!(second.query_all_by_label("Discard").count(), 1);
    second.key_press(Key::Escape);
    second.run_steps(2);
    assert_eq!(second.state().dialog, None);
}

#[test]
fn an_unusable_folder_is_told_once() {
    let home = folder();
    fs::write(home.path().join("unsaved"), "no folder").unwrap();
    let mut ui = open("cornell");
    keep_in(&mut ui, home.path());
    brighten(&mut ui, 1.5);
    wait_until(&mut ui, "the message", |ui| ui.state().toasts.len() == 1);
    brighten(&mut ui, 2.5);
    assert_eq!(ui.state().toasts.len(), 1);
}

#[test]
fn a_scene_that_cannot_be_rendered_is_recovered() {
    let home = folder();
    let mut first = open("cornell");
    keep_in(&mut first, home.path());
    let mut camera = scene(&first).camera;
    camera.up = camera.target - camera.position;
    first.state_mut().document.edit(Edit::Camera(camera));
    first.run_steps(2);
    assert!(!first.state().rendering.problems().is_empty(), "the scene has problems");
    wait_until(&mut first, "the file", |_| kept(home.path()).len() == 1);
    kill(first);
    let mut second = open("water");
    keep_in(&mut second, home.path());
    wait_for_question(&mut second);
    second.key_press(Key::Enter);
    second.run_steps(3);
    assert_eq!(scene(&second).camera, camera);
}
