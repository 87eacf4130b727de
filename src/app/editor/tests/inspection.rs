//! Views of what the picture measures, and profiles.

use super::*;
use crate::app::commands::{AppCommand, PictureView};
use crate::engine::GBuffer;
use crate::transport::{Component, Facet, FirstHit};
use egui::Pos2;
use glam::Vec3;

/// A frame of this side whose pixels show the first object, of albedo 0.5, in an irradiance of the column's number.
fn measured(side: u32) -> Arc<Frame> {
    let facet = Facet { normal: Vec3::Z, albedo: Rgb::splat(0.5), tag: 0, position: Vec3::ZERO };
    let hit = FirstHit { depth: 3.0, is_matte: true, object: Some(0), facet: Some(facet) };
    let count = side * side;
    let pixels = (0..count).map(|k| Rgb::splat(0.5 * (k % side) as f32 / std::f32::consts::PI)).collect();
    let g_buffer = GBuffer { size: [side; 2], first_hits: vec![hit; count as usize], guides: Default::default() };
    Arc::new(Frame {
        image: Arc::new(LinearImage { width: side, height: side, pixels }),
        g_buffer: Some(Arc::new(g_buffer)),
        noise: Some(Arc::new(vec![0.01; count as usize])),
        ..Frame::clone(&frame(1, false, side))
    })
}

/// The editor with a picture of 40 x 40 pixels that shows its measured frame in this view.
fn showing(view: PictureView) -> Ui {
    let mut ui = open("cornell");
    let mut file = SceneFile::clone(ui.state().document.file());
    (file.scene.film.width, file.scene.film.height) = (40, 40);
    ui.state_mut().document = crate::app::document::Document::new(file);
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Show(view));
    receive(&mut ui, measured(40));
    wait_until(&mut ui, "the image of the view", |ui| ui.state().inspection.texture().is_some());
    ui
}

#[test]
fn irradiance_is_read_at_the_pointer_and_has_its_key() {
    let mut ui = showing(PictureView::Irradiance);
    assert!((ui.state().inspection.number_at((7, 3)).unwrap() - 7.0).abs() < 1e-4);
    assert_eq!(ui.state().inspection.number_at((40, 3)), None);
    ui.key_press(Key::Q);
    ui.run_steps(3);
    assert_eq!(ui.state().inspection.view(), PictureView::Light);
    assert!(ui.state().inspection.texture().is_none(), "light again");
}

#[test]
fn other_views_follow_the_menu() {
    let mut ui = open("cornell");
    receive(&mut ui, measured(512));
    for view in [PictureView::Distance, PictureView::Albedo, PictureView::Normals, PictureView::Error] {
        ui.get_by_role_and_label(Role::Button, "Inspect").click();
        ui.run_steps(3);
        ui.get_by_role_and_label(Role::RadioButton, view.label()).click();
        ui.run_steps(3);
        wait_until(&mut ui, view.label(), |ui| ui.state().inspection.texture().is_some());
        assert_eq!(ui.state().inspection.view(), view);
    }
}

#[test]
fn the_engine_tells_noise_and_components_only_on_demand() {
    let mut ui = showing(PictureView::Error);
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Show(PictureView::Light));
    ui.state_mut().apply(&ctx, AppCommand::Only(Some(Component::Caustics)));
    ui.state_mut().apply(&ctx, AppCommand::Only(Some(Component::Caustics)));
    let sent = ui.state_mut().rendering.take_commands();
    let noise: Vec<bool> = sent
        .iter()
        .filter_map(|command| if let Command::Noise(noise) = command { Some(*noise) } else { None })
        .collect();
    assert_eq!(noise, [true, false]);
    assert_eq!(sent.iter().filter(|command| matches!(command, Command::Only(_))).count(), 1, "once");
}

#[test]
fn a_dragged_line_has_a_profile_that_is_exported() {
    let dir = folder();
    let path = dir.path().join("profile.csv");
    let mut ui = showing(PictureView::Irradiance);
    ui.key_press(Key::P);
    ui.run_steps(2);
    let transform = ui.state().canvas.transform.expect("a frame");
    let at = |x: f32, y: f32| -> Pos2 { transform.to_screen(glam::DVec2::new(x.into(), y.into())) };
    drag_and_drop(&mut ui, at(5.5, 20.5), at(30.5, 20.5) - at(5.5, 20.5));
    let profile = ui.state().inspection.profile().expect("a line was drawn");
    assert!(profile.values.len() >= 25, "{}", profile.values.len());
    assert!((profile.values[0] - 5.0).abs() < 1.01, "{:?}", profile.values);
    assert!(ui.state().document.undoable().is_none(), "nothing was moved");
    answer_dialogs(&mut ui, Some(path.clone()));
    click(&mut ui, "Export CSV…");
    wait_until(&mut ui, "the table", |_| path.exists());
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.starts_with("distance_px,column,row,irradiance_w_per_m2\n0.000,"), "{text}");
}

#[test]
fn a_profile_needs_a_line() {
    let mut ui = showing(PictureView::Irradiance);
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Do(crate::app::commands::Action::ExportProfile));
    ui.run_steps(2);
    assert!(ui.state().chooser.pending().is_none() && ui.state().toasts.len() == 1);
}

#[test]
fn an_opened_scene_is_shown_in_all_its_light() {
    let mut ui = showing(PictureView::Irradiance);
    let ctx = ui.ctx.clone();
    ui.state_mut().apply(&ctx, AppCommand::Only(Some(Component::Direct)));
    ui.state_mut().apply(&ctx, AppCommand::ProfileLine(Some([Pos2::ZERO, Pos2::new(9.0, 9.0)])));
    ui.state_mut().document = crate::app::document::Document::new(SceneFile::built_in("cornell").unwrap());
    ui.state_mut().apply(&ctx, AppCommand::Leave(crate::app::commands::Next::New));
    ui.run_steps(2);
    let editor = ui.state();
    assert_eq!((editor.inspection.view(), editor.rendering.only()), (PictureView::Light, None));
    assert!(editor.inspection.profile().is_none());
}
