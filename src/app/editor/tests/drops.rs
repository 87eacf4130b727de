use super::*;
use crate::app::commands::AppCommand;
use crate::app::document::Edit;
use crate::scene::{Location, Shape};

fn drop_file(ui: &mut Ui, path: std::path::PathBuf) {
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Drop(path));
    ui.run_steps(2);
}

#[test]
fn a_dropped_bpt_file_becomes_an_object_that_names_the_file() {
    let (mut ui, folder) = (open("cornell"), folder());
    let (bpt, path) = (folder.path().join("pot.bpt"), folder.path().join("mine.toml"));
    std::fs::copy("scenes/teapot.bpt", &bpt).unwrap();
    drop_file(&mut ui, bpt);
    let object = scene(&ui).objects.last().unwrap().clone();
    assert!(matches!(&object.shape, Shape::Bezier(bezier) if bezier.patches.len() == 32), "{object:?}");
    assert_eq!(object.name, "pot");
    answer_dialogs(&mut ui, Some(path.clone()));
    press(&mut ui, Key::S);
    wait_until(&mut ui, "the save", |_| path.exists());
    assert!(std::fs::read_to_string(&path).unwrap().contains("file = \"pot.bpt\""), "the scene names the .bpt file");

    std::fs::write(folder.path().join("bad.bpt"), "1\n3 2\n").unwrap();
    let before = scene(&ui).clone();
    drop_file(&mut ui, folder.path().join("bad.bpt"));
    let said = matches!(&ui.state().dialog, Some(Dialog::Error(_, text)) if text.contains("line 2"));
    assert!(said, "the message names the line");
    assert_eq!(*scene(&ui), before);
}

#[test]
fn a_dropped_picture_becomes_a_texture_and_a_dropped_scene_is_opened() {
    let (mut ui, folder) = (open("cornell"), folder());
    drop_file(&mut ui, "scenes/teapot.toml".into());
    assert_eq!(ui.state().document.file().location, Location::Disk("scenes/teapot.toml".into()));
    let before = scene(&ui).textures.len();
    let (picture, text) = (folder.path().join("picture.PNG"), folder.path().join("text.png"));
    image::RgbImage::new(2, 2).save(&picture).unwrap();
    std::fs::write(&text, "no picture").unwrap();
    drop_file(&mut ui, picture);
    assert_eq!((scene(&ui).textures.len(), scene(&ui).textures[before].name.as_str()), (before + 1, "picture"));
    drop_file(&mut ui, text.clone());
    let said = matches!(&ui.state().dialog, Some(Dialog::Error(_, text)) if text.contains("not a valid PNG or JPEG"));
    assert!(said, "{:?}", ui.state().dialog);
    assert_eq!(scene(&ui).textures.len(), before + 1, "a file of text is no texture");
    click(&mut ui, "Close");
    let mut texture = scene(&ui).textures[before].clone();
    texture.file = text.display().to_string();
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Edit(Edit::Texture(before, texture)));
    assert_eq!(ui.state().toasts.len(), 1, "a typed file that is no picture gets a message");
}

#[test]
fn a_dropped_file_that_cannot_be_opened_asks_no_question() {
    let (mut ui, folder) = (open("cornell"), folder());
    edit(&mut ui);
    drop_file(&mut ui, "picture.hdr".into());
    assert_eq!((ui.state().toasts.len(), &ui.state().dialog), (1, &None), "a message, no question");
    let broken = folder.path().join("broken.toml");
    std::fs::write(&broken, "version = \"one\"").unwrap();
    drop_file(&mut ui, broken);
    assert!(matches!(ui.state().dialog, Some(Dialog::Error(..))), "{:?}", ui.state().dialog);
}

#[test]
fn a_file_dragged_over_the_window_dims_the_window() {
    let mut ui = open("cornell");
    let layers = |ui: &Ui| ui.output().shapes.len();
    let before = layers(&ui);
    let hovered = egui::HoveredFile { path: Some("pot.bpt".into()), ..Default::default() };
    ui.input_mut().hovered_files = vec![hovered];
    ui.run_steps(2);
    assert!(layers(&ui) >= before + 3, "a veil, a frame and a sentence");
    ui.input_mut().hovered_files.clear();
    ui.run_steps(2);
    assert_eq!(layers(&ui), before, "gone");
}
