use super::*;
use crate::app::canvas::{Projection, View};
use crate::app::document::{Edit, Handle};
use crate::scene::Camera;
use egui::{Event, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, TouchPhase, Vec2, vec2};
use glam::DVec3;

const POINT: &str = "Control point P[1][2]";

/// Moves the pointer with a button and keys held, and releases both.
pub(super) fn drag(ui: &mut Ui, button: PointerButton, modifiers: Modifiers, from: Pos2, way: Vec2) {
    let event = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers };
    ui.event(Event::ModifiersChanged(modifiers));
    ui.hover_at(from);
    ui.run_steps(2);
    ui.event(event(from, true));
    ui.run_steps(1);
    for step in 1..=4 {
        ui.hover_at(from + way * step as f32 / 4.0);
        ui.run_steps(1);
    }
    ui.event(event(from + way, false));
    ui.run_steps(2);
    ui.event(Event::ModifiersChanged(Modifiers::NONE));
    ui.run_steps(1);
}

/// Begins an orbit from `at` by 40 points to the right; the button and Alt stay down.
pub(super) fn begin_orbit(ui: &mut Ui, at: Pos2) {
    ui.event(Event::ModifiersChanged(Modifiers::ALT));
    ui.hover_at(at);
    ui.run_steps(2);
    ui.drag_at(at);
    ui.run_steps(1);
    ui.hover_at(at + vec2(40.0, 0.0));
    ui.run_steps(2);
}

fn turn_wheel(ui: &mut Ui, modifiers: Modifiers, lines: f32) {
    ui.event(Event::ModifiersChanged(modifiers));
    ui.event(Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: vec2(0.0, lines),
        phase: TouchPhase::Move,
        source: MouseWheelSource::Unknown,
        modifiers,
    });
    ui.event(Event::ModifiersChanged(Modifiers::NONE));
    // A frame of a test takes a quarter of a second.
    ui.run_steps(1);
}

pub(super) fn camera(ui: &Ui) -> Camera {
    ui.state().seen_camera()
}

/// The screen point of a point in world space.
pub(super) fn on_screen(ui: &Ui, world: DVec3) -> Pos2 {
    let projection = Projection::new(&camera(ui), &ui.state().viewpoint.seen().scene.film).unwrap();
    ui.state().canvas.transform.unwrap().to_screen(projection.project(world).unwrap())
}

/// Selects the mirror ball. Returns its centre.
fn select_ball(ui: &mut Ui) -> DVec3 {
    let ball = scene(ui).objects.iter().position(|object| object.name == "mirror ball").unwrap();
    select(ui, Item::Object(ball));
    Handle::Object(ball).position(scene(ui)).unwrap()
}

#[test]
fn an_alt_drag_orbits_around_the_selection_in_one_undo_step() {
    let mut ui = open("report");
    let center = select_ball(&mut ui);
    let (before, start, at) = (scene(&ui).clone(), camera(&ui), on_screen(&ui, center));
    sent_scenes(&mut ui);
    // On the handle of the ball, which stays.
    drag(&mut ui, PointerButton::Primary, Modifiers::ALT, at, vec2(80.0, 40.0));
    let turned = camera(&ui);
    assert!(turned.position.distance(start.position) > 0.1, "{turned:?}");
    assert!(turned.position.y > start.position.y, "downwards raises the camera");
    assert!((turned.position.distance(center) - start.position.distance(center)).abs() < 1e-12, "at its distance");
    assert!(on_screen(&ui, center).distance(at) < 1e-2, "the ball stays in place");
    assert_eq!(Handle::Object(0).position(scene(&ui)), Handle::Object(0).position(&before), "no object moves");
    assert!(sent_scenes(&mut ui).len() >= 4, "each move is rendered");
    press(&mut ui, Key::Z);
    assert_eq!(*scene(&ui), before, "one undo step reverts the orbit");
}

#[test]
fn an_alt_drag_on_a_control_point_does_not_move_it() {
    let mut ui = open("report");
    let objects = scene(&ui).objects.clone();
    let at = ui.get_by_label(POINT).rect().center();
    drag(&mut ui, PointerButton::Primary, Modifiers::ALT, at, vec2(30.0, 0.0));
    assert_eq!(scene(&ui).objects, objects);
    assert_eq!(ui.state().document.undoable(), Some("orbit view"));
}

#[test]
fn a_pan_keeps_the_grabbed_point_under_the_pointer() {
    for (button, modifiers) in
        [(PointerButton::Middle, Modifiers::ALT), (PointerButton::Primary, Modifiers::ALT | Modifiers::SHIFT)]
    {
        let mut ui = open("report");
        let ball = scene(&ui).objects.iter().position(|object| object.name == "mirror ball").unwrap();
        let center = Handle::Object(ball).position(scene(&ui)).unwrap();
        let (start, at) = (camera(&ui), on_screen(&ui, center));
        drag(&mut ui, button, modifiers, at, vec2(60.0, -20.0));
        // The grabbed point is the surface before the centre, which moves a little farther than the centre.
        let off = on_screen(&ui, center) - at - vec2(60.0, -20.0);
        assert!(off.length() < 15.0, "{off:?} with {button:?}");
        let direction = |camera: Camera| camera.target - camera.position;
        assert!(direction(camera(&ui)).distance(direction(start)) < 1e-12, "the direction stays");
        assert_eq!(ui.state().canvas.view, View::Fit, "the picture stays");
    }
}

#[test]
fn an_alt_drag_with_the_right_button_and_the_wheel_dolly_towards_the_pointer() {
    let mut ui = open("report");
    let (start, target) = (camera(&ui), camera(&ui).target);
    let at = on_screen(&ui, target);
    drag(&mut ui, PointerButton::Secondary, Modifiers::ALT, at, vec2(50.0, 0.0));
    let near = camera(&ui);
    assert!(near.position.distance(target) < 0.9 * start.position.distance(target), "{near:?}");
    ui.hover_at(at);
    ui.run_steps(4);
    turn_wheel(&mut ui, Modifiers::ALT, 2.0);
    turn_wheel(&mut ui, Modifiers::ALT, 2.0);
    ui.run_steps(8);
    let nearest = camera(&ui);
    assert!(nearest.position.distance(target) < near.position.distance(target), "{nearest:?}");
    assert_eq!(ui.state().canvas.view, View::Fit, "the picture does not zoom");
    press(&mut ui, Key::Z);
    assert_eq!(camera(&ui), near, "steps of the wheel in quick succession are one undo step");
    press(&mut ui, Key::Z);
    assert_eq!(camera(&ui), start);
}

#[test]
fn escape_reverts_an_orbit() {
    let mut ui = open("report");
    let (before, at) = (scene(&ui).clone(), on_screen(&ui, camera(&ui).target));
    begin_orbit(&mut ui, at);
    assert_ne!(*scene(&ui), before);
    ui.key_press(Key::Escape);
    ui.run_steps(2);
    ui.hover_at(at + vec2(80.0, 0.0));
    ui.run_steps(2);
    assert_eq!(*scene(&ui), before, "the button is still down");
    ui.drop_at(at);
    ui.run_steps(2);
    assert_eq!(ui.state().document.undoable(), None);
}

#[test]
fn navigation_needs_no_alt_while_it_is_on() {
    let mut ui = open("report");
    ui.key_press(Key::V);
    ui.run_steps(2);
    assert!(ui.query_by_label(POINT).is_none(), "handles do not take the pointer");
    let (start, objects) = (camera(&ui), scene(&ui).objects.clone());
    let at = ui.state().canvas.transform.unwrap().picture().center();
    drag(&mut ui, PointerButton::Primary, Modifiers::NONE, at, vec2(30.0, 10.0));
    let turned = camera(&ui);
    assert_ne!(turned.target - turned.position, start.target - start.position, "a drag orbits");
    drag(&mut ui, PointerButton::Secondary, Modifiers::NONE, at, vec2(30.0, 10.0));
    let panned = camera(&ui);
    assert!((panned.target - panned.position).distance(turned.target - turned.position) < 1e-12, "right pans");
    assert_ne!(panned, turned);
    turn_wheel(&mut ui, Modifiers::NONE, 2.0);
    assert_ne!(camera(&ui), panned, "the wheel dollies");
    assert_eq!((ui.state().canvas.view, &scene(&ui).objects), (View::Fit, &objects), "nothing else changes");
    click(&mut ui, "Navigate");
    assert!(ui.query_by_label(POINT).is_some(), "the button ends it");
}

/// The corners of the control net of the selected sheet, in the picture from (-1, -1) to (1, 1).
fn sheet_in_picture(ui: &Ui) -> Vec<Vec2> {
    let picture = ui.state().canvas.transform.unwrap().picture();
    let bezier = ui.state().document.selection.bezier(scene(ui)).unwrap();
    let points = bezier.placed_nets().into_iter().flat_map(|net| net.points.into_iter().flatten());
    points.map(|point| 2.0 * (on_screen(ui, point) - picture.center()) / picture.size()).collect()
}

#[test]
fn the_period_frames_the_selection_and_home_all_objects() {
    let mut ui = open("report");
    let start = camera(&ui);
    let largest = |ui: &Ui| sheet_in_picture(ui).into_iter().map(|at| at.abs().max_elem()).fold(0.0, f32::max);
    ui.state_mut().canvas.zoom(8.0);
    ui.run_steps(2);
    ui.key_press(Key::Period);
    ui.run_steps(2);
    assert!((largest(&ui) - 0.9).abs() < 1e-3, "the sheet fills {} of the picture", largest(&ui));
    assert_eq!(ui.state().canvas.view, View::Fit, "the whole picture is on the canvas");
    let near = camera(&ui);
    ui.key_press(Key::Home);
    ui.run_steps(2);
    assert!(largest(&ui) < 0.8, "the whole scene is larger than the sheet: {}", largest(&ui));
    press(&mut ui, Key::Z);
    assert_eq!(camera(&ui), near, "one undo step");
    press(&mut ui, Key::Z);
    assert_eq!(camera(&ui), start);
}

#[test]
fn an_empty_scene_has_nothing_to_frame() {
    let mut ui = open("report");
    for _ in 0..scene(&ui).objects.len() {
        ui.state_mut().document.edit(Edit::Remove(Item::Object(0)));
    }
    for _ in 0..scene(&ui).lights.len() {
        ui.state_mut().document.edit(Edit::Remove(Item::Light(0)));
    }
    let before = scene(&ui).clone();
    ui.key_press(Key::Home);
    ui.run_steps(2);
    assert_eq!(*scene(&ui), before);
    assert!(!ui.state().toasts.is_empty(), "a message says why");
}

#[test]
fn digits_show_the_sides_and_alt_with_arrows_goes_through_the_views() {
    let mut ui = open("report");
    let own = camera(&ui);
    let mut seen = vec![own];
    for key in [Key::Num3, Key::Num1, Key::Num7, Key::Num9] {
        ui.key_press(key);
        ui.run_steps(2);
        seen.push(camera(&ui));
    }
    let to_front = (seen[2].position - own.target).normalize();
    assert!(to_front.distance(DVec3::Z) < 1e-12, "{to_front}");
    for back in [3, 2, 1, 0, 0] {
        ui.key_press_modifiers(Modifiers::ALT, Key::ArrowLeft);
        ui.run_steps(2);
        assert_eq!(camera(&ui), seen[back]);
    }
    for forward in [1, 2] {
        ui.key_press_modifiers(Modifiers::ALT, Key::ArrowRight);
        ui.run_steps(2);
        assert_eq!(camera(&ui), seen[forward]);
    }
    ui.key_press(Key::Num0);
    ui.run_steps(2);
    assert_eq!(camera(&ui), own, "the scene's own view");
    assert!(!ui.state().document.is_dirty());
    choose_from_menu(&mut ui, &["View", "View from"]);
    for label in ["View from above", "Frame all", "Previous view"] {
        assert!(ui.query_by_label_contains(label).is_some(), "{label} is in the menu");
    }
}
