use super::*;
use egui::Rect;

fn points(ui: &Ui) -> Vec<(usize, usize, usize)> {
    ui.state().document.selection.points.iter().map(|point| (point.patch, point.i, point.j)).collect()
}

fn row(i: usize) -> Vec<(usize, usize, usize)> {
    (0..4).map(|j| (0, i, j)).collect()
}

/// The smallest rectangle with these control points, and a little more.
fn around(ui: &Ui, labels: &[&str]) -> Rect {
    let places: Vec<Pos2> = labels.iter().map(|label| ui.get_by_label(label).rect().center()).collect();
    Rect::from_points(&places).expand(9.0)
}

fn draw(ui: &mut Ui, rect: Rect) {
    drag_and_drop(ui, rect.left_top(), rect.size());
}

#[test]
fn b_and_a_drag_select_a_rectangle() {
    let mut ui = open("report");
    let rect = around(&ui, &["Control point P[3][0]", "Control point P[3][1]"]);
    let view = ui.state().canvas.view;
    ui.key_press(Key::B);
    ui.run_steps(2);
    draw(&mut ui, rect);
    let first = points(&ui);
    assert!(first.contains(&(0, 3, 0)) && first.contains(&(0, 3, 1)), "{first:?}");
    assert!(!first.contains(&(0, 0, 3)), "{first:?}");
    assert_eq!(ui.state().canvas.view, view, "the picture stays");

    let rect = around(&ui, &["Control point P[0][3]"]);
    ui.key_press(Key::B);
    ui.run_steps(2);
    hold(&mut ui, Modifiers::SHIFT);
    draw(&mut ui, rect);
    hold(&mut ui, Modifiers::NONE);
    assert!(points(&ui).contains(&(0, 0, 3)) && points(&ui).len() > first.len(), "Shift adds");
    draw(&mut ui, Rect::from_min_size(rect.left_top() - vec2(40.0, 40.0), vec2(20.0, 20.0)));
    assert_ne!(ui.state().canvas.view, view, "the next drag pans again");
}

#[test]
fn a_drag_with_ctrl_beside_the_handles_selects_a_rectangle() {
    let mut ui = open("report");
    let rect = around(&ui, &["Control point P[3][0]"]).expand(12.0);
    hold(&mut ui, Modifiers::COMMAND);
    draw(&mut ui, rect);
    hold(&mut ui, Modifiers::NONE);
    assert!(points(&ui).contains(&(0, 3, 0)), "{:?}", points(&ui));
    assert!(!ui.state().document.is_dirty(), "nothing moved");
}

#[test]
fn all_points_of_the_patch_then_of_the_object_then_none() {
    let mut ui = open("teapot");
    press(&mut ui, Key::A);
    assert_eq!(points(&ui).len(), 16);
    press(&mut ui, Key::A);
    let all = 16 * ui.state().document.selection.bezier(scene(&ui)).unwrap().patches.len();
    assert_eq!(points(&ui).len(), all);
    ui.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::A);
    ui.run_steps(2);
    assert_eq!(points(&ui), []);
    press(&mut ui, Key::A);
    ui.key_press(Key::Escape);
    ui.run_steps(2);
    assert_eq!(points(&ui), [], "Escape selects none, too");
}

#[test]
fn escape_in_a_menu_or_a_field_keeps_the_selected_points() {
    let mut ui = open("report");
    press(&mut ui, Key::A);
    choose_from_menu(&mut ui, &["View"]);
    ui.key_press(Key::Escape);
    ui.run_steps(3);
    assert_eq!(points(&ui).len(), 16, "the menu is closed");
    ui.get_by_role_and_label(Role::TextInput, "Name").focus();
    ui.run_steps(2);
    assert!(ui.ctx.text_edit_focused(), "the field has the keyboard");
    assert_eq!(points(&ui).len(), 16);
    ui.key_press(Key::Escape);
    ui.run_steps(3);
    assert_eq!(points(&ui).len(), 16, "the field is left");
    ui.key_press(Key::Escape);
    ui.run_steps(2);
    assert_eq!(points(&ui), []);
}

#[test]
fn rows_and_columns_grow_by_keys() {
    let mut ui = open("report");
    ui.get_by_label("Control point P[1][2]").click();
    ui.run_steps(2);
    ui.key_press(Key::I);
    ui.run_steps(2);
    assert_eq!(points(&ui), row(1));
    ui.key_press(Key::J);
    ui.run_steps(2);
    assert_eq!(points(&ui).len(), 16, "the columns through the row");
}

#[test]
fn without_a_control_point_a_row_says_what_to_select() {
    let mut ui = open("report");
    ui.key_press(Key::I);
    ui.run_steps(2);
    assert_eq!(points(&ui), []);
    assert_eq!(ui.state().toasts.len(), 1, "a message");
}
