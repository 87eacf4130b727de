use super::*;
use crate::app::rendering::Sampling;

#[test]
fn a_warning_names_a_renamed_item_by_its_new_name() {
    let mut ui = open("cornell");
    let object = scene(&ui).objects[0].clone();
    let mut warned = Arc::unwrap_or_clone(frame(1, false, 8));
    let warnings = vec![crate::world::Warning {
        subject: format!("object \"{}\"", object.name),
        fault: "is open".into(),
        remedy: "close it".into(),
    }];
    warned.plan = Arc::new(PlanSummary { notes: Vec::new(), warnings });
    receive(&mut ui, Arc::new(warned));
    assert!(ui.query_by_label(&format!("object \"{}\" is open.", object.name)).is_some());
    let renamed = crate::scene::Object { name: "lawn".into(), ..object };
    ui.state_mut().document.edit(crate::app::document::Edit::Object(0, renamed));
    ui.run_steps(3);
    assert!(ui.query_by_label("object \"lawn\" is open.").is_some());
}

#[test]
fn a_frame_becomes_the_texture_and_fills_the_panels() {
    let mut ui = open("cornell");
    assert!(ui.state().display.texture().is_none(), "no frame has arrived");
    receive(&mut ui, frame(1, false, 16));
    wait_until(&mut ui, "the texture", |ui| ui.state().display.texture().is_some());
    assert_eq!(ui.state().display.texture().unwrap().size(), [16, 16]);
    ui.get_by_label("Statistics").click();
    ui.run_steps(20);
    for text in ["120 000", "80.00 k", "5.00 %", "200.0 ms"] {
        assert!(ui.query_by_label(text).is_some(), "{text} is not shown");
    }
}

#[test]
fn the_newest_picture_is_shown_last() {
    let mut ui = open("cornell");
    for size in 1..=20 {
        ui.state_mut().rendering.receive(Some(frame(1, false, size)), Status::Rendering);
        ui.run_steps(1);
    }
    let newest = |ui: &mut Ui| ui.state().display.texture().is_some_and(|texture| texture.size() == [20, 20]);
    wait_until(&mut ui, "the newest picture", newest);
}

#[test]
fn the_plan_gives_the_reason_of_a_skipped_component() {
    let mut ui = open("cornell");
    receive(&mut ui, frame(1, false, 16));
    ui.get_by_label("Plan").click();
    ui.run_steps(20);
    assert!(ui.query_by_label("skipped: no specular surface").is_some(), "the reason is shown");
}

#[test]
fn a_failure_is_reported_and_the_scene_stays() {
    let mut ui = open("cornell");
    ui.state_mut().rendering.receive(None, Status::Failed("the photon pass stopped".to_owned()));
    ui.run_steps(2);
    assert!(ui.query_by_label_contains("the photon pass stopped").is_some(), "the reason");
    type_number(&mut ui, "Corner x", "-0.9");
    assert!(ui.state().document.is_dirty(), "the scene can be edited");
}

#[test]
fn the_first_estimate_is_shown() {
    let mut ui = open("cornell");
    receive(&mut ui, frame(1, true, 8));
    assert!(ui.query_by_label("No error estimate yet").is_some(), "a draft has no estimate");
    receive(&mut ui, frame(1, false, 16));
    assert!(ui.query_by_label("No error estimate yet").is_none(), "one measurement is an estimate");
}

/// The tint of the picture: white, or grey where it is dimmed.
fn tint(ui: &Ui) -> egui::Color32 {
    let texture = ui.state().display.texture().unwrap().id();
    let of_picture = ui.output().shapes.iter().find_map(|clipped| match &clipped.shape {
        egui::Shape::Mesh(mesh) if mesh.texture_id == texture => mesh.vertices.first().map(|vertex| vertex.color),
        _ => None,
    });
    of_picture.unwrap()
}

#[test]
fn a_picture_of_another_scene_is_dimmed() {
    let mut ui = open("cornell");
    receive(&mut ui, frame(1, false, 16));
    wait_until(&mut ui, "the texture", |ui| ui.state().display.texture().is_some());
    ui.run_steps(2);
    assert_eq!(tint(&ui), egui::Color32::WHITE);
    let transform = ui.state().canvas.transform;
    ui.state_mut().rendering.receive(None, Status::Failed("the photon pass stopped".to_owned()));
    ui.run_steps(2);
    assert_ne!(tint(&ui), egui::Color32::WHITE, "the picture shows another scene");
    assert_eq!(ui.state().canvas.transform, transform, "the message lies over the picture and moves nothing");
}

#[test]
fn the_target_error_is_set_in_the_panel() {
    let mut ui = open("cornell");
    ui.state_mut().rendering.receive(Some(frame(1, false, 8)), Status::Rendering);
    ui.run_steps(2);
    ui.state_mut().rendering.take_commands();
    let field = |ui: &Ui| ui.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Stop at error").rect().center();
    let at = field(&ui);
    ui.drag_at(at);
    ui.run_steps(2);
    ui.hover_at(at + egui::vec2(40.0, 0.0));
    ui.run_steps(2);
    ui.drop_at(at + egui::vec2(40.0, 0.0));
    ui.run_steps(2);
    let target = ui.state().rendering.target().expect("a target error is set");
    assert!(target > 0.002, "0.001 in the beginning, dragged to {target}");
    let commands = ui.state_mut().rendering.take_commands();
    assert!(matches!(commands.last(), Some(Command::Target(Some(sent))) if *sent == target), "{commands:?}");
    ui.state_mut().rendering.receive(None, Status::Converged);
    ui.run_steps(2);
    assert!(ui.query_by_label("Converged").is_some());
}

/// The numbers over the picture: red, green and blue of a pixel in three lines.
fn numbers(ui: &Ui) -> Vec<String> {
    let texts = ui.output().shapes.iter().filter_map(|clipped| match &clipped.shape {
        egui::Shape::Text(text) if text.galley.rows.len() == 3 => Some(text.galley.text().to_owned()),
        _ => None,
    });
    texts.filter(|text| text.lines().all(|line| line.parse::<f32>().is_ok())).collect()
}

#[test]
fn magnified_pixels_have_sharp_edges_and_numbers() {
    let mut ui = open("report");
    let size = scene(&ui).film.width;
    receive(&mut ui, frame(1, false, size));
    wait_until(&mut ui, "the texture", |ui| ui.state().display.texture().is_some());
    ui.state_mut().canvas.zoom(8.0);
    // In the frame of the zoom: no other may follow.
    ui.run_steps(1);
    assert_eq!(ui.state().display.sampling(), Sampling::Pixels);
    assert!(numbers(&ui).is_empty(), "there is no room for numbers");
    ui.state_mut().canvas.zoom(8.0);
    ui.run_steps(3);
    let shown = numbers(&ui);
    assert!(shown.len() > 20, "{} pixels have numbers", shown.len());
    assert!(shown.contains(&"0.1429\n0.1429\n0.1429".to_owned()), "{:?}", shown.first());
    receive(&mut ui, frame(2, true, 8));
    ui.run_steps(3);
    assert!(numbers(&ui).is_empty(), "a coarse draft has no pixels to tell about");
}
