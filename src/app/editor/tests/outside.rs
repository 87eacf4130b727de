use super::*;
use crate::app::commands::{AppCommand, Next};
use crate::scene::Camera;
use std::fs;
use std::path::Path;

/// The editor of a scene file in a folder.
fn open_in(folder: &Path) -> (Ui, PathBuf) {
    let path = folder.join("room.toml");
    SceneFile::built_in("cornell").unwrap().save(&path).unwrap();
    let mut ui = open("water");
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Leave(Next::Open(path.clone())));
    ui.run_steps(3);
    (ui, path)
}

/// Changes the camera in the file, as another program does.
fn change_outside(path: &Path, fov_y: f64) -> Camera {
    let mut file = SceneFile::open(path).unwrap();
    file.scene.camera.fov_y = fov_y;
    file.save(path).unwrap();
    file.scene.camera
}

#[test]
fn a_scene_without_edits_follows_its_file_and_undo_brings_it_back() {
    let folder = folder();
    let (mut ui, path) = open_in(folder.path());
    let before = scene(&ui).camera;
    let after = change_outside(&path, 33.0);
    wait_until(&mut ui, "the reload", |ui| scene(ui).camera == after);
    assert!(!ui.state().document.is_dirty());
    assert_eq!((&ui.state().dialog, ui.state().toasts.len()), (&None, 1), "a message, no question");
    press(&mut ui, Key::Z);
    assert_eq!((scene(&ui).camera, ui.state().document.is_dirty()), (before, true));
    press(&mut ui, Key::S);
    assert_eq!(SceneFile::open(&path).unwrap().scene.camera, before, "saved without a question");
}

#[test]
fn the_user_chooses_between_edits_and_a_changed_file() {
    let folder = folder();
    let (mut ui, path) = open_in(folder.path());
    edit(&mut ui);
    let edited = scene(&ui).clone();
    change_outside(&path, 33.0);
    wait_until(&mut ui, "the question", |ui| ui.query_by_label("Reload the changed file?").is_some());
    ui.run_steps(3);
    click(&mut ui, "Keep mine");
    assert_eq!((scene(&ui), &ui.state().dialog), (&edited, &None));

    let outside = change_outside(&path, 44.0);
    wait_until(&mut ui, "the question", |ui| ui.query_by_label("Reload the changed file?").is_some());
    ui.run_steps(3);
    click(&mut ui, "Reload");
    assert_eq!((scene(&ui).camera, ui.state().document.is_dirty()), (outside, false));
    press(&mut ui, Key::Z);
    assert_eq!(*scene(&ui), edited, "the edits are not lost");
    press(&mut ui, Key::S);
    assert_eq!(SceneFile::open(&path).unwrap().scene, edited, "the user has chosen already");
}

#[test]
fn a_half_written_file_gives_a_notice_and_is_read_once_it_is_complete() {
    let folder = folder();
    let (mut ui, path) = open_in(folder.path());
    let before = scene(&ui).clone();
    fs::write(&path, "version = 1\n[camera").unwrap();
    wait_until(&mut ui, "the notice", |ui| ui.query_by_label_contains("cannot be opened yet").is_some());
    assert_eq!((scene(&ui), &ui.state().dialog), (&before, &None));
    let mut after = SceneFile::built_in("water").unwrap();
    after.save(&path).unwrap();
    wait_until(&mut ui, "the reload", |ui| *scene(ui) == after.scene);
    ui.run_steps(2);
    assert!(ui.query_by_label_contains("cannot be opened yet").is_none(), "the notice is gone");
}

#[test]
fn a_deleted_file_leaves_an_unsaved_scene_with_a_message() {
    let folder = folder();
    let (mut ui, path) = open_in(folder.path());
    let before = scene(&ui).clone();
    fs::remove_file(&path).unwrap();
    wait_until(&mut ui, "the message", |ui| ui.state().toasts.len() == 1);
    assert!(ui.state().document.is_dirty());
    assert_eq!((scene(&ui), &ui.state().dialog), (&before, &None));
    press(&mut ui, Key::S);
    assert_eq!(SceneFile::open(&path).unwrap().scene, before);
    assert!(!ui.state().document.is_dirty());
}

#[test]
fn own_saves_are_no_changes_of_others() {
    let folder = folder();
    let (mut ui, path) = open_in(folder.path());
    edit(&mut ui);
    press(&mut ui, Key::S);
    assert_eq!(SceneFile::open(&path).unwrap().scene, *scene(&ui));
    let start = Instant::now();
    wait_until(&mut ui, "some looks", |_| start.elapsed() > Duration::from_secs(2));
    assert!(ui.state().document.done_steps() == 1 && !ui.state().document.is_dirty(), "nothing was reloaded");
}

#[test]
fn a_changed_texture_is_read_anew() {
    let folder = folder();
    let (mut ui, path) = open_in(folder.path());
    SceneFile::built_in("report").unwrap().save(&path).unwrap();
    let textures = SceneFile::open(&path).unwrap().files();
    wait_until(&mut ui, "the reload", |ui| ui.state().document.file().files() == textures);
    ui.run_steps(2);
    ui.state_mut().rendering.take_commands();
    image::RgbImage::new(8, 8).save(&textures[0]).unwrap();
    wait_until(&mut ui, "the restart", |ui| {
        ui.state_mut().rendering.take_commands().iter().any(|command| matches!(command, Command::Restart))
    });
    assert!(!ui.state().document.is_dirty());
}
