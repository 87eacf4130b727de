use super::*;

fn wait_for_image(ui: &mut Ui) {
    wait_until(ui, "the analysis", |ui| ui.state().canvas.analysis.is_shown());
}

#[test]
fn analyses_are_toggled_by_keys_and_restart_no_rendering() {
    let mut ui = open("report");
    sent_scenes(&mut ui);
    let before = Arc::clone(ui.state().document.file());
    ui.key_press(Key::K);
    ui.run_steps(2);
    wait_for_image(&mut ui);
    ui.run_steps(2);
    assert!(ui.query_by_label("Mean curvature, per unit").is_some(), "the legend");
    ui.key_press_modifiers(Modifiers::SHIFT, Key::K);
    ui.run_steps(2);
    wait_for_image(&mut ui);
    ui.run_steps(2);
    assert!(ui.query_by_label("Gaussian curvature, per unit²").is_some(), "one shading at a time");
    press(&mut ui, Key::K);
    ui.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::K);
    ui.run_steps(2);
    wait_for_image(&mut ui);
    ui.run_steps(2);
    assert!(ui.query_by_label_contains("curvature, per unit").is_none(), "stripes have no numbers");
    assert!(sent_scenes(&mut ui).is_empty(), "the rendering goes on");
    assert!(Arc::ptr_eq(ui.state().document.file(), &before), "the document stays");
}

#[test]
fn an_analysis_follows_edits_and_the_selection() {
    let mut ui = open("report");
    press(&mut ui, Key::K);
    wait_for_image(&mut ui);
    type_number(&mut ui, "Translate x", "+0.1");
    assert!(!ui.state().canvas.analysis.is_shown() || ui.state().document.is_dirty());
    wait_for_image(&mut ui);
    let ball = first_object(&ui, |shape| matches!(shape, Shape::Sphere { .. }));
    select(&mut ui, Item::Object(ball));
    assert!(!ui.state().canvas.analysis.is_shown(), "a ball has no patches");
}

fn wait_for_light_paths(ui: &mut Ui) {
    wait_until(ui, "the light paths", |ui| ui.state().canvas.light_paths.shown().is_some());
    ui.run_steps(2);
}

#[test]
fn light_paths_are_off_at_first_and_restart_no_rendering() {
    let mut ui = open("cardioid");
    sent_scenes(&mut ui);
    let before = Arc::clone(ui.state().document.file());
    assert!(!ui.state().canvas.light_paths.on && ui.query_by_label("Light paths").is_none());
    ui.key_press_modifiers(Modifiers::ALT, Key::K);
    ui.run_steps(2);
    wait_for_light_paths(&mut ui);
    assert!(ui.query_by_label("Ways of light").is_some(), "the legend");
    let paths = ui.state().canvas.light_paths.shown().unwrap();
    assert!(!paths.edges.is_empty() && paths.lines.iter().all(|lines| lines.len() >= 9), "the cardioid and its lines");
    ui.key_press_modifiers(Modifiers::ALT, Key::K);
    ui.run_steps(2);
    assert!(ui.query_by_label("Light paths").is_none() && ui.state().canvas.light_paths.shown().is_none());
    assert!(sent_scenes(&mut ui).is_empty(), "the rendering goes on");
    assert!(Arc::ptr_eq(ui.state().document.file(), &before), "the document stays");
}

#[test]
fn light_paths_follow_edits_and_the_selection() {
    let mut ui = open("cardioid");
    ui.state_mut().canvas.light_paths.on = true;
    ui.run_steps(2);
    wait_for_light_paths(&mut ui);
    let shown = |ui: &Ui| ui.state().canvas.light_paths.shown().cloned().unwrap();
    let before = shown(&ui);
    type_number(&mut ui, "Translate x", "+0.1");
    wait_for_light_paths(&mut ui);
    let after = shown(&ui);
    assert!(!after.edges.is_empty() && after.edges != before.edges, "the mirror moved");
    select(&mut ui, Item::Light(0));
    assert!(ui.query_by_label("Select a surface of patches").is_some(), "a lamp has no patches");
    ui.state_mut().document.selection = Selection::first_of(scene(&ui));
    ui.run_steps(2);
    wait_for_light_paths(&mut ui);
    assert_eq!(shown(&ui), after);
    let mut ui = open("report");
    ui.state_mut().canvas.light_paths.on = true;
    ui.run_steps(2);
    assert!(ui.query_by_label("The surface needs a material of mirror or glass").is_some(), "a sheet of paper");
}
