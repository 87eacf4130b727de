use super::*;
use crate::app::commands::{AppCommand, Next};
use crate::scene::Location;

#[test]
fn a_scene_is_saved_to_the_chosen_path_and_then_to_its_file() {
    let (mut ui, folder) = (open("cornell"), folder());
    let path = folder.path().join("mine.toml");
    answer_dialogs(&mut ui, Some(path.clone()));
    edit(&mut ui);
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the save", |ui| !ui.state().document.is_dirty());
    assert_eq!(SceneFile::open(&path).unwrap().scene, *scene(&ui), "the saved scene is the present scene");

    answer_dialogs(&mut ui, None);
    type_number(&mut ui, "Corner x", "-0.8");
    press(&mut ui, Key::S);
    assert!(!ui.state().document.is_dirty(), "a scene with a file is saved without a dialog");
    assert_eq!(SceneFile::open(&path).unwrap().scene, *scene(&ui), "saved again");
}

#[test]
fn without_file_dialogs_the_path_is_typed() {
    let (mut ui, folder) = (open("cornell"), folder());
    answer_dialogs(&mut ui, None);
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the path field", |ui| matches!(ui.state().dialog, Some(Dialog::Path(..))));
    ui.run_steps(2);
    let path = folder.path().join("typed");
    type_path(&mut ui, &path);
    click(&mut ui, "Save");
    assert_eq!(ui.state().dialog, None);
    assert!(SceneFile::open(&path.with_extension("toml")).is_ok(), "saved with the default extension");
}

#[test]
fn a_file_is_replaced_only_after_a_confirmation() {
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
fn a_broken_file_is_reported_and_the_scene_stays() {
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
fn unsaved_changes_are_never_discarded_unasked() {
    let mut ui = open("cornell");
    edit(&mut ui);
    let edited = scene(&ui).clone();
    choose_from_menu(&mut ui, &["File", "New scene Ctrl+N"]);
    assert!(ui.query_by_label("Save the changes?").is_some(), "the dialog asks");
    click(&mut ui, "Cancel");
    assert_eq!(*scene(&ui), edited, "cancelling keeps the scene");

    for next in [Next::Quit, Next::Example("water"), Next::Open("scenes/teapot.toml".into())] {
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
    assert_eq!(ui.state().document.file().location, Location::Unsaved, "the new scene is open");
}

#[test]
fn saving_before_leaving_opens_the_next_scene() {
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
    assert!(SceneFile::open(&path).is_ok(), "the edits are saved");
}

#[test]
fn a_scene_that_is_saved_before_it_is_opened_again_opens_as_saved() {
    let (mut ui, folder) = (open("cornell"), folder());
    let path = folder.path().join("mine.toml");
    answer_dialogs(&mut ui, Some(path.clone()));
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the save", |_| path.exists());
    edit(&mut ui);
    let edited = scene(&ui).clone();
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Leave(Next::Open(path)));
    ui.run_steps(2);
    click(&mut ui, "Save");
    assert_eq!(*scene(&ui), edited, "not the scene before the save");
}

#[test]
fn a_cancelled_save_keeps_the_scene_open() {
    let mut ui = open("cornell");
    // A user needs a moment to cancel; a dialog that returns sooner was never shown.
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
fn a_hanging_dialog_can_be_dismissed() {
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
fn a_typed_path_that_fails_can_be_corrected() {
    let (mut ui, folder) = (open("cornell"), folder());
    path_field(&mut ui, Key::S);
    let wrong = folder.path().join("no such folder/mine.toml");
    type_path(&mut ui, &wrong);
    ui.key_press(Key::Enter);
    ui.run_steps(3);
    assert!(ui.query_by_label_contains("cannot be written").is_some(), "why");
    let text = ui.get_by_role_and_label(Role::TextInput, "Path").value();
    assert_eq!(text, Some(wrong.display().to_string()), "the typed path is kept");
    assert!(ui.get_by_role_and_label(Role::TextInput, "Path").is_focused(), "the path field has the keyboard");
    let right = folder.path().join("mine.toml");
    type_path(&mut ui, &right);
    ui.key_press(Key::Enter);
    ui.run_steps(3);
    assert_eq!(ui.state().dialog, None);
    assert!(SceneFile::open(&right).is_ok(), "Enter is enough");
}

#[test]
fn a_saved_example_is_saved_with_its_files() {
    let (mut ui, folder) = (open("teapot"), folder());
    let path = folder.path().join("mine.toml");
    answer_dialogs(&mut ui, Some(path.clone()));
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the save", |_| path.exists());
    assert_eq!(SceneFile::open(&path).unwrap().scene, *scene(&ui), "the saved scene opens");
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

#[test]
fn a_file_that_another_program_changed_is_replaced_only_after_a_question() {
    let (mut ui, folder) = (open("cornell"), folder());
    let (path, copy) = (folder.path().join("mine.toml"), folder.path().join("copy.toml"));
    answer_dialogs(&mut ui, Some(path.clone()));
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the save", |_| path.exists());
    edit(&mut ui);
    std::fs::write(&path, "# the work of another program").unwrap();
    press(&mut ui, Key::S);
    assert!(ui.query_by_label("Replace the changed file?").is_some(), "the dialog asks");
    click(&mut ui, "Cancel");
    let text = || std::fs::read_to_string(&path).unwrap();
    assert_eq!(text(), "# the work of another program");
    assert!(ui.state().document.is_dirty(), "nothing is saved");

    answer_dialogs(&mut ui, Some(copy.clone()));
    press(&mut ui, Key::S);
    click(&mut ui, "Save as…");
    wait_until(&mut ui, "the copy", |_| copy.exists());
    assert_eq!(text(), "# the work of another program", "the copy is another file");

    type_number(&mut ui, "Corner x", "-0.8");
    std::fs::write(&copy, "# changed, too").unwrap();
    press(&mut ui, Key::S);
    click(&mut ui, "Replace");
    assert_eq!(SceneFile::open(&copy).unwrap().scene, *scene(&ui), "replaced");
    press(&mut ui, Key::S);
    assert_eq!(ui.state().dialog, None, "an unchanged file is saved without a question");
}

#[test]
fn a_second_file_dialog_waits_for_the_answer_to_the_first() {
    let (mut ui, folder) = (open("cornell"), folder());
    let path = folder.path().join("mine.toml");
    let (confirm, confirmed) = std::sync::mpsc::channel();
    let confirmed = std::sync::Mutex::new(confirmed);
    ui.state_mut().chooser = Chooser::new(Arc::new(move |_: &Request| confirmed.lock().unwrap().recv().ok()));
    press(&mut ui, Key::S);
    press(&mut ui, Key::O);
    assert_eq!(ui.state().toasts.len(), 1, "the message");
    confirm.send(path.clone()).unwrap();
    wait_until(&mut ui, "the save", |_| path.exists());
    assert!(ui.state().chooser.pending().is_none(), "no dialog is open");
}

#[test]
fn enter_saves_the_changes_before_leaving() {
    let (mut ui, folder) = (open("cornell"), folder());
    let path = folder.path().join("mine.toml");
    answer_dialogs(&mut ui, Some(path.clone()));
    edit(&mut ui);
    // The keyboard focus of a field under the dialog does not take Enter.
    ui.get_by_role_and_label(Role::TextInput, "Name").click();
    ui.run_steps(2);
    press(&mut ui, Key::N);
    assert!(ui.query_by_label("Save the changes?").is_some(), "the dialog asks");
    ui.key_press(Key::Enter);
    ui.run_steps(2);
    wait_until(&mut ui, "the save", |_| path.exists());
}

#[test]
fn typing_replaces_the_proposed_path() {
    let (mut ui, folder) = (open("cornell"), folder());
    path_field(&mut ui, Key::S);
    let path = folder.path().join("mine.toml");
    focused(&ui).type_text(&path.display().to_string());
    ui.run_steps(2);
    let text = ui.get_by_role_and_label(Role::TextInput, "Path").value();
    assert_eq!(text, Some(path.display().to_string()));
}
