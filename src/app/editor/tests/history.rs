use super::*;
use crate::app::document::{Edit, Item};

/// The editor of a scene with three undo steps.
fn edited() -> Ui {
    let mut ui = open("cornell");
    edit(&mut ui);
    let mut film = scene(&ui).film;
    film.exposure = 1.0;
    ui.state_mut().document.edit(Edit::Film(film));
    ui.state_mut().document.end_gesture();
    ui.state_mut().document.edit(Edit::Remove(Item::Object(0)));
    ui.run_steps(2);
    ui
}

#[test]
fn a_click_in_the_history_goes_to_a_state() {
    let mut ui = edited();
    let (objects, first) = (scene(&ui).objects.len(), scene(&ui).objects[0].clone());
    choose_from_menu(&mut ui, &["Edit"]);
    ui.get_by_label_contains("Show history").click();
    ui.run_steps(4);
    click(&mut ui, "change exposure");
    assert_eq!(scene(&ui).objects.len(), objects + 1, "the deletion is undone");
    assert_eq!(ui.state().document.done_steps(), 2);
    click(&mut ui, "Start");
    assert!(!ui.state().document.is_dirty(), "the scene as opened");
    let last = ui.state().document.steps().last().unwrap().to_owned();
    assert!(last.starts_with("delete "), "the deleted object's name: {last}");
    click(&mut ui, &last);
    assert_eq!(scene(&ui).objects[0], first, "all steps are done again");
}

#[test]
fn the_menu_names_the_edit_and_its_item() {
    let mut ui = open("cornell");
    let name = ui.state().document.selection.object(scene(&ui)).unwrap().name.clone();
    edit(&mut ui);
    choose_from_menu(&mut ui, &["Edit"]);
    assert!(ui.query_by_label_contains(&format!("Undo change corner of {name}")).is_some());
}

#[test]
fn the_history_closes_by_its_key() {
    let mut ui = edited();
    press(&mut ui, Key::H);
    assert!(ui.query_by_label("Start").is_some(), "open");
    press(&mut ui, Key::H);
    assert!(ui.query_by_label("Start").is_none(), "closed");
}
