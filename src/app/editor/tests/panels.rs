use super::*;
use crate::app::document::{Item, PointIndex, Selection, handles};
use crate::scene::{Color, Emitter, MaterialModel, Shape, built_in_scenes};

fn select(ui: &mut Ui, item: Item) {
    ui.state_mut().document.selection = Selection::of(item);
    ui.run_steps(2);
}

fn first_object(ui: &Ui, kind: impl Fn(&Shape) -> bool) -> usize {
    scene(ui).objects.iter().position(|object| kind(&object.shape)).unwrap()
}

#[test]
fn a_typed_number_changes_the_scene_and_undo_reverts_it() {
    let mut ui = open("report");
    let before = scene(&ui).clone();
    let ball = first_object(&ui, |shape| matches!(shape, Shape::Sphere { .. }));
    select(&mut ui, Item::Object(ball));
    sent_scenes(&mut ui);
    type_number(&mut ui, "Radius", "0.125");
    assert!(matches!(scene(&ui).objects[ball].shape, Shape::Sphere { radius: 0.125, .. }), "the scene has the number");
    assert_eq!(sent_scenes(&mut ui).len(), 1, "one scene is rendered for one number");
    ui.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    ui.run_steps(2);
    assert_eq!(*scene(&ui), before, "the scene before the edit");
    assert_eq!(sent_scenes(&mut ui).len(), 1, "undo is rendered");
}

#[test]
fn a_control_point_is_edited_as_numbers() {
    let mut ui = open("report");
    let sheet = first_object(&ui, |shape| matches!(shape, Shape::Bezier(_)));
    select(&mut ui, Item::Object(sheet));
    type_number(&mut ui, "P[1][2] y", "-0.25");
    let Shape::Bezier(bezier) = &scene(&ui).objects[sheet].shape else { panic!("a Bezier object") };
    assert_eq!(bezier.patches[0].points[1][2].y, -0.25);
    assert_eq!(bezier.file, None, "a .bpt file would hold other points");
}

#[test]
fn every_patch_of_an_object_can_be_reached() {
    let mut ui = open("teapot");
    let teapot = first_object(&ui, |shape| matches!(shape, Shape::Bezier(_)));
    select(&mut ui, Item::Object(teapot));
    type_number(&mut ui, "Patch", "31");
    assert_eq!(ui.state().document.selection.patch, 31);
    type_number(&mut ui, "P[0][0] x", "0.5");
    let Shape::Bezier(bezier) = &scene(&ui).objects[teapot].shape else { panic!("a Bezier object") };
    assert_eq!(bezier.patches[31].points[0][0].x, 0.5);
}

#[test]
fn exposure_does_not_restart_rendering_and_can_be_undone() {
    let mut ui = open("cornell");
    sent_scenes(&mut ui);
    let before = scene(&ui).film.exposure;
    ui.get_by_role_and_label(Role::SpinButton, "Exposure").click();
    ui.run_steps(2);
    ui.key_press_modifiers(Modifiers::COMMAND, Key::A);
    ui.run_steps(1);
    focused(&ui).type_text("2");
    ui.key_press(Key::Enter);
    ui.run_steps(2);
    assert_eq!(scene(&ui).film.exposure, 2.0);
    assert_eq!(ui.state().document.undoable(), Some("edit picture settings"));
    assert!(sent_scenes(&mut ui).is_empty(), "the radiance is the same");
    ui.state_mut().document.undo();
    assert_eq!(scene(&ui).film.exposure, before);
}

#[test]
fn a_light_keeps_its_hue_when_its_strength_changes() {
    let mut ui = open("report");
    let lamp = scene(&ui).lights.iter().position(|light| matches!(light.emitter, Emitter::Point { .. })).unwrap();
    let strength = |ui: &Ui| match scene(ui).lights[lamp].emitter {
        Emitter::Point { intensity, .. } => intensity,
        _ => panic!("a point light"),
    };
    let before = strength(&ui);
    select(&mut ui, Item::Light(lamp));
    type_number(&mut ui, "Intensity", "4");
    let expected = before * (4.0 / before.max_element());
    // One multiplication and one division in f32.
    assert!((strength(&ui) - expected).length() < 1e-5, "{} is not {expected}", strength(&ui));
}

#[test]
fn the_kind_of_a_material_is_chosen_from_a_list() {
    let mut ui = open("cornell");
    select(&mut ui, Item::Material(0));
    ui.get_by_role_and_label(Role::ComboBox, "Type").click();
    ui.run_steps(3);
    ui.get_by_role_and_label(Role::Button, "glass").click();
    ui.run_steps(3);
    assert!(matches!(scene(&ui).materials[0].model, MaterialModel::Glass { .. }), "{:?}", scene(&ui).materials[0]);
    type_number(&mut ui, "IOR", "1.33");
    assert!(
        matches!(scene(&ui).materials[0].model, MaterialModel::Glass { ior: 1.33, .. }),
        "the fields of glass edit the material"
    );
}

#[test]
fn an_invalid_scene_is_reported_and_not_rendered() {
    let mut ui = open("report");
    let floor = first_object(&ui, |shape| matches!(shape, Shape::Quad { .. }));
    select(&mut ui, Item::Object(floor));
    sent_scenes(&mut ui);
    for axis in ["x", "y", "z"] {
        type_number(&mut ui, &format!("Edge u {axis}"), "0");
    }
    assert!(ui.query_by_label_contains("cannot be rendered").is_some(), "the notice");
    assert!(ui.query_by_label_contains("edge_u").is_some(), "the problem");
    let valid = sent_scenes(&mut ui).len();
    type_number(&mut ui, "Edge u x", "1.5");
    assert!(ui.query_by_label_contains("cannot be rendered").is_none(), "the notice is gone");
    assert_eq!(sent_scenes(&mut ui).len(), 1, "the valid scene is rendered, after {valid} valid scenes before");
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
fn objects_are_added_copied_and_deleted() {
    let mut ui = open("cornell");
    let count = scene(&ui).objects.len();
    ui.state_mut().document.selection = Selection::of(Item::Object(0));
    ui.run_steps(1);
    ui.key_press_modifiers(Modifiers::COMMAND, Key::D);
    ui.run_steps(2);
    assert_eq!(scene(&ui).objects.len(), count + 1);
    assert_eq!(ui.state().document.selection.item, Item::Object(count), "the copy is selected");
    ui.key_press(Key::Delete);
    ui.run_steps(2);
    assert_eq!(scene(&ui).objects.len(), count);
}

#[test]
fn a_material_in_use_cannot_be_deleted() {
    let mut ui = open("cornell");
    select(&mut ui, Item::Material(0));
    let before = scene(&ui).clone();
    ui.key_press(Key::Delete);
    ui.run_steps(2);
    assert_eq!(*scene(&ui), before);
}

#[test]
fn every_item_of_every_scene_has_its_panel_with_named_fields() {
    for example in built_in_scenes() {
        let mut ui = open(example.name);
        let scene = scene(&ui).clone();
        let objects = (0..scene.objects.len()).map(Item::Object);
        let lights = (0..scene.lights.len()).map(Item::Light);
        let materials = (0..scene.materials.len()).map(Item::Material);
        let settings = [Item::Camera, Item::Settings].into_iter();
        for item in settings.chain(objects).chain(lights).chain(materials) {
            select(&mut ui, item);
            ui.check_accessibility();
            assert_eq!(ui.state().document.scene(), &scene, "showing {item:?} of {} changes nothing", example.name);
        }
    }
}

#[test]
fn a_texture_can_replace_a_colour() {
    let mut ui = open("report");
    let is_plain = |model: &MaterialModel| matches!(model, MaterialModel::Diffuse { albedo: Color::Constant(_) });
    let plain = scene(&ui).materials.iter().position(|material| is_plain(&material.model)).unwrap();
    select(&mut ui, Item::Material(plain));
    ui.get_by_label("Albedo from a texture").click();
    ui.run_steps(2);
    let model = &scene(&ui).materials[plain].model;
    assert!(matches!(model, MaterialModel::Diffuse { albedo: Color::Texture(_) }), "{model:?}");
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
fn all_sections_of_the_outline_are_visible() {
    let ui = open("report");
    for part in ["Objects (8)", "Lights (1)", "Materials (8)", "Textures (6)"] {
        let header = ui.get_by_label(part).rect();
        let properties = ui.get_by_label_contains("Object: bezier").rect();
        assert!(header.max.y < properties.min.y, "{part} is not visible: {header} {properties}");
    }
}

#[test]
fn a_texture_in_use_cannot_be_deleted() {
    let mut ui = open("report");
    ui.get_by_label("Textures (6)").click();
    ui.run_steps(20);
    select(&mut ui, Item::Texture(0));
    assert!(ui.query_by_role_and_label(Role::TextInput, "File").is_some(), "its file");
    let before = scene(&ui).clone();
    ui.key_press(Key::Delete);
    ui.run_steps(2);
    assert_eq!(*scene(&ui), before, "a material uses the texture");
}

#[test]
fn a_typed_coordinate_keeps_a_seam_closed() {
    let mut ui = open("cardioid");
    let seams = |ui: &Ui| {
        let Item::Object(object) = ui.state().document.selection.item else { panic!("a Bezier object is selected") };
        handles::visible(scene(ui), Item::Object(object)).len()
    };
    let before = seams(&ui);
    // All 16 rows are visible.
    ui.set_size(egui::vec2(1280.0, 1400.0));
    ui.run_steps(3);
    type_number(&mut ui, "P[3][3] y", "0.123");
    assert_eq!(seams(&ui), before, "the points that share a position still share one");
    let Shape::Bezier(bezier) = &ui.state().document.selection.object(scene(&ui)).unwrap().shape else { panic!() };
    let point = PointIndex { patch: 0, i: 3, j: 3 };
    assert!(handles::welded(bezier, point).len() > 1, "the point lies on a seam");
    assert_eq!(bezier.patches[0].points[3][3].y, 0.123, "the typed number");
}

#[test]
fn delete_removes_no_object_for_a_selected_control_point_and_no_second_item() {
    let mut ui = open("report");
    let before = scene(&ui).clone();
    ui.get_by_label("Control point P[1][2]").click();
    ui.run_steps(2);
    ui.key_press(Key::Delete);
    ui.run_steps(2);
    assert_eq!(*scene(&ui), before, "a control point stays");
    assert_eq!(ui.state().toasts.len(), 1, "the reason");
    select(&mut ui, Item::Object(0));
    for _ in 0..3 {
        ui.key_press(Key::Delete);
        ui.run_steps(2);
    }
    assert_eq!(scene(&ui).objects, before.objects[1..], "only the selected object is deleted");
    assert_eq!(ui.state().document.selection.item, Item::Camera);
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
fn the_status_of_an_invalid_scene_is_not_rendering() {
    let mut ui = open("report");
    ui.state_mut().rendering.receive(None, Status::Rendering);
    ui.run_steps(2);
    assert!(ui.query_by_label("Rendering").is_some(), "a valid scene");
    type_number(&mut ui, "Scale x", "0");
    assert!(ui.query_by_label("Rendering").is_none() && ui.query_by_label("Waiting for a valid scene").is_some());
}

#[test]
fn a_scene_without_light_says_so() {
    let mut ui = open("report");
    select(&mut ui, Item::Light(0));
    assert!(ui.query_by_label_contains("no light").is_none(), "the lamp shines");
    type_number(&mut ui, "Intensity", "0");
    assert!(ui.query_by_label_contains("no light").is_some(), "the lamp is off");
    ui.key_press(Key::Delete);
    ui.run_steps(2);
    assert!(scene(&ui).lights.is_empty() && ui.query_by_label_contains("no light").is_some(), "no lamp");
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
