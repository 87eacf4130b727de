use super::*;
use crate::app::canvas::{Projection, View};
use crate::app::document::PointIndex;

use glam::DVec3;

const POINT: &str = "Control point P[1][2]";

fn handle(ui: &Ui) -> Handle {
    let Item::Object(object) = ui.state().document.selection.item else { panic!("the sheet is selected at the start") };
    Handle::Point { object, point: PointIndex { patch: 0, i: 1, j: 2 } }
}

fn world(ui: &Ui) -> DVec3 {
    handle(ui).position(scene(ui)).unwrap()
}

#[test]
fn a_dragged_control_point_follows_the_pointer_in_one_undo_step() {
    let mut ui = open("report");
    let before = scene(&ui).clone();
    let (start, from) = (world(&ui), ui.get_by_label(POINT).rect().center());
    sent_scenes(&mut ui);
    drag(&mut ui, from, vec2(40.0, -30.0), 8);
    ui.drop_at(from + vec2(40.0, -30.0));
    ui.run_steps(2);

    let projection = Projection::new(&scene(&ui).camera, &scene(&ui).film).unwrap();
    let transform = ui.state().canvas.transform.unwrap();
    let there = transform.to_screen(projection.project(world(&ui)).unwrap());
    // The handle is drawn at f32 coordinates of size 1000, and rounded to pixels for assistive technology.
    assert!(there.distance(from + vec2(40.0, -30.0)) < 1.5, "{there:?} is not under the pointer");
    let depth = projection.depth(world(&ui)) - projection.depth(start);
    assert!(depth.abs() < 1e-12, "the point left the plane that faces the camera by {depth}");
    assert!(sent_scenes(&mut ui).len() >= 8, "each move of the pointer is rendered");

    ui.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    ui.run_steps(2);
    assert_eq!(*scene(&ui), before, "one undo step reverts the drag");
    ui.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    ui.run_steps(2);
    assert_ne!(*scene(&ui), before, "redo repeats the drag");
}

#[test]
fn a_drag_that_leaves_the_handle_within_one_frame_still_drags_it() {
    let mut ui = open("report");
    let (start, from) = (world(&ui), ui.get_by_label(POINT).rect().center());
    let view = ui.state().canvas.view;
    let button = |pressed, pos| Event::PointerButton {
        pos,
        button: egui::PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let events = [Event::PointerMoved(from), button(true, from), Event::PointerMoved(from + vec2(45.0, 20.0))];
    ui.input_mut().events.extend(events);
    ui.run_steps(3);
    ui.hover_at(from + vec2(60.0, 20.0));
    ui.run_steps(2);
    ui.drop_at(from + vec2(60.0, 20.0));
    ui.run_steps(2);
    assert_eq!(ui.state().canvas.view, view, "the picture does not move");
    assert_ne!(world(&ui), start, "the handle moves");
}

#[test]
fn a_press_beside_a_handle_takes_the_handle() {
    let mut ui = open("report");
    let (start, at) = (world(&ui), ui.get_by_label(POINT).rect().center());
    let view = ui.state().canvas.view;
    // Beyond the square that takes the pointer.
    let beside = at + vec2(11.0, -2.0);
    drag(&mut ui, beside, vec2(30.0, 0.0), 3);
    ui.drop_at(beside + vec2(30.0, 0.0));
    ui.run_steps(2);
    assert_eq!(ui.state().canvas.view, view, "the picture stays");
    assert_ne!(world(&ui), start, "the handle moves");
    ui.state_mut().document.undo();
    ui.state_mut().document.selection.points.clear();
    ui.run_steps(2);
    drag(&mut ui, beside, vec2(0.0, 0.0), 1);
    ui.drop_at(beside);
    ui.run_steps(2);
    assert_eq!(ui.state().document.selection.points.len(), 1, "a click selects it");
}

#[test]
fn escape_reverts_a_drag() {
    let mut ui = open("report");
    let before = scene(&ui).clone();
    let from = ui.get_by_label(POINT).rect().center();
    drag(&mut ui, from, vec2(25.0, 10.0), 3);
    assert_ne!(*scene(&ui), before);
    ui.key_press(Key::Escape);
    ui.run_steps(2);
    ui.hover_at(from + vec2(50.0, 50.0));
    ui.run_steps(2);
    assert_eq!(*scene(&ui), before, "the button is still down");
    ui.drop_at(from);
    ui.run_steps(2);
    assert_eq!(ui.state().document.undoable(), None, "no undo step remains");
}

#[test]
fn an_axis_key_keeps_the_drag_on_the_axis() {
    let mut ui = open("report");
    let (start, from) = (world(&ui), ui.get_by_label(POINT).rect().center());
    ui.key_down(Key::Y);
    drag(&mut ui, from, vec2(10.0, -30.0), 4);
    let moved = world(&ui) - start;
    assert!(moved.y > 0.0, "up, as the pointer: {moved}");
    // The rounding error of numbers of size 1.
    assert!(moved.x.abs() + moved.z.abs() < 1e-12, "along the axis only: {moved}");
}

#[test]
fn a_click_on_a_handle_selects_and_shift_adds() {
    let mut ui = open("report");
    ui.get_by_label(POINT).click();
    ui.run_steps(2);
    ui.get_by_label("Control point P[2][2]").click_modifiers(Modifiers::SHIFT);
    ui.run_steps(2);
    let points: Vec<_> = ui.state().document.selection.points.iter().map(|point| (point.i, point.j)).collect();
    assert_eq!(points, [(1, 2), (2, 2)]);

    let start = world(&ui);
    let from = ui.get_by_label("Control point P[2][2]").rect().center();
    drag(&mut ui, from, vec2(20.0, 0.0), 2);
    ui.drop_at(from + vec2(20.0, 0.0));
    ui.run_steps(2);
    assert_ne!(world(&ui), start, "the selected points move together");
}

#[test]
fn welded_control_points_move_together() {
    let mut ui = open("teapot");
    let mut before = Vec::new();
    let Item::Object(object) = ui.state().document.selection.item else { panic!("the teapot is selected") };
    // A corner of the first patch, which its neighbours share.
    let corner = Handle::Point { object, point: PointIndex::default() };
    let start = corner.position(scene(&ui)).unwrap();
    for handle in point_handles(&ui) {
        before.push((handle, handle.position(scene(&ui)).unwrap()));
    }
    let label = before.iter().find(|(handle, at)| matches!(handle, Handle::Point { .. }) && *at == start).unwrap().0;
    let from = ui.get_by_label(&label.label(scene(&ui))).rect().center();
    drag(&mut ui, from, vec2(15.0, -15.0), 2);
    ui.drop_at(from + vec2(15.0, -15.0));
    ui.run_steps(2);
    let after = point_handles(&ui);
    assert_eq!(after.len(), before.len(), "welded points stay together");
}

#[test]
fn a_click_in_the_picture_selects_the_nearest_object() {
    let mut ui = open("report");
    let ball = scene(&ui).objects.iter().position(|object| object.name == "mirror ball").unwrap();
    let center = Handle::Object(ball).position(scene(&ui)).unwrap();
    let projection = Projection::new(&scene(&ui).camera, &scene(&ui).film).unwrap();
    let at = ui.state().canvas.transform.unwrap().to_screen(projection.project(center).unwrap());
    ui.hover_at(at);
    ui.run_steps(1);
    ui.drag_at(at);
    ui.run_steps(1);
    ui.drop_at(at);
    ui.run_steps(2);
    assert_eq!(ui.state().document.selection.item, Item::Object(ball));
}

#[test]
fn the_wheel_zooms_to_the_pointer_and_f_fits() {
    let mut ui = open("cornell");
    let before = ui.state().canvas.transform.unwrap();
    let cursor = before.picture().center() + vec2(60.0, -35.0);
    let film = before.to_film(cursor);
    ui.hover_at(cursor);
    ui.run_steps(1);
    turn_wheel(&mut ui, 3.0);
    let after = ui.state().canvas.transform.unwrap();
    assert!(after.scale > 1.2 * before.scale, "{} is not larger than {}", after.scale, before.scale);
    // f32 coordinates of size 1000, over some twenty frames of smooth scrolling.
    assert!(after.to_screen(film).distance(cursor) < 0.1, "the pixel stays under the pointer");
    ui.key_press(Key::F);
    ui.run_steps(2);
    assert_eq!(ui.state().canvas.view, View::Fit);
}

#[test]
fn dragging_the_picture_pans() {
    let mut ui = open("cornell");
    let before = scene(&ui).clone();
    let transform = ui.state().canvas.transform.unwrap();
    let from = transform.picture().left_bottom() + vec2(20.0, -20.0);
    drag(&mut ui, from, vec2(30.0, 40.0), 5);
    ui.drop_at(from + vec2(30.0, 40.0));
    ui.run_steps(2);
    let moved = ui.state().canvas.transform.unwrap().picture().min - transform.picture().min;
    assert!((moved - vec2(30.0, 40.0)).length() < 0.1, "the picture follows: {moved:?}");
    assert_eq!(*scene(&ui), before, "the scene does not change");
}

#[test]
fn a_light_is_dragged() {
    let mut ui = open("report");
    let light = Handle::Light(0);
    let start = light.position(scene(&ui)).unwrap();
    let from = ui.get_by_label(&light.label(scene(&ui))).rect().center();
    drag(&mut ui, from, vec2(-30.0, 0.0), 3);
    ui.drop_at(from + vec2(-30.0, 0.0));
    ui.run_steps(2);
    assert_ne!(light.position(scene(&ui)).unwrap(), start);
    assert_eq!(ui.state().document.selection.item, Item::Light(0), "the dragged light is selected");
}

#[test]
fn widgets_under_a_dialog_do_not_react() {
    let mut ui = open("report");
    let (before, at) = (scene(&ui).clone(), ui.get_by_label(POINT).rect().center());
    let labelled = |ui: &Ui| ui.query_all_by_label(POINT).count();
    let alone = labelled(&ui);
    ui.hover_at(at);
    for _ in 0..30 {
        ui.step();
    }
    assert!(labelled(&ui) > alone, "the tooltip is shown");
    ui.key_press(Key::F1);
    ui.run_steps(3);
    assert!(ui.state().dialog.is_some(), "F1 opens the help");
    assert_eq!(labelled(&ui), alone, "the tooltip is gone");
    drag(&mut ui, at, vec2(30.0, 20.0), 4);
    ui.drop_at(at + vec2(30.0, 20.0));
    ui.run_steps(2);
    assert_eq!(*scene(&ui), before, "the handle does not move");
}

#[test]
fn a_drag_does_not_resize_the_panels() {
    let mut ui = open("report");
    let from = ui.get_by_label(POINT).rect().center();
    let width = |ui: &Ui| ui.state().canvas.transform.unwrap().canvas.width();
    let fields = |ui: &Ui| ui.query_all_by_role(Role::SpinButton).map(|field| field.rect().width()).fold(0.0, f32::max);
    let before = (width(&ui), fields(&ui));
    for step in 1..=20 {
        drag(&mut ui, from, vec2(-7.3, 5.9) * step as f32, 1);
        assert_eq!((width(&ui), fields(&ui)), before, "at {}", world(&ui));
        ui.drop_at(from + vec2(-7.3, 5.9) * step as f32);
        ui.run_steps(2);
        ui.state_mut().document.undo();
        ui.run_steps(2);
    }
}

#[test]
fn a_change_of_the_selection_does_not_resize_the_panels() {
    let mut ui = open("report");
    let sheet = ui.state().document.selection.clone();
    let width = |ui: &Ui| ui.state().canvas.transform.unwrap().canvas.width();
    let before = width(&ui);
    for round in 0..20 {
        for selection in [Selection::of(Item::Light(0)), sheet.clone(), Selection::of(Item::Camera)] {
            ui.state_mut().document.selection = selection;
            ui.run_steps(3);
            assert_eq!(width(&ui), before, "in round {round}");
        }
    }
}

#[test]
fn the_coordinates_of_a_selected_control_point_are_scrolled_into_view() {
    let mut ui = open("report");
    ui.set_size(egui::vec2(1280.0, 560.0));
    ui.run_steps(4);
    ui.get_by_label("Control point P[3][3]").click();
    ui.run_steps(60);
    let row = ui.get_by_role_and_label(Role::SpinButton, "Position x").rect();
    assert!(row.max.y < 540.0, "{row}");
}
