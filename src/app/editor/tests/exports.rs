use super::*;

#[test]
fn a_picture_is_exported_after_its_first_iteration() {
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
fn a_picture_is_exported_with_less_noise_only_as_shown() {
    let (mut ui, folder) = (open("cornell"), folder());
    let mut with_preview = frame(1, false, 16).as_ref().clone();
    let smooth = LinearImage { width: 16, height: 16, pixels: vec![Rgb::splat(0.5); 256] };
    with_preview.preview = Some(Arc::new(smooth));
    receive(&mut ui, Arc::new(with_preview));
    let mut exported = |item: &str, name: &str| {
        let path = folder.path().join(name);
        answer_dialogs(&mut ui, Some(path.clone()));
        choose_from_menu(&mut ui, &["File", item]);
        wait_until(&mut ui, "the picture", |_| path.exists());
        let image = image::open(&path).unwrap().into_rgb8();
        image.pixels().all(|pixel| pixel == image.get_pixel(0, 0))
    };
    assert!(!exported("Export picture… Ctrl+E", "film.png"), "the picture as it is");
    assert!(exported("Export picture as shown…", "shown.png"), "the preview");
}

#[test]
fn a_failed_export_is_reported() {
    let (mut ui, folder) = (open("cornell"), folder());
    answer_dialogs(&mut ui, Some(folder.path().join("no such folder/picture.exr")));
    receive(&mut ui, frame(1, false, 16));
    press(&mut ui, Key::E);
    wait_until(&mut ui, "the path field", |ui| matches!(ui.state().dialog, Some(Dialog::Path(..))));
    ui.run_steps(2);
    assert!(ui.query_by_label_contains("no such folder/picture.exr: cannot be written").is_some(), "the reason");
    ui.key_press(Key::Escape);
    ui.run_steps(3);
    assert_eq!(ui.state().dialog, None, "Esc closes the path field");
}

#[test]
fn an_unknown_format_is_refused() {
    let (mut ui, folder) = (open("cornell"), folder());
    receive(&mut ui, frame(1, false, 16));
    path_field(&mut ui, Key::E);
    type_path(&mut ui, &folder.path().join("x.bmp"));
    ui.key_press(Key::Enter);
    ui.run_steps(3);
    assert!(ui.query_by_label_contains("A .bmp file cannot be written").is_some(), "the message names the format");
    assert!(ui.query_by_label_contains(".png").is_some(), "the field lists the formats");
    assert!(ui.get_by_role_and_label(Role::TextInput, "Path").is_focused(), "the path field has the keyboard");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "no file is written");
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
fn the_picture_on_the_screen_is_copied_to_the_clipboard() {
    let mut ui = open("cornell");
    let copied = |ui: &mut Ui| {
        choose_from_menu(ui, &["File"]);
        ui.get_by_role_and_label(Role::Button, "Copy picture").click();
        ui.step();
        let commands = ui.output().platform_output.commands.clone();
        commands.into_iter().find_map(|command| match command {
            egui::OutputCommand::CopyImage(image) => Some(image),
            _ => None,
        })
    };
    assert!(copied(&mut ui).is_none(), "there is no picture yet");
    receive(&mut ui, frame(1, false, 16));
    assert_eq!(copied(&mut ui).map(|image| image.size), Some([16, 16]));
}
