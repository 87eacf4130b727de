use super::navigation::{begin_orbit, camera, drag, on_screen};
use super::*;
use crate::app::canvas::Projection;
use crate::app::commands::{AppCommand, Next};
use crate::app::document::{Handle, PointIndex};
use egui::{PointerButton, vec2};

const POINT: &str = "Control point P[1][2]";

#[test]
fn looking_around_keeps_the_document() {
    let mut ui = open("report");
    let (before, own) = (scene(&ui).clone(), camera(&ui));
    ui.key_press(Key::L);
    ui.run_steps(3);
    sent_scenes(&mut ui);
    let at = on_screen(&ui, own.target);
    drag(&mut ui, PointerButton::Primary, Modifiers::ALT, at, vec2(80.0, 30.0));
    let looked = camera(&ui);
    assert_ne!(looked, own);
    assert_eq!(*scene(&ui), before);
    assert!(!ui.state().document.is_dirty() && ui.state().document.undoable().is_none(), "no edit");
    assert_eq!(sent_scenes(&mut ui).last().unwrap().scene.camera, looked, "the picture shows the view");
    let handle = ui.get_by_label(POINT).rect().center();
    let object = ui.state().document.selection.item;
    let Item::Object(object) = object else { panic!("the sheet is selected") };
    let point = PointIndex { patch: 0, i: 1, j: 2 };
    let world = Handle::Point { object, point }.position(scene(&ui)).unwrap();
    assert!(on_screen(&ui, world).distance(handle) < 1.0, "handles follow the view");

    click(&mut ui, "Back to the scene's camera");
    assert_eq!(camera(&ui), own);
    assert_eq!(sent_scenes(&mut ui).last().unwrap().scene.camera, own);
    assert!(ui.query_by_label_contains("Looking around").is_none());
    ui.key_press(Key::L);
    ui.run_steps(3);
    ui.key_press(Key::Num3);
    ui.run_steps(3);
    let side = camera(&ui);
    click(&mut ui, "Use as camera");
    assert_eq!(scene(&ui).camera, side, "the view is the scene's camera");
    press(&mut ui, Key::Z);
    assert_eq!(*scene(&ui), before, "one undo step");
}

#[test]
fn saving_while_looking_around_saves_the_documents_camera_and_restarts_nothing() {
    let mut ui = open("cornell");
    let (folder, own) = (folder(), camera(&ui));
    edit(&mut ui);
    ui.key_press(Key::L);
    ui.key_press(Key::Num3);
    ui.run_steps(3);
    sent_scenes(&mut ui);
    let path = folder.path().join("looked.toml");
    answer_dialogs(&mut ui, Some(path.clone()));
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the file", |ui| !ui.state().document.is_dirty());
    assert_eq!(SceneFile::open(&path).unwrap().scene.camera, own);
    assert_ne!(camera(&ui), own, "the view stays");
    assert!(sent_scenes(&mut ui).is_empty(), "the picture stays");
}

#[test]
fn escape_reverts_a_look() {
    let mut ui = open("report");
    ui.key_press(Key::L);
    ui.run_steps(3);
    let (own, at) = (camera(&ui), on_screen(&ui, camera(&ui).target));
    begin_orbit(&mut ui, at);
    assert_ne!(camera(&ui), own);
    ui.key_press(Key::Escape);
    ui.run_steps(2);
    assert_eq!(camera(&ui), own);
}

#[test]
fn another_scene_ends_looking_around() {
    let mut ui = open("report");
    ui.key_press(Key::L);
    ui.key_press(Key::Num3);
    ui.run_steps(3);
    let example = AppCommand::Leave(Next::Example("cornell"));
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, example);
    ui.run_steps(4);
    assert_eq!(camera(&ui), SceneFile::built_in("cornell").unwrap().scene.camera);
    ui.key_press_modifiers(Modifiers::ALT, Key::ArrowLeft);
    ui.run_steps(2);
    assert!(!ui.state().document.is_dirty(), "views of the last scene are gone");
}

#[test]
fn a_new_item_lies_in_the_view() {
    let mut ui = open("report");
    ui.key_press(Key::L);
    ui.key_press(Key::Period);
    ui.run_steps(3);
    let target = camera(&ui).target;
    ui.get_by_role_and_label(Role::Button, "Add to Lights").click();
    ui.run_steps(3);
    ui.get_by_role_and_label(Role::Button, "sphere light").click();
    ui.run_steps(3);
    let added = Handle::Light(scene(&ui).lights.len() - 1).position(scene(&ui)).unwrap();
    let projection = Projection::new(&camera(&ui), &ui.state().viewpoint.seen().scene.film).unwrap();
    let (at, film) = (projection.project(added).unwrap(), ui.state().viewpoint.seen().scene.film);
    let inside = at.cmpgt(glam::DVec2::ZERO).all() && at.x < f64::from(film.width) && at.y < f64::from(film.height);
    assert!(inside, "{added} is at {at} of the picture of {target}");
}

#[test]
fn the_picture_matches_the_window_once_its_size_rests() {
    let mut ui = open("report");
    ui.set_pixels_per_point(1.5);
    ui.run_steps(4);
    let before = scene(&ui).clone();
    let canvas = |ui: &Ui| (ui.state().canvas.transform.unwrap().canvas.size() * 1.5).floor();
    let film = |ui: &Ui| {
        let film = ui.state().viewpoint.seen().scene.film;
        vec2(film.width as f32, film.height as f32)
    };
    ui.key_press(Key::W);
    ui.run_steps(2);
    assert_eq!(film(&ui), canvas(&ui));
    let transform = ui.state().canvas.transform.unwrap();
    assert!((transform.scale * 1.5 - 1.0).abs() < 1e-6, "one pixel on one pixel: {}", transform.scale);
    let narrow = film(&ui);
    ui.key_press_modifiers(Modifiers::COMMAND, Key::B);
    ui.run_steps(1);
    assert_eq!(film(&ui), narrow, "the size must rest first");
    ui.run_steps(4);
    assert_eq!(film(&ui), canvas(&ui));
    assert!(film(&ui).x > narrow.x + 300.0);
    assert_eq!(*scene(&ui), before, "the document keeps its size");
    ui.key_press(Key::W);
    ui.run_steps(2);
    assert_eq!(film(&ui), vec2(before.film.width as f32, before.film.height as f32));
}
