use super::*;
use crate::app::commands::{AppCommand, Next};
use crate::app::shell::Dialog;
use crate::scene::{Location, Shape};
use egui::{Key, Modifiers};

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

fn edit(ui: &mut Ui) {
    type_number(ui, "Corner x", "-0.9");
    assert!(ui.state().document.is_dirty(), "there is something to lose");
}

fn click(ui: &mut Ui, label: &str) {
    ui.get_by_role_and_label(Role::Button, label).click();
    ui.run_steps(3);
}

fn press(ui: &mut Ui, key: Key) {
    ui.key_press_modifiers(Modifiers::COMMAND, key);
    ui.run_steps(2);
}

fn type_path(ui: &mut Ui, path: &std::path::Path) {
    ui.get_by_role_and_label(Role::TextInput, "Path").focus();
    ui.run_steps(2);
    ui.key_press_modifiers(Modifiers::COMMAND, Key::A);
    ui.run_steps(1);
    ui.get_by_role_and_label(Role::TextInput, "Path").type_text(&path.display().to_string());
    ui.run_steps(2);
}

#[test]
fn a_scene_is_saved_where_the_dialog_says_and_then_in_place() {
    let (mut ui, folder) = (open("cornell"), folder());
    let path = folder.path().join("mine.toml");
    answer_dialogs(&mut ui, Some(path.clone()));
    edit(&mut ui);
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the save", |ui| !ui.state().document.is_dirty());
    assert_eq!(SceneFile::open(&path).unwrap().scene, *scene(&ui), "what was saved is what is shown");

    answer_dialogs(&mut ui, None);
    type_number(&mut ui, "Corner x", "-0.8");
    press(&mut ui, Key::S);
    assert!(!ui.state().document.is_dirty(), "no dialog for a scene that has a file");
    assert_eq!(SceneFile::open(&path).unwrap().scene, *scene(&ui), "saved again");
}

#[test]
fn where_no_dialog_can_open_a_path_is_typed() {
    let (mut ui, folder) = (open("cornell"), folder());
    answer_dialogs(&mut ui, None);
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the path field", |ui| matches!(ui.state().dialog, Some(Dialog::Path(..))));
    ui.run_steps(2);
    let path = folder.path().join("typed");
    type_path(&mut ui, &path);
    click(&mut ui, "Save");
    assert_eq!(ui.state().dialog, None);
    assert!(SceneFile::open(&path.with_extension("toml")).is_ok(), "saved, with the extension that was left out");
}

#[test]
fn a_file_is_replaced_only_on_purpose() {
    let (mut ui, folder) = (open("cornell"), folder());
    let path = folder.path().join("there.toml");
    std::fs::write(&path, "old").unwrap();
    answer_dialogs(&mut ui, None);
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the path field", |ui| matches!(ui.state().dialog, Some(Dialog::Path(..))));
    ui.run_steps(2);
    type_path(&mut ui, &path);
    ui.key_press(Key::Enter);
    ui.run_steps(2);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "old", "Enter is not enough");
    click(&mut ui, "Replace");
    assert!(SceneFile::open(&path).is_ok(), "replaced");
}

#[test]
fn a_file_that_cannot_be_opened_is_explained_and_the_scene_stays() {
    let (mut ui, folder) = (open("cornell"), folder());
    let path = folder.path().join("broken.toml");
    std::fs::write(&path, "version = 1\n[camera]\nfov_y = \"wide\"\n").unwrap();
    answer_dialogs(&mut ui, Some(path));
    let before = scene(&ui).clone();
    press(&mut ui, Key::O);
    wait_until(&mut ui, "the message", |ui| matches!(ui.state().dialog, Some(Dialog::Error(..))));
    ui.run_steps(2);
    let message = ui.get_by_role_and_label(Role::MultilineTextInput, "Message").value().unwrap();
    assert!(message.contains("broken.toml:3:"), "file and line: {message}");
    assert_eq!(*scene(&ui), before);
    click(&mut ui, "Close");
    assert_eq!(ui.state().dialog, None);
}

#[test]
fn edits_are_never_thrown_away_unasked() {
    let mut ui = open("cornell");
    edit(&mut ui);
    let edited = scene(&ui).clone();
    choose_from_menu(&mut ui, &["File", "New scene Ctrl+N"]);
    assert!(ui.query_by_label("Save the changes?").is_some(), "it asks");
    click(&mut ui, "Cancel");
    assert_eq!(*scene(&ui), edited, "and stays");

    for next in [Next::Quit, Next::Example("water"), Next::Open("a.toml".into())] {
        let ctx = ui.ctx.clone();
        ui.state_mut().apply(&ctx, AppCommand::Leave(next.clone()));
        ui.run_steps(2);
        assert_eq!(ui.state().dialog, Some(Dialog::Unsaved(next)));
        assert!(!ui.state().may_close, "the window stays open");
        click(&mut ui, "Cancel");
    }
    assert_eq!(*scene(&ui), edited);

    press(&mut ui, Key::N);
    click(&mut ui, "Don't save");
    assert_eq!(ui.state().document.file().location, Location::Unsaved, "now it is the new scene");
}

#[test]
fn save_then_goes_on_to_what_was_asked_for() {
    let (mut ui, folder) = (open("cornell"), folder());
    let path = folder.path().join("kept.toml");
    answer_dialogs(&mut ui, Some(path.clone()));
    edit(&mut ui);
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Leave(Next::Example("water")));
    ui.run_steps(2);
    click(&mut ui, "Save");
    let water = Location::BuiltIn("water".to_owned());
    wait_until(&mut ui, "the example", |ui| ui.state().document.file().location == water);
    assert!(SceneFile::open(&path).is_ok(), "and the edits are kept");
}

#[test]
fn a_cancelled_save_goes_nowhere() {
    let mut ui = open("cornell");
    // A person needs a moment to cancel; what returns sooner was never shown.
    ui.state_mut().chooser = Chooser::new(Arc::new(|_: &Request| {
        std::thread::sleep(Duration::from_millis(600));
        None
    }));
    edit(&mut ui);
    let edited = scene(&ui).clone();
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Leave(Next::Quit));
    ui.run_steps(2);
    click(&mut ui, "Save");
    wait_until(&mut ui, "the end of the dialog", |ui| ui.state().chooser.pending().is_none());
    assert_eq!((ui.state().may_close, &ui.state().after_save, &ui.state().dialog), (false, &None, &None));
    assert_eq!(*scene(&ui), edited);
}

#[test]
fn a_dialog_that_hangs_can_be_given_up() {
    let mut ui = open("cornell");
    ui.state_mut().chooser = Chooser::new(Arc::new(|_: &Request| {
        std::thread::sleep(Duration::from_secs(4));
        None
    }));
    press(&mut ui, Key::O);
    wait_until(&mut ui, "the offer", |ui| ui.query_by_label("Type the path instead").is_some());
    click(&mut ui, "Type the path instead");
    assert!(matches!(ui.state().dialog, Some(Dialog::Path(..))), "{:?}", ui.state().dialog);
}

#[test]
fn an_example_opens_from_the_menu() {
    let mut ui = open("cornell");
    let title = crate::scene::built_in_scenes().iter().find(|example| example.name == "water").unwrap().title;
    choose_from_menu(&mut ui, &["File", "Examples", title]);
    assert_eq!(ui.state().document.file().location, Location::BuiltIn("water".to_owned()));
}

#[test]
fn the_picture_is_exported_once_it_is_no_draft() {
    let (mut ui, folder) = (open("cornell"), folder());
    let path = folder.path().join("picture.png");
    answer_dialogs(&mut ui, Some(path.clone()));
    receive(&mut ui, frame(1, true, 8));
    press(&mut ui, Key::E);
    wait_until(&mut ui, "the end of the dialog", |ui| ui.state().chooser.pending().is_none());
    ui.run_steps(4);
    assert!(!path.exists(), "a draft is not written");
    receive(&mut ui, frame(1, false, 16));
    wait_until(&mut ui, "the picture", |_| path.exists());
    let image = image::open(&path).unwrap();
    assert_eq!((image.width(), image.height()), (16, 16));
}

#[test]
fn a_picture_that_cannot_be_written_is_a_message() {
    let (mut ui, folder) = (open("cornell"), folder());
    answer_dialogs(&mut ui, Some(folder.path().join("no such folder/picture.exr")));
    receive(&mut ui, frame(1, false, 16));
    press(&mut ui, Key::E);
    wait_until(&mut ui, "the path field", |ui| matches!(ui.state().dialog, Some(Dialog::Path(..))));
    ui.run_steps(2);
    assert!(ui.query_by_label_contains("no such folder/picture.exr: cannot be written").is_some(), "why");
    ui.key_press(Key::Escape);
    ui.run_steps(3);
    assert_eq!(ui.state().dialog, None, "Esc gives it up");
}

/// Asks for a path to be typed.
fn path_field(ui: &mut Ui, key: Key) {
    answer_dialogs(ui, None);
    press(ui, key);
    wait_until(ui, "the path field", |ui| matches!(ui.state().dialog, Some(Dialog::Path(..))));
    ui.run_steps(2);
}

#[test]
fn a_typed_path_that_does_not_serve_can_be_corrected() {
    let (mut ui, folder) = (open("cornell"), folder());
    path_field(&mut ui, Key::S);
    let wrong = folder.path().join("no such folder/mine.toml");
    type_path(&mut ui, &wrong);
    ui.key_press(Key::Enter);
    ui.run_steps(3);
    assert!(ui.query_by_label_contains("cannot be written").is_some(), "why");
    let text = ui.get_by_role_and_label(Role::TextInput, "Path").value();
    assert_eq!(text, Some(wrong.display().to_string()), "what was typed is still there");
    assert!(ui.get_by_role_and_label(Role::TextInput, "Path").is_focused(), "and can be typed at once");
    let right = folder.path().join("mine.toml");
    type_path(&mut ui, &right);
    ui.key_press(Key::Enter);
    ui.run_steps(3);
    assert_eq!(ui.state().dialog, None);
    assert!(SceneFile::open(&right).is_ok(), "Enter is enough");
}

#[test]
fn a_format_that_cannot_be_written_is_refused() {
    let (mut ui, folder) = (open("cornell"), folder());
    receive(&mut ui, frame(1, false, 16));
    path_field(&mut ui, Key::E);
    type_path(&mut ui, &folder.path().join("x.bmp"));
    ui.key_press(Key::Enter);
    ui.run_steps(3);
    assert!(ui.query_by_label_contains("A .bmp file cannot be written").is_some(), "it says so");
    assert!(ui.query_by_label_contains(".png").is_some(), "and what can be");
    assert!(ui.get_by_role_and_label(Role::TextInput, "Path").is_focused(), "and stays open to be corrected");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is written under another name");
}

#[test]
fn the_selected_surface_is_exported_with_the_chosen_steps() {
    let (mut ui, folder) = (open("report"), folder());
    let path = folder.path().join("sheet.obj");
    answer_dialogs(&mut ui, Some(path.clone()));
    choose_from_menu(&mut ui, &["File", "Export surface… Ctrl+Shift+E"]);
    type_number(&mut ui, "Quads along each side of a patch", "3");
    wait_until(&mut ui, "the mesh", |_| path.exists());
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.starts_with("o sheet\n"), "{}", &text[..20]);
    assert_eq!(text.lines().filter(|line| line.starts_with("f ")).count(), 9, "3 x 3 quads");
}

#[test]
fn a_scene_without_patches_has_no_surface_to_export() {
    let mut ui = open("cornell");
    ui.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::E);
    ui.run_steps(3);
    assert_eq!(ui.state().dialog, None);
}

#[test]
fn a_saved_example_has_its_files_beside_it() {
    let (mut ui, folder) = (open("teapot"), folder());
    let path = folder.path().join("mine.toml");
    answer_dialogs(&mut ui, Some(path.clone()));
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the save", |_| path.exists());
    assert_eq!(SceneFile::open(&path).unwrap().scene, *scene(&ui), "it opens again");
}

fn drop_file(ui: &mut Ui, path: std::path::PathBuf) {
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Drop(path));
    ui.run_steps(2);
}

#[test]
fn dropped_control_points_become_an_object_that_is_saved_with_its_file() {
    let (mut ui, folder) = (open("cornell"), folder());
    let (bpt, path) = (folder.path().join("pot.bpt"), folder.path().join("mine.toml"));
    std::fs::copy("scenes/teapot.bpt", &bpt).unwrap();
    drop_file(&mut ui, bpt);
    let object = scene(&ui).objects.last().unwrap().clone();
    assert!(matches!(&object.shape, Shape::Bezier(bezier) if bezier.patches.len() == 32), "{object:?}");
    assert_eq!(object.name, "pot");
    answer_dialogs(&mut ui, Some(path.clone()));
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the save", |_| path.exists());
    assert!(std::fs::read_to_string(&path).unwrap().contains("file = \"pot.bpt\""), "the file is named, not copied");

    std::fs::write(folder.path().join("bad.bpt"), "1\n3 2\n").unwrap();
    let before = scene(&ui).clone();
    drop_file(&mut ui, folder.path().join("bad.bpt"));
    let said = matches!(&ui.state().dialog, Some(Dialog::Error(_, text)) if text.contains("line 2"));
    assert!(said, "it says where the fault is");
    assert_eq!(*scene(&ui), before);
}

#[test]
fn a_dropped_picture_becomes_a_texture_and_a_dropped_scene_is_opened() {
    let mut ui = open("cornell");
    drop_file(&mut ui, "scenes/teapot.toml".into());
    assert_eq!(ui.state().document.file().location, Location::Disk("scenes/teapot.toml".into()));
    let before = scene(&ui).textures.len();
    drop_file(&mut ui, "picture.PNG".into());
    assert_eq!((scene(&ui).textures.len(), scene(&ui).textures[before].name.as_str()), (before + 1, "picture"));
}

#[test]
fn enter_closes_a_message() {
    let mut ui = open("cornell");
    ui.state_mut().dialog = Some(Dialog::Error("A title".into(), "A text".into()));
    ui.run_steps(2);
    ui.key_press(Key::Enter);
    ui.run_steps(2);
    assert_eq!(ui.state().dialog, None);
}
