//! Snapshots of the picture, and comparisons with them.

use super::*;
use crate::app::commands::Comparison;
use crate::film::write_exr;

/// The editor with a snapshot of the picture of this size, and a changed scene.
fn with_snapshot(size: u32) -> Ui {
    let mut ui = open("cornell");
    let mut file = SceneFile::clone(ui.state().document.file());
    (file.scene.film.width, file.scene.film.height) = (size, size);
    ui.state_mut().document = crate::app::document::Document::new(file);
    receive(&mut ui, frame(1, false, size));
    press_key(&mut ui, Key::T);
    ui
}

fn press_key(ui: &mut Ui, key: Key) {
    ui.key_press(key);
    ui.run_steps(3);
}

fn comparison(ui: &Ui) -> Comparison {
    ui.state().snapshots.comparison()
}

#[test]
fn a_snapshot_of_a_draft_waits_for_the_picture() {
    let mut ui = open("cornell");
    receive(&mut ui, frame(1, true, 32));
    press_key(&mut ui, Key::T);
    assert!(ui.state().snapshots.is_empty(), "a draft is no picture");
    receive(&mut ui, frame(1, false, 32));
    let taken = ui.state().snapshots.get(0).expect("the first picture");
    assert_eq!((taken.iterations, taken.error, taken.seconds), (3, Some(0.05), Some(1.5)));
    ui.get_by_role_and_label(Role::Button, "Snapshot 1");
    ui.get_by_label_contains("5.00 %, 1.5 s");
}

#[test]
fn keys_flip_split_and_show_the_difference() {
    let mut ui = with_snapshot(16);
    for (key, expected) in [(Key::C, Comparison::Flip), (Key::D, Comparison::Difference)] {
        press_key(&mut ui, key);
        assert_eq!(comparison(&ui), expected);
        press_key(&mut ui, key);
        assert_eq!(comparison(&ui), Comparison::Off, "the same key ends it");
    }
    ui.key_press_modifiers(Modifiers::SHIFT, Key::C);
    ui.run_steps(2);
    assert_eq!(comparison(&ui), Comparison::Split);
}

#[test]
fn without_a_snapshot_there_is_nothing_to_compare() {
    let mut ui = open("cornell");
    receive(&mut ui, frame(1, false, 16));
    press_key(&mut ui, Key::C);
    assert_eq!(comparison(&ui), Comparison::Off);
}

#[test]
fn the_line_between_two_pictures_follows_the_pointer() {
    let mut ui = with_snapshot(16);
    click(&mut ui, "Split");
    let line = ui.get_by_role_and_label(Role::Splitter, "Line between two pictures").rect();
    let picture = ui.state().canvas.transform.expect("a frame").picture();
    let way = vec2(-0.25 * picture.width(), 0.0);
    // Beside the middle, where handles may lie.
    drag_and_drop(&mut ui, line.center() + vec2(0.0, 0.3 * line.height()), way);
    let after = ui.get_by_role_and_label(Role::Splitter, "Line between two pictures").rect();
    assert!((after.center().x - line.center().x - way.x).abs() < 2.0, "{} {}", after.center(), line.center());
}

#[test]
fn the_difference_has_numbers_and_is_zero_to_itself() {
    let mut ui = with_snapshot(16);
    press_key(&mut ui, Key::D);
    wait_until(&mut ui, "the numbers", |ui| ui.query_by_label_contains("RMSE").is_some());
    ui.get_by_label("RMSE 0.000e0");
    ui.get_by_label("brightness 1.0000 1.0000 1.0000");
    assert_eq!(ui.query_by_label("FLIP 0.0000").is_some(), cfg!(feature = "flip"));
}

#[test]
fn pictures_of_two_sizes_have_no_difference() {
    let mut ui = with_snapshot(16);
    receive(&mut ui, frame(2, false, 20));
    press_key(&mut ui, Key::D);
    ui.get_by_label_contains("20 × 20 and 16 × 16 pixels");
}

#[test]
fn a_restored_scene_is_an_undo_step() {
    let mut ui = with_snapshot(16);
    let before = scene(&ui).clone();
    let mut camera = before.camera;
    camera.fov_y += 5.0;
    ui.state_mut().document.edit(crate::app::document::Edit::Camera(camera));
    ui.run_steps(2);
    ui.get_by_role_and_label(Role::Button, "Snapshot 1").click_secondary();
    ui.run_steps(4);
    click(&mut ui, "Restore its scene");
    assert_eq!(*scene(&ui), before);
    assert_eq!(ui.state().document.undoable(), Some("restore Snapshot 1"));
    press(&mut ui, Key::Z);
    assert_eq!(scene(&ui).camera, camera, "undo brings the edited scene back");
}

#[test]
fn snapshots_are_saved_with_the_scene_and_come_back_with_it() {
    let dir = folder();
    let path = dir.path().join("room.toml");
    let mut ui = with_snapshot(16);
    let is_saved = |ui: &Ui| !ui.state().has_unsaved();
    answer_dialogs(&mut ui, Some(path.clone()));
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the save", |_| path.exists());
    ui.run_steps(2);
    assert!(is_saved(&ui) && !dir.path().join("room.snapshots").exists(), "not unless that is wanted");
    ui.get_by_label("Save with the scene").click();
    ui.run_steps(2);
    assert!(!is_saved(&ui), "the window asks before it closes");
    press(&mut ui, Key::S);
    assert!(is_saved(&ui));
    let file = SceneFile::open(&path).unwrap();
    let mut again = Editor::new(file);
    again.open_snapshots();
    let taken = again.snapshots.get(0).expect("it was saved");
    assert_eq!((taken.name.as_str(), taken.iterations), ("Snapshot 1", 3));
    assert_eq!(taken.file.as_ref().map(|file| &file.scene.objects), Some(&scene(&ui).objects));
}

#[test]
fn a_dropped_reference_is_compared_with() {
    let dir = folder();
    let path = dir.path().join("truth.exr");
    write_exr(&path, &frame(1, false, 16).image, &Default::default()).unwrap();
    let mut ui = open("cornell");
    receive(&mut ui, frame(1, false, 16));
    let ctx = ui.ctx.clone();
    ui.state_mut().drop_file(&ctx, path);
    ui.run_steps(3);
    ui.get_by_label_contains("16 × 16");
    click(&mut ui, "Flip");
    assert_eq!(comparison(&ui), Comparison::Flip);
    let ctx = ui.ctx.clone();
    ui.state_mut().drop_file(&ctx, dir.path().join("missing.exr"));
    ui.run_steps(2);
    assert!(matches!(ui.state().dialog, Some(Dialog::Error(..))));
}
