use super::*;
use crate::app::commands::AppCommand;
use crate::app::document::{Edit, Item, NewItem, Selection};
use crate::scene::{Color, Emitter, MaterialModel, Shape, built_in_scenes};
use egui_kittest::kittest::NodeT;

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
    click(&mut ui, "P[1][2]");
    type_number(&mut ui, "Position y", "-0.25");
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
    click(&mut ui, "P[0][0]");
    type_number(&mut ui, "Position x", "0.5");
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
    assert_eq!(ui.state().document.undoable(), Some("change exposure"));
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
    type_number(&mut ui, "Index of refraction", "1.33");
    assert!(
        matches!(scene(&ui).materials[0].model, MaterialModel::Glass { ior: 1.33, .. }),
        "the fields of glass edit the material"
    );
}

#[test]
fn a_preset_gives_a_material_its_parameters_in_one_undo_step() {
    let mut ui = open("cornell");
    select(&mut ui, Item::Material(0));
    let before = scene(&ui).materials[0].clone();
    choose_from_menu(&mut ui, &["Presets", "dense flint glass (SF10)"]);
    let after = &scene(&ui).materials[0];
    assert!(matches!(after.model, MaterialModel::Glass { ior: 1.7283, .. }), "{after:?}");
    assert_eq!(after.name, before.name);
    assert!(ui.query_by_label("Liquids and crystals").is_none(), "the menu is closed");
    press(&mut ui, Key::Z);
    assert_eq!(scene(&ui).materials[0], before);
}

#[test]
fn a_preset_becomes_a_new_material_of_its_name() {
    let mut ui = open("report");
    let count = scene(&ui).materials.len();
    click(&mut ui, "Add to Materials");
    ui.get_by_label_contains("presets").click();
    ui.run_steps(3);
    click(&mut ui, "fused silica");
    let added = &scene(&ui).materials[count];
    assert_eq!(added.name, "fused silica");
    assert!(matches!(added.model, MaterialModel::Glass { ior: 1.4585, .. }), "{added:?}");
    press(&mut ui, Key::Z);
    assert_eq!(scene(&ui).materials.len(), count);
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

/// The controls of the side panels that have a tooltip of their own.
fn panel_controls(ui: &Ui) -> Vec<(String, egui::Pos2)> {
    let roles = [
        Role::Button,
        Role::CheckBox,
        Role::RadioButton,
        Role::ComboBox,
        Role::SpinButton,
        Role::TextInput,
        Role::Slider,
    ];
    let canvas = ui.state().canvas.transform.unwrap().canvas;
    let bars = egui::Rect::from_x_y_ranges(canvas.x_range(), f32::NEG_INFINITY..=f32::INFINITY);
    let seen = ui.ctx.content_rect().shrink(30.0);
    let nodes = ui.query_all_by(|node| roles.contains(&node.role()));
    let found = nodes.map(|node| (node.accesskit_node().label().unwrap_or_default(), node.rect().center()));
    found.filter(|(_, at)| seen.contains(*at) && !bars.contains(*at)).collect()
}

/// Texts on the screen with the pointer at rest at a point.
fn texts_under(ui: &mut Ui, at: egui::Pos2) -> usize {
    ui.hover_at(at);
    ui.run_steps(10);
    ui.query_all_by_role(Role::Label).count()
}

#[test]
fn every_control_of_the_side_panels_has_a_tooltip() {
    let mut ui = open("report");
    receive(&mut ui, frame(0, false, 8));
    ui.set_size([1400.0, 1000.0].into());
    ui.run_steps(4);
    let lamp = Item::Light(0);
    for item in
        [ui.state().document.selection.item, lamp, Item::Material(0), Item::Camera, Item::Settings, Item::Nothing]
    {
        select(&mut ui, item);
        let alone = texts_under(&mut ui, egui::pos2(700.0, 990.0));
        let controls = panel_controls(&ui);
        assert!(controls.len() > 10, "{controls:?}");
        for (label, at) in controls {
            assert!(texts_under(&mut ui, at) > alone, "\"{label}\" at {at} has no tooltip, showing {item:?}");
        }
    }
}

#[test]
fn an_added_item_is_selected_and_is_one_undo_step() {
    let mut ui = open("report");
    let ctx = ui.ctx.clone();
    for new in NewItem::OBJECTS.into_iter().chain(NewItem::LIGHTS) {
        let before = scene(&ui).clone();
        ui.state_mut().apply(&ctx, AppCommand::Add(new));
        ui.run_steps(2);
        let added = match ui.state().document.selection.item {
            Item::Object(index) => scene(&ui).objects[index].name.clone(),
            Item::Light(index) => scene(&ui).lights[index].name.clone(),
            other => panic!("{other:?} is selected after {new:?}"),
        };
        assert!(added.starts_with(new.label()), "{added}");
        press(&mut ui, Key::Z);
        assert_eq!(*scene(&ui), before, "{new:?}");
    }
}

#[test]
fn decimals_of_lengths_do_not_follow_the_camera() {
    let mut ui = open("cornell");
    let shown = |ui: &Ui| {
        let field = ui.get_by_role_and_label(Role::SpinButton, "Corner x");
        field.accesskit_node().value().unwrap_or_default()
    };
    let near = shown(&ui);
    assert!(!near.is_empty(), "the field shows its number");
    let mut camera = scene(&ui).camera;
    camera.position = camera.target + 1e4 * (camera.position - camera.target);
    ui.state_mut().document.edit(Edit::Camera(camera));
    ui.run_steps(3);
    assert_eq!(shown(&ui), near);
}

#[test]
fn entries_with_a_check_mark_show_their_key_at_the_right() {
    let mut ui = open("cornell");
    choose_from_menu(&mut ui, &["Edit"]);
    let entry = ui.get_by_role(Role::CheckBox);
    let label = entry.accesskit_node().label().unwrap_or_default();
    assert!(label.starts_with("Show history") && !label.contains('('), "{label}");
    let above = ui.get_by_label_contains("Undo").rect();
    assert!((entry.rect().width() - above.width()).abs() < 1.0, "as wide as the entry above");
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
    assert_eq!(ui.state().document.selection.item, Item::Nothing);
    assert!(ui.query_by_label_contains("Nothing is selected").is_some());
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
fn the_picture_has_room_in_the_smallest_window() {
    let mut ui = open("report");
    for size in [[640.0, 400.0], [860.0, 600.0], [1280.0, 900.0]] {
        ui.set_size(size.into());
        ui.run_steps(4);
        let width = ui.state().canvas.transform.unwrap().canvas.width();
        assert!(width > 230.0, "{width} in a window of {size:?}");
        let properties = ui.get_by_label("Object: bezier").rect();
        assert!(properties.max.y < size[1] - 60.0, "{properties} in a window of {size:?}");
    }
    assert!(ui.query_by_label("Display").is_some(), "a wide window has the progress panel");
}
