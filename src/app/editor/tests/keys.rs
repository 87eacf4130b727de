use super::*;

fn commands(ui: &mut Ui) -> Vec<&'static str> {
    let name = |command| match command {
        Command::Show(_) => "show",
        Command::Pause => "pause",
        Command::Resume => "resume",
        Command::Restart => "restart",
        Command::Target(_) => "target",
        Command::Smooth(true) => "smooth",
        Command::Smooth(false) => "as it is",
        Command::Only(_) => "only",
        Command::Limits(_) => "limits",
        Command::Noise(_) => "noise",
    };
    ui.state_mut().rendering.take_commands().into_iter().map(name).collect()
}

#[test]
fn space_pauses_and_resumes_and_r_restarts() {
    let mut ui = open("cornell");
    assert_eq!(commands(&mut ui), ["target", "smooth", "show"], "rendering begins at once");
    ui.key_press(Key::Space);
    ui.run_steps(2);
    assert_eq!(commands(&mut ui), ["pause"]);
    ui.state_mut().rendering.receive(None, Status::Rendering);
    ui.run_steps(2);
    assert!(ui.query_by_label("Pausing after this iteration").is_some(), "the engine finishes its iteration");
    ui.key_press(Key::Space);
    ui.run_steps(2);
    assert_eq!(commands(&mut ui), ["resume"], "resuming works before the engine has paused");
    ui.key_press(Key::Space);
    ui.run_steps(2);
    ui.state_mut().rendering.receive(None, Status::Paused);
    ui.run_steps(2);
    assert!(ui.query_by_label("Paused").is_some());
    ui.key_press(Key::Space);
    ui.run_steps(2);
    assert_eq!(commands(&mut ui), ["pause", "resume"]);
    ui.key_press(Key::R);
    ui.run_steps(2);
    assert_eq!(commands(&mut ui), ["restart"]);
}

#[test]
fn n_shows_the_interreflection_smoothed_or_as_it_is() {
    let mut ui = open("cornell");
    commands(&mut ui);
    let is_told = |ui: &Ui| ui.query_by_label_contains(", smoothed").is_some();
    receive(&mut ui, frame(1, false, 16));
    assert!(!is_told(&ui));
    let smoothed = Frame { smoothed: true, ..Frame::clone(&frame(1, false, 16)) };
    receive(&mut ui, Arc::new(smoothed));
    assert!(is_told(&ui), "the status bar tells that the screen shows less noise");
    ui.key_press(Key::N);
    ui.run_steps(2);
    assert_eq!(commands(&mut ui), ["as it is"]);
    choose_from_menu(&mut ui, &["View"]);
    ui.get_by_label_contains("Smooth interreflection").click();
    ui.run_steps(2);
    assert_eq!(commands(&mut ui), ["smooth"]);
}

#[test]
fn a_focused_text_field_blocks_shortcuts() {
    let mut ui = open("cornell");
    type_number(&mut ui, "Corner x", "-0.5");
    let edited = scene(&ui).clone();
    commands(&mut ui);
    ui.get_by_role_and_label(Role::TextInput, "Name").click();
    ui.run_steps(2);
    for key in [Key::Space, Key::R, Key::Delete] {
        ui.key_press(key);
        ui.run_steps(1);
    }
    ui.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    ui.run_steps(2);
    assert_eq!(*scene(&ui), edited, "nothing was undone or deleted");
    assert!(commands(&mut ui).is_empty(), "nothing was paused or restarted");
}

/// Opens the palette, types, and presses Enter.
fn run_from_palette(ui: &mut Ui, text: &str) {
    press(ui, Key::P);
    focused(ui).type_text(text);
    ui.run_steps(2);
    ui.key_press(Key::Enter);
    ui.run_steps(3);
}

#[test]
fn the_palette_runs_what_it_finds() {
    let mut ui = open("cornell");
    run_from_palette(&mut ui, "sphere add");
    assert!(ui.state().dialog.is_none(), "the palette is closed");
    assert!(matches!(scene(&ui).objects.last().unwrap().shape, Shape::Sphere { .. }));
    run_from_palette(&mut ui, "undo");
    assert!(!matches!(scene(&ui).objects.last().unwrap().shape, Shape::Sphere { .. }));
    run_from_palette(&mut ui, "keys and mouse");
    assert_eq!(ui.state().dialog, Some(Dialog::Help), "a command may open another dialog");
    ui.key_press(Key::Escape);
    ui.run_steps(3);
    run_from_palette(&mut ui, "select cei");
    let ceiling = scene(&ui).objects.iter().position(|object| object.name == "ceiling").unwrap();
    assert_eq!(ui.state().document.selection.item, Item::Object(ceiling));
    press(&mut ui, Key::P);
    focused(&ui).type_text("add");
    ui.run_steps(2);
    ui.key_press(Key::ArrowDown);
    ui.run_steps(2);
    ui.key_press(Key::Enter);
    ui.run_steps(3);
    assert!(
        scene(&ui).objects.last().unwrap().shape.surface().is_some_and(|surface| surface.patches.len() == 4),
        "the second one: a grid after the patch"
    );
}

#[test]
fn the_hint_goes_with_the_first_edit_or_when_closed() {
    let hint = "Drag a dot of the surface, and watch its light.";
    let mut ui = open("cornell");
    assert!(ui.query_by_label(hint).is_some());
    edit(&mut ui);
    assert!(ui.query_by_label(hint).is_none());
    let mut ui = open("cornell");
    click(&mut ui, "Close the hint");
    assert!(ui.query_by_label(hint).is_none());
}

#[test]
fn f1_lists_the_keys() {
    let mut ui = open("cornell");
    ui.key_press(Key::F1);
    ui.run_steps(3);
    assert_eq!(ui.state().dialog, Some(Dialog::Help));
    for label in ["Pause or resume", "Undo", "Export picture…", "Esc"] {
        assert!(ui.query_by_label(label).is_some(), "{label} is not in the help");
    }
    ui.key_press(Key::Escape);
    ui.run_steps(3);
    assert_eq!(ui.state().dialog, None);
}

#[test]
fn panels_can_be_hidden() {
    let mut ui = open("cornell");
    let narrow = ui.state().canvas.transform.unwrap().canvas.width();
    ui.key_press_modifiers(Modifiers::COMMAND, Key::B);
    ui.run_steps(3);
    assert!(
        ui.state().canvas.transform.unwrap().canvas.width() > narrow + 300.0,
        "the canvas takes the space of the panels"
    );
}

#[test]
fn the_help_fits_in_a_small_window() {
    let mut ui = open("cornell");
    ui.set_size(egui::vec2(640.0, 400.0));
    ui.key_press(Key::F1);
    ui.run_steps(4);
    let close = ui.get_by_role_and_label(Role::Button, "Close").rect();
    assert!(close.max.y < 400.0, "the button is visible: {close}");
}

#[test]
fn no_key_scales_the_interface() {
    let mut ui = open("cornell");
    ui.key_press(Key::F1);
    ui.run_steps(3);
    for key in [Key::Minus, Key::Plus, Key::Num0] {
        press(&mut ui, key);
        assert_eq!(ui.ctx.zoom_factor(), 1.0, "{key:?} under a dialog");
    }
}

#[test]
fn text_typed_in_the_frame_of_tab_is_kept() {
    let mut ui = open("cornell");
    ui.get_by_role_and_label(Role::SpinButton, "Corner x").click();
    ui.run_steps(2);
    ui.key_press_modifiers(Modifiers::COMMAND, Key::A);
    ui.run_steps(2);
    let tab = egui::Event::Key {
        key: Key::Tab,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    let text = |text: &str| egui::Event::Text(text.to_owned());
    ui.input_mut().events.extend([text("1."), text("25"), tab.clone(), text("3.5"), tab]);
    ui.run_steps(6);
    let crate::scene::Shape::Quad { corner, .. } = scene(&ui).objects[0].shape else { panic!("a quad is selected") };
    assert_eq!((corner.x, corner.y), (1.25, 3.5));
}

#[test]
fn the_guide_stays_open_beside_the_picture_until_it_is_closed() {
    let mut ui = open("cornell");
    choose_from_menu(&mut ui, &["Help"]);
    ui.get_by_label_contains("Guide").click();
    ui.run_steps(3);
    assert!(ui.state().show_guide && ui.state().dialog.is_none());
    ui.get_by_label_contains("A caustic in ten minutes");
    ui.key_press_modifiers(Modifiers::SHIFT, Key::F1);
    ui.run_steps(3);
    assert!(!ui.state().show_guide && ui.query_by_label_contains("A caustic in ten minutes").is_none());
}

/// The guide names menus and entries as they are.
#[test]
fn the_guide_names_what_there_is() {
    let text = include_str!("../../../../docs/guide.md");
    for example in
        crate::scene::built_in_scenes().iter().filter(|scene| ["lens", "cardioid", "water"].contains(&scene.name))
    {
        assert!(text.contains(&format!("*File > Examples > {}*", example.title)), "{}", example.title);
    }
    for label in ["Caustics alone", "Open reference picture"] {
        assert!(text.contains(&format!("*Inspect > {label}*")), "{label}");
    }
}
