use super::*;
use crate::app::commands::{Action, AppCommand};
use crate::app::document::NewItem;
use crate::scene::Revolution;
use glam::DVec3;

/// The editor of a scene with a new surface of revolution, which is selected.
fn open_with_vase() -> Ui {
    let mut ui = open("cornell");
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Add(NewItem::Revolution));
    ui.run_steps(4);
    ui
}

fn vase(ui: &Ui) -> &Revolution {
    ui.state().document.selection.revolution(scene(ui)).expect("a surface of revolution is selected")
}

#[test]
fn a_new_surface_of_revolution_has_one_row_of_handles() {
    let ui = open_with_vase();
    for index in 0..vase(&ui).profile().len() {
        assert!(ui.query_by_label(&format!("Profile point {index}")).is_some(), "{index}");
    }
    assert!(ui.query_by_label_contains("Control point").is_none(), "no handle on other patches");
}

#[test]
fn a_dragged_profile_point_stays_under_the_pointer_in_the_plane_of_the_profile() {
    let mut ui = open_with_vase();
    let before = vase(&ui).clone();
    let from = ui.get_by_label("Profile point 3").rect().center();
    drag_and_drop(&mut ui, from, vec2(30.0, -12.0));
    let after = vase(&ui).profile().to_vec();
    for (index, (a, b)) in before.profile().iter().zip(&after).enumerate() {
        assert_eq!(a != b, index == 3, "point {index}: {a} and {b}");
    }
    let there = ui.get_by_label("Profile point 3").rect().center();
    assert!(there.distance(from + vec2(30.0, -12.0)) < 1.5, "{there} after {from}");
    assert!(ui.state().document.undoable().is_some_and(|step| step.contains("surface of revolution")));
    press(&mut ui, Key::Z);
    assert_eq!(*vase(&ui), before, "one undo step");
}

#[test]
fn a_profile_point_stops_at_the_axis() {
    let mut ui = open_with_vase();
    let from = ui.get_by_label("Profile point 3").rect().center();
    drag_and_drop(&mut ui, from, vec2(-400.0, 0.0));
    let radius = vase(&ui).profile()[3].x;
    assert!((0.0..1e-9).contains(&radius), "{radius}");
    assert!(ui.query_by_label_contains("cannot be rendered").is_none(), "the scene stays valid");
}

#[test]
fn angle_caps_and_points_are_edited_as_numbers() {
    let mut ui = open_with_vase();
    let whole = vase(&ui).surface().patches.len();
    type_number(&mut ui, "Angle", "180");
    assert_eq!((vase(&ui).angle(), vase(&ui).surface().patches.len()), (180.0, whole / 2));
    ui.get_by_label("closed by flat caps").click();
    ui.run_steps(2);
    assert!(vase(&ui).caps() && vase(&ui).surface().patches.len() > whole / 2);
    type_number(&mut ui, "Point 3 r", "0.25");
    assert_eq!(vase(&ui).profile()[3].x, 0.25);
    for step in ["profile", "caps", "angle"] {
        let undoable = ui.state().document.undoable().map(str::to_owned);
        assert!(undoable.as_ref().is_some_and(|name| name.contains(step)), "{undoable:?} is not of the {step}");
        press(&mut ui, Key::Z);
    }
    ui.check_accessibility();
}

#[test]
fn segments_are_split_and_removed() {
    let mut ui = open_with_vase();
    ui.set_size([1400.0, 1600.0].into());
    ui.run_steps(4);
    let before = vase(&ui).profile().to_vec();
    click(&mut ui, "point 0");
    click(&mut ui, "Split segment");
    assert_eq!(vase(&ui).profile().len(), before.len() + 3);
    assert_eq!(vase(&ui).profile()[6], before[3], "the first segment is split");
    click(&mut ui, "Remove segment");
    assert_eq!(vase(&ui).profile().len(), before.len());
}

#[test]
fn all_points_of_the_profile_are_selected_and_moved_once() {
    let mut ui = open_with_vase();
    let before = vase(&ui).profile().to_vec();
    press(&mut ui, Key::A);
    assert_eq!(ui.state().document.selection.points.len(), before.len());
    let from = ui.get_by_label("Profile point 3").rect().center();
    drag_and_drop(&mut ui, from, vec2(12.0, 0.0));
    let ways: Vec<f64> = vase(&ui).profile().iter().zip(&before).map(|(after, before)| after.x - before.x).collect();
    assert!(ways[0] > 1e-3, "{ways:?}");
    // Positions of size 1 through some ten roundings a frame.
    assert!(ways.iter().all(|way| (way - ways[0]).abs() < 1e-12), "each point moves once: {ways:?}");
}

#[test]
fn patches_take_the_place_of_a_surface_of_revolution() {
    let mut ui = open_with_vase();
    let ctx = ui.ctx.clone();
    let (before, object) = (vase(&ui).clone(), ui.state().document.selection.item);
    ui.state_mut().apply(&ctx, AppCommand::Do(Action::ConvertToPatches));
    ui.run_steps(2);
    let bezier = ui.state().document.selection.bezier(scene(&ui)).expect("patches").clone();
    assert_eq!(bezier, *before.surface());
    assert_eq!(ui.state().document.selection.item, object);
    press(&mut ui, Key::Z);
    assert_eq!(*vase(&ui), before);
}

#[test]
fn a_sheet_becomes_a_body_in_one_undo_step() {
    let mut ui = open("report");
    let ctx = ui.ctx.clone();
    let before = scene(&ui).clone();
    ui.state_mut().apply(&ctx, AppCommand::Do(Action::Thicken));
    ui.run_steps(2);
    let bezier = ui.state().document.selection.bezier(scene(&ui)).expect("patches");
    assert_eq!(bezier.patches.len(), 1 + 1 + 4);
    ui.state_mut().apply(&ctx, AppCommand::Do(Action::Thicken));
    ui.run_steps(2);
    assert_eq!(ui.state().toasts.len(), 1, "the reason: it is closed");
    press(&mut ui, Key::Z);
    assert_eq!(*scene(&ui), before);
}

#[test]
fn a_mirror_copy_is_selected_and_one_undo_step() {
    let mut ui = open_with_vase();
    let ctx = ui.ctx.clone();
    let (before, translate) = (scene(&ui).clone(), vase(&ui).transform().translate);
    for (action, axis) in [(Action::MirrorCopyX, 0), (Action::MirrorCopyY, 1), (Action::MirrorCopyZ, 2)] {
        ui.state_mut().apply(&ctx, AppCommand::Do(action));
        ui.run_steps(2);
        let mut expected: DVec3 = translate;
        expected[axis] = -expected[axis];
        assert_eq!(vase(&ui).transform().translate, expected);
        press(&mut ui, Key::Z);
        assert_eq!(*scene(&ui), before);
    }
    select(&mut ui, Item::Camera);
    ui.state_mut().apply(&ctx, AppCommand::Do(Action::MirrorCopyX));
    ui.run_steps(2);
    assert_eq!(ui.state().toasts.len(), 1, "the reason");
}
