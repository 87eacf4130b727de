use super::*;
use crate::app::document::{Item, PointIndex, Welds};
use crate::math::Rgb;
use crate::scene::{Emitter, Shape};

fn strength(ui: &Ui) -> Rgb {
    let Emitter::Point { intensity, .. } = scene(ui).lights[0].emitter else { panic!("a point light") };
    intensity
}

#[test]
fn a_typed_coordinate_keeps_a_seam_closed() {
    let mut ui = open("cardioid");
    let seams = |ui: &Ui| {
        let bezier = ui.state().document.selection.bezier(scene(ui));
        Welds::of(bezier.expect("a Bezier object is selected")).groups().len()
    };
    let before = seams(&ui);
    click(&mut ui, "P[3][3]");
    type_number(&mut ui, "Position y", "0.123");
    assert_eq!(seams(&ui), before, "the points that share a position still share one");
    let Shape::Bezier(bezier) = &ui.state().document.selection.object(scene(&ui)).unwrap().shape else { panic!() };
    let point = PointIndex { patch: 0, i: 3, j: 3 };
    assert!(Welds::of(bezier).with(point).count() > 1, "the point lies on a seam");
    assert_eq!(bezier.patches[0].points[3][3].y, 0.123, "the typed number");
}

#[test]
fn a_number_field_takes_arithmetic_and_decimal_commas_and_no_nan() {
    let mut ui = open("report");
    let ball = first_object(&ui, |shape| matches!(shape, Shape::Sphere { .. }));
    select(&mut ui, Item::Object(ball));
    for (text, expected) in [("0,25", 0.25), ("0.05+0.1", 0.05 + 0.1), ("nan", 0.05 + 0.1), ("1/0", 0.05 + 0.1)] {
        type_number(&mut ui, "Radius", text);
        let Shape::Sphere { radius, .. } = scene(&ui).objects[ball].shape else { panic!("a sphere") };
        assert_eq!(radius, expected, "after {text}");
    }
}

#[test]
fn a_number_field_takes_relative_numbers_once() {
    let mut ui = open("report");
    let ball = first_object(&ui, |shape| matches!(shape, Shape::Sphere { .. }));
    select(&mut ui, Item::Object(ball));
    let steps = [("2", 2.0), ("+0.5", 2.5), ("*2", 5.0), ("-=1", 4.0), ("/4", 1.0), ("-=0.25", 0.75), ("+=0,25", 1.0)];
    for (text, expected) in steps {
        type_number(&mut ui, "Radius", text);
        ui.run_steps(3);
        let Shape::Sphere { radius, .. } = scene(&ui).objects[ball].shape else { panic!("a sphere") };
        assert_eq!(radius, expected, "after {text}");
    }
    type_number(&mut ui, "Centre x", "-3");
    let Shape::Sphere { center, .. } = scene(&ui).objects[ball].shape else { panic!("a sphere") };
    assert_eq!(center.x, -3.0, "a sign sets the number");
}

#[test]
fn a_refused_text_gets_one_message() {
    for (text, messages) in [("abc", 1), ("1/0", 1), ("+", 1), ("0.25", 0), ("+0.1", 0)] {
        let mut ui = open("report");
        let ball = first_object(&ui, |shape| matches!(shape, Shape::Sphere { .. }));
        select(&mut ui, Item::Object(ball));
        let before = scene(&ui).clone();
        type_number(&mut ui, "Radius", text);
        ui.run_steps(3);
        assert_eq!(*scene(&ui) == before, messages == 1, "{text}");
        assert_eq!(ui.state().toasts.len(), messages, "messages after {text}");
    }
}

#[test]
fn a_field_takes_no_number_that_the_scene_cannot_hold() {
    let mut ui = open("report");
    let ball = first_object(&ui, |shape| matches!(shape, Shape::Sphere { .. }));
    select(&mut ui, Item::Object(ball));
    for (field, text) in [("Radius", "-1"), ("Radius", "1e300"), ("Centre x", "-1e12")] {
        type_number(&mut ui, field, text);
        assert!(ui.state().rendering.problems().is_empty(), "{field} {text}: {:?}", ui.state().rendering.problems());
    }
    select(&mut ui, Item::Light(0));
    type_number(&mut ui, "Intensity", "1e30");
    assert!(ui.state().rendering.problems().is_empty(), "{:?}", ui.state().rendering.problems());
}

#[test]
fn a_rounded_number_keeps_all_its_digits() {
    let mut ui = open("report");
    let ball = first_object(&ui, |shape| matches!(shape, Shape::Sphere { .. }));
    select(&mut ui, Item::Object(ball));
    type_number(&mut ui, "Radius", "0.123456789012");
    let field = |ui: &Ui| ui.get_by_role_and_label(Role::SpinButton, "Radius").value();
    assert_eq!(field(&ui).as_deref(), Some("0.1235"), "rounded");
    ui.get_by_role_and_label(Role::SpinButton, "Radius").click();
    ui.run_steps(2);
    ui.key_press(Key::Enter);
    ui.run_steps(2);
    let Shape::Sphere { radius, .. } = scene(&ui).objects[ball].shape else { panic!("a sphere") };
    assert_eq!(radius, 0.123_456_789_012, "Enter without typing keeps all digits");
}

#[test]
fn a_name_that_is_taken_becomes_a_free_name_and_restarts_nothing() {
    let mut ui = open("cornell");
    select(&mut ui, Item::Material(0));
    let (before, taken) = (scene(&ui).clone(), scene(&ui).materials[1].name.clone());
    sent_scenes(&mut ui);
    ui.get_by_role_and_label(Role::TextInput, "Name").click();
    ui.run_steps(2);
    ui.key_press_modifiers(Modifiers::COMMAND, Key::A);
    focused(&ui).type_text(&taken);
    ui.key_press(Key::Enter);
    ui.run_steps(3);
    assert_eq!(scene(&ui).materials[0].name, format!("{taken} 2"));
    let users = |scene: &Scene, name: &str| scene.objects.iter().filter(|object| object.material == name).count();
    assert_eq!(users(scene(&ui), &taken), users(&before, &taken), "no object changes its material");
    assert!(ui.state().rendering.problems().is_empty(), "the scene stays valid");
    assert!(sent_scenes(&mut ui).is_empty(), "the picture goes on");
    assert_eq!(ui.state().toasts.len(), 1, "the message");
}

#[test]
fn a_name_takes_effect_on_enter() {
    let mut ui = open("cornell");
    select(&mut ui, Item::Material(0));
    let before = scene(&ui).materials[0].name.clone();
    let user = scene(&ui).objects.iter().position(|object| object.material == before).unwrap();
    ui.get_by_role_and_label(Role::TextInput, "Name").click();
    ui.run_steps(2);
    ui.key_press_modifiers(Modifiers::COMMAND, Key::A);
    focused(&ui).type_text("chalk");
    ui.run_steps(2);
    assert_eq!(scene(&ui).materials[0].name, before, "not while typing");
    ui.key_press(Key::Enter);
    ui.run_steps(2);
    assert_eq!((scene(&ui).materials[0].name.as_str(), scene(&ui).objects[user].material.as_str()), ("chalk", "chalk"));
}

#[test]
fn a_light_of_strength_0_keeps_its_colour() {
    let mut ui = open("report");
    select(&mut ui, Item::Light(0));
    type_number(&mut ui, "Colour red", "0.25");
    let before = strength(&ui);
    type_number(&mut ui, "Intensity", "0");
    assert_eq!(strength(&ui), Rgb::ZERO);
    select(&mut ui, Item::Camera);
    select(&mut ui, Item::Light(0));
    type_number(&mut ui, "Intensity", &before.max_element().to_string());
    // One multiplication and one division in f32.
    assert!((strength(&ui) - before).length() < 1e-5, "{} is not {before}", strength(&ui));
}
