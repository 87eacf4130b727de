use super::*;
use crate::app::canvas::Projection;
use crate::app::document::PointIndex;
use crate::scene::Bezier;
use glam::DVec3;

/// A control point of the selected object.
fn point(ui: &Ui, patch: usize, i: usize, j: usize) -> Handle {
    let Item::Object(object) = ui.state().document.selection.item else { panic!("an object is selected") };
    Handle::Point { object, point: PointIndex { patch, i, j } }
}

fn at(ui: &Ui, handle: Handle) -> DVec3 {
    handle.position(scene(ui)).unwrap()
}

fn screen(ui: &Ui, label: &str) -> Pos2 {
    ui.get_by_label(label).rect().center()
}

/// The report scene with P[1][2] of its sheet selected.
fn with_point() -> (Ui, Handle) {
    let mut ui = open("report");
    ui.get_by_label("Control point P[1][2]").click();
    ui.run_steps(2);
    let handle = point(&ui, 0, 1, 2);
    (ui, handle)
}

fn bezier(ui: &Ui) -> &Bezier {
    ui.state().document.selection.bezier(scene(ui)).unwrap()
}

#[test]
fn arrows_move_along_their_axis_and_squares_in_their_plane() {
    for (part, free) in
        [("Move along x", DVec3::X), ("Move along y", DVec3::Y), ("Move in x and z", DVec3::new(1.0, 0.0, 1.0))]
    {
        let (mut ui, handle) = with_point();
        let (start, grip) = (at(&ui, handle), screen(&ui, part));
        drag_and_drop(&mut ui, grip, vec2(23.0, -31.0));
        let moved = at(&ui, handle) - start;
        assert!((moved * free).length() > 0.01, "{part} moved by {moved}");
        // The rounding error of numbers of size 1.
        assert!((moved * (DVec3::ONE - free)).length() < 1e-12, "{part} moved by {moved}");
        ui.state_mut().document.undo();
        assert_eq!(at(&ui, handle), start, "one undo step");
    }
}

#[test]
fn the_normal_arrow_and_the_key_n_move_along_the_surface_normal() {
    let (mut ui, handle) = with_point();
    let start = at(&ui, handle);
    let net = bezier(&ui).placed_patches().next().unwrap();
    let normal = net.normal(1.0 / 3.0, 2.0 / 3.0);
    let grip = screen(&ui, "Move along the surface normal");
    drag_and_drop(&mut ui, grip, vec2(4.0, -30.0));
    let moved = at(&ui, handle) - start;
    assert!(moved.length() > 0.01 && moved.cross(normal).length() < 1e-12, "{moved} along {normal}");
    ui.state_mut().document.undo();
    ui.run_steps(2);

    ui.key_down(Key::N);
    let from = screen(&ui, "Control point P[1][2]");
    drag_and_drop(&mut ui, from, vec2(4.0, -30.0));
    ui.key_up(Key::N);
    let moved = at(&ui, handle) - start;
    assert!(moved.length() > 0.01 && moved.cross(normal).length() < 1e-12, "{moved} along {normal} with N");
}

#[test]
fn the_gizmo_moves_a_light_and_an_object() {
    for (item, handle) in [(Item::Light(0), Handle::Light(0)), (Item::Object(1), Handle::Object(1))] {
        let mut ui = open("report");
        select(&mut ui, item);
        let start = at(&ui, handle);
        let grip = screen(&ui, "Move along y");
        drag_and_drop(&mut ui, grip, vec2(0.0, -20.0));
        let moved = at(&ui, handle) - start;
        assert!(moved.y > 0.01 && moved.x.abs() + moved.z.abs() < 1e-12, "{item:?} moved by {moved}");
    }
}

#[test]
fn the_way_of_a_drag_is_shown_while_it_lasts() {
    let (mut ui, _) = with_point();
    let from = screen(&ui, "Move along y");
    drag(&mut ui, from, vec2(0.0, -30.0), 4);
    let shown = |ui: &Ui| ui.query_by_label_contains("x  0.").is_some();
    assert!(shown(&ui), "the way is along y alone");
    ui.drop_at(from + vec2(0.0, -30.0));
    ui.run_steps(2);
    assert!(!shown(&ui), "the drag has ended");
}

#[test]
fn ctrl_snaps_to_the_grid() {
    let (mut ui, handle) = with_point();
    let start = at(&ui, handle);
    ui.state_mut().canvas.grasp.grid = Some(0.05);
    let from = screen(&ui, "Control point P[1][2]");
    drag(&mut ui, from, vec2(31.0, -17.0), 3);
    hold(&mut ui, Modifiers::COMMAND);
    ui.hover_at(from + vec2(33.0, -18.0));
    ui.run_steps(2);
    let steps = at(&ui, handle) / 0.05;
    assert_ne!(at(&ui, handle), start);
    assert!((steps - steps.round()).length() < 1e-9, "{steps} steps of the grid");
    assert!(ui.query_by_label_contains("grid 0.05").is_some(), "the step is shown");
}

#[test]
fn the_step_of_the_grid_is_chosen_in_the_menu() {
    let mut ui = open("report");
    choose_from_menu(&mut ui, &["Select", "Snapping grid"]);
    let steps = ui.query_all_by_role(Role::RadioButton).count();
    assert!(steps >= 8, "{steps} steps");
    ui.get_by_role_and_label(Role::RadioButton, "0.2").click();
    ui.run_steps(3);
    assert_eq!(ui.state().canvas.grasp.grid, Some(0.2));
}

#[test]
fn arrow_keys_nudge_by_one_screen_point_in_one_undo_step() {
    let (mut ui, handle) = with_point();
    let start = at(&ui, handle);
    let projection = Projection::new(&scene(&ui).camera, &scene(&ui).film).unwrap();
    let transform = ui.state().canvas.transform.unwrap();
    let place = |ui: &Ui| projection.project(at(ui, handle)).unwrap() * f64::from(transform.scale);
    let from = place(&ui);
    for _ in 0..3 {
        ui.key_press(Key::ArrowRight);
        ui.run_steps(1);
    }
    ui.key_press_modifiers(Modifiers::SHIFT, Key::ArrowUp);
    ui.run_steps(1);
    let way = place(&ui) - from;
    // Film coordinates of size 1000.
    assert!((way - glam::DVec2::new(3.0, -10.0)).length() < 1e-9, "{way} screen points");
    let before = projection.depth(at(&ui, handle));
    ui.key_press(Key::PageDown);
    ui.run_steps(1);
    assert!(projection.depth(at(&ui, handle)) < before, "nearer");
    assert!((place(&ui) - from - way).length() < 1e-9, "along the ray");
    press(&mut ui, Key::Z);
    assert_eq!(at(&ui, handle), start, "one undo step");
    assert_eq!(ui.state().document.undoable(), None);
}

#[test]
fn nudges_of_two_control_points_are_two_undo_steps() {
    let (mut ui, first) = with_point();
    let start = at(&ui, first);
    ui.key_press(Key::ArrowRight);
    ui.run_steps(1);
    let nudged = at(&ui, first);
    ui.get_by_label("Control point P[2][2]").click();
    ui.run_steps(1);
    ui.key_press(Key::ArrowRight);
    ui.run_steps(1);
    ui.state_mut().document.undo();
    assert_eq!(at(&ui, first), nudged);
    ui.state_mut().document.undo();
    assert_eq!(at(&ui, first), start);
}

#[test]
fn soft_selection_moves_the_neighbours_and_the_wheel_sets_how_far() {
    let (mut ui, handle) = with_point();
    let others = [point(&ui, 0, 2, 2), point(&ui, 0, 3, 0)];
    let distance = |other| at(&ui, other).distance(at(&ui, handle));
    let [near, far] = if distance(others[0]) < distance(others[1]) { others } else { [others[1], others[0]] };
    let starts = [handle, near, far].map(|handle| at(&ui, handle));
    ui.key_press(Key::O);
    ui.run_steps(2);
    assert_eq!(ui.state().toasts.len(), 1, "a message says what the key does");
    let from = screen(&ui, "Control point P[1][2]");
    let view = ui.state().canvas.view;
    drag(&mut ui, from, vec2(0.0, -40.0), 4);
    turn_wheel(&mut ui, 14.0);
    let moved = |ui: &Ui| [0, 1, 2].map(|k| (at(ui, [handle, near, far][k]) - starts[k]).length());
    let [whole, wide, least] = moved(&ui);
    assert!(whole > wide && wide > least && least > 0.01 * whole, "{:?}", moved(&ui));
    assert_eq!(ui.state().canvas.view, view, "the wheel does not zoom");
    turn_wheel(&mut ui, -40.0);
    let [still_whole, wide, least] = moved(&ui);
    // The rounding error of numbers of size 1.
    assert!(wide + least < 1e-12 && still_whole == whole, "no neighbour lies within a tiny radius: {:?}", moved(&ui));
    ui.drop_at(from + vec2(0.0, -40.0));
    ui.run_steps(2);
    ui.state_mut().document.undo();
    assert_eq!(moved(&ui), [0.0; 3], "one undo step");
}

#[test]
fn soft_selection_keeps_welded_points_together() {
    let mut ui = open("teapot");
    let before = point_handles(&ui).len();
    ui.key_press(Key::O);
    ui.run_steps(2);
    let seen = ui.query_all_by_label_contains("Control point patch 0").next();
    let from = seen.expect("a control point of patch 0 is in sight").rect().center();
    drag_and_drop(&mut ui, from, vec2(9.0, -14.0));
    assert!(ui.state().document.is_dirty(), "the points moved");
    assert_eq!(point_handles(&ui).len(), before, "no seam opened");
}

#[test]
fn handles_behind_the_surface_are_shown_with_x_ray_alone() {
    let mut ui = open("teapot");
    wait_until(&mut ui, "the visibility of the handles", |ui| !ui.state().canvas.sight.waits);
    ui.run_steps(1);
    let shown = |ui: &Ui| ui.query_all_by_label_contains("Control point").count();
    let (all, before) = (point_handles(&ui).len(), shown(&ui));
    assert!(before < all * 4 / 5, "{before} of {all} are shown");
    ui.key_press_modifiers(Modifiers::ALT, Key::Z);
    ui.run_steps(2);
    assert!(shown(&ui) > before * 5 / 4, "{} of {all} are shown with X-ray", shown(&ui));
    ui.key_press_modifiers(Modifiers::ALT, Key::Z);
    ui.run_steps(2);
    assert_eq!(shown(&ui), before);
}

#[test]
fn a_drag_ends_where_and_how_the_button_was_released_within_one_frame() {
    let (mut ui, handle) = with_point();
    let start = at(&ui, handle);
    let from = screen(&ui, "Control point P[1][2]");
    ui.key_down(Key::X);
    drag(&mut ui, from, vec2(10.0, 5.0), 2);
    let tenth = at(&ui, handle) - start;
    let moved = |way: egui::Vec2| Event::PointerMoved(from + way);
    let released = Event::PointerButton {
        pos: from + vec2(40.0, 20.0),
        button: egui::PointerButton::Primary,
        pressed: false,
        modifiers: Modifiers::NONE,
    };
    let key_released =
        Event::Key { key: Key::X, physical_key: None, pressed: false, repeat: false, modifiers: Modifiers::NONE };
    let events = [moved(vec2(40.0, 20.0)), released, key_released, moved(vec2(90.0, -60.0))];
    ui.input_mut().events.extend(events);
    ui.run_steps(2);
    let whole = at(&ui, handle) - start;
    // The rounding error of numbers of size 1.
    assert!(whole.y.abs() + whole.z.abs() < 1e-12, "along x until the end: {whole}");
    // Perspective bends the way of a point along an axis by a few per cent.
    assert!((whole.x / tenth.x - 4.0).abs() < 0.4, "{whole} is four times {tenth}");
}

#[test]
fn control_points_of_patches_that_are_tiny_on_the_screen_do_not_cover_them() {
    let mut ui = open("teapot");
    let shown = |ui: &Ui| ui.query_all_by_label_contains("P[").count();
    let near = shown(&ui);
    let mut camera = ui.state().seen_camera();
    camera.position = camera.target + 60.0 * (camera.position - camera.target);
    ui.state_mut().show_camera(camera, "View");
    ui.run_steps(20);
    let far = shown(&ui);
    assert!(
        (16..=16 + 32).contains(&far) && near > 100,
        "{near} near, {far} far: the list, and at most two current patches"
    );
}
