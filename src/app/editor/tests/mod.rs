//! Tests of the editor through its widgets, without a window, a GPU or an engine.
//!
//! | file | holds |
//! |---|---|
//! | `canvas` | selecting and dragging handles; zoom and pan |
//! | `comparison` | snapshots, and comparisons with them |
//! | `navigation` | orbit, pan and dolly of the camera |
//! | `viewpoint` | looking around, matching the window |
//! | `grasp` | the gizmo, snapping, soft selection, arrow keys, hidden handles |
//! | `selecting` | rectangles, all and none, rows and columns |
//! | `frames` | frames, the texture, progress, failures |
//! | `files` | opening, saving, leaving scenes |
//! | `drops` | dropped files |
//! | `exports` | exporting pictures and surfaces |
//! | `history` | the list of undo steps |
//! | `inspection` | views of what the picture measures, profiles |
//! | `keys` | shortcuts, the help |
//! | `panels` | the outline, adding and deleting, notices |
//! | `random_input` | random pointer, keys and text |
//! | `recovery` | unsaved changes of windows that ended |
//! | `preferences` | remembered looks and folders, recent files |
//! | `outside` | files that other programs change |
//! | `revolution` | surfaces of revolution; thickened sheets and mirror copies |
//! | `surface` | splitting and fairing of patches; control points that move together |
//! | `analysis` | isolines, curvature and reflection lines; light paths |
//! | `fields` | typed numbers and names |

mod analysis;
mod canvas;
mod comparison;
mod drops;
mod exports;
mod fields;
mod files;
mod frames;
mod grasp;
mod history;
mod inspection;
mod keys;
mod navigation;
mod outside;
mod panels;
mod preferences;
mod random_input;
mod recovery;
mod revolution;
mod selecting;
mod surface;
mod viewpoint;

use crate::app::document::{Handle, Item, Selection, Welds, handles};
use crate::app::editor::Editor;
use crate::app::files::{Chooser, Request};
use crate::app::shell::Dialog;
use crate::app::{keyboard, theme};
use crate::engine::{Command, Counters, Energy, Frame, PassSeconds, PlanItem, PlanNote, PlanSummary, Stats, Status};
use crate::film::LinearImage;
use crate::math::Rgb;
use crate::scene::{Scene, SceneFile, Shape};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, Pos2, TouchPhase, Vec2, vec2};
use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, Node};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

type Ui = Harness<'static, Editor>;

/// The editor of a built-in scene, in a window of 1280 x 900 points.
fn open(scene: &str) -> Ui {
    let editor = Editor::new(SceneFile::built_in(scene).unwrap());
    let show = |ui: &mut egui::Ui, editor: &mut Editor| {
        editor.poll(ui.ctx());
        editor.ui(ui);
    };
    let install = |ctx: &egui::Context| {
        theme::install(ctx);
        keyboard::install(ctx);
    };
    let builder = Harness::builder().with_size([1280.0, 900.0]).with_context_setup(install);
    let mut ui = builder.build_ui_state(show, editor);
    // Panels settle their sizes within four frames.
    ui.run_steps(4);
    ui
}

fn scene(ui: &Ui) -> &Scene {
    ui.state().document.scene()
}

/// The scenes that were sent to the engine since the last call.
fn sent_scenes(ui: &mut Ui) -> Vec<Arc<SceneFile>> {
    let sent = ui.state_mut().rendering.take_commands().into_iter();
    sent.filter_map(|command| if let Command::Show(file) = command { Some(file) } else { None }).collect()
}

/// Types a number into a field, as a user does.
fn type_number(ui: &mut Ui, field: &str, text: &str) {
    ui.get_by_role_and_label(Role::SpinButton, field).click();
    ui.run_steps(2);
    ui.key_press_modifiers(Modifiers::COMMAND, Key::A);
    ui.run_steps(1);
    focused(ui).type_text(text);
    ui.key_press(Key::Enter);
    ui.run_steps(2);
}

fn focused(ui: &Ui) -> Node<'_> {
    ui.get_by(|node| node.is_focused())
}

/// Opens a menu and clicks an entry.
fn choose_from_menu(ui: &mut Ui, path: &[&str]) {
    for label in path {
        ui.get_by_role_and_label(Role::Button, label).click();
        ui.run_steps(3);
    }
}

/// Runs frames until `done`, which waits for another thread.
fn wait_until(ui: &mut Ui, what: &str, mut done: impl FnMut(&mut Ui) -> bool) {
    let start = Instant::now();
    while !done(ui) {
        assert!(start.elapsed() < Duration::from_secs(20), "timed out waiting for {what}");
        std::thread::sleep(Duration::from_millis(2));
        ui.run_steps(1);
    }
}

/// Replaces the file dialogs by ones that return `path` at once.
fn answer_dialogs(ui: &mut Ui, path: Option<PathBuf>) {
    ui.state_mut().chooser = Chooser::new(Arc::new(move |_: &Request| path.clone()));
}

fn frame(generation: u64, draft: bool, size: u32) -> Arc<Frame> {
    let pixels = (0..size * size).map(|k| Rgb::splat((k % 7) as f32 / 7.0)).collect();
    let plan = PlanSummary {
        notes: vec![PlanNote { item: PlanItem::Caustics, rendered: false, reason: "no specular surface".into() }],
        warnings: Vec::new(),
    };
    let stats = Stats {
        iterations: 3,
        photons_emitted: 120_000,
        rays: 1_000_000,
        dropped_samples: 0,
        seconds: 1.5,
        photons_per_second: 80_000.0,
        radius: 0.01,
        error_estimate: Some(0.05),
        missing_light: None,
        passes: PassSeconds { prepare: 0.01, camera: 0.1, photons: 0.6, map: 0.05, gather: 0.1, commit: 0.02 },
        counters: Counters::default(),
        energy: Energy::default(),
    };
    let image = Arc::new(LinearImage { width: size, height: size, pixels });
    Arc::new(Frame {
        generation,
        draft,
        iteration: 3,
        image,
        preview: None,
        smoothed: false,
        g_buffer: None,
        noise: None,
        stats,
        plan: Arc::new(plan),
    })
}

fn receive(ui: &mut Ui, frame: Arc<Frame>) {
    ui.state_mut().rendering.receive(Some(frame), Status::Rendering);
    ui.run_steps(2);
}

/// A temporary folder.
fn folder() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

/// Clicks a button.
fn click(ui: &mut Ui, label: &str) {
    ui.get_by_role_and_label(Role::Button, label).click();
    ui.run_steps(3);
}

/// Presses a key with Ctrl.
fn press(ui: &mut Ui, key: Key) {
    ui.key_press_modifiers(Modifiers::COMMAND, key);
    ui.run_steps(2);
}

/// Types a path into the path field.
fn type_path(ui: &mut Ui, path: &std::path::Path) {
    ui.get_by_role_and_label(Role::TextInput, "Path").focus();
    ui.run_steps(2);
    ui.key_press_modifiers(Modifiers::COMMAND, Key::A);
    ui.run_steps(1);
    ui.get_by_role_and_label(Role::TextInput, "Path").type_text(&path.display().to_string());
    ui.run_steps(2);
}

/// Presses a key with Ctrl, and waits for the path field.
fn path_field(ui: &mut Ui, key: Key) {
    answer_dialogs(ui, None);
    press(ui, key);
    wait_until(ui, "the path field", |ui| matches!(ui.state().dialog, Some(Dialog::Path(..))));
    ui.run_steps(2);
}

/// Selects an item.
fn select(ui: &mut Ui, item: Item) {
    ui.state_mut().document.selection = Selection::of(item);
    ui.run_steps(2);
}

/// The index of the first object of this kind.
fn first_object(ui: &Ui, kind: impl Fn(&Shape) -> bool) -> usize {
    scene(ui).objects.iter().position(|object| kind(&object.shape)).unwrap()
}

/// Changes the scene, so that it has unsaved changes.
fn edit(ui: &mut Ui) {
    type_number(ui, "Corner x", "-0.9");
    assert!(ui.state().document.is_dirty(), "the scene has unsaved changes");
}

/// Presses the pointer at `from` and moves it by `way` in steps; the button stays down.
fn drag(ui: &mut Ui, from: Pos2, way: Vec2, steps: u8) {
    ui.hover_at(from);
    ui.run_steps(1);
    ui.drag_at(from);
    ui.run_steps(1);
    for step in 1..=steps {
        ui.hover_at(from + way * f32::from(step) / f32::from(steps));
        ui.run_steps(1);
    }
}

/// Drags the pointer from `from` by `way`.
fn drag_and_drop(ui: &mut Ui, from: Pos2, way: Vec2) {
    drag(ui, from, way, 4);
    ui.drop_at(from + way);
    ui.run_steps(2);
}

/// Holds modifier keys down from now on.
fn hold(ui: &mut Ui, modifiers: Modifiers) {
    ui.event(Event::ModifiersChanged(modifiers));
    ui.run_steps(1);
}

/// Turns the wheel by lines.
fn turn_wheel(ui: &mut Ui, lines: f32) {
    ui.event(Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: vec2(0.0, lines),
        phase: TouchPhase::Move,
        source: MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    ui.run_steps(20);
}

/// The handles of the selected object: one for each group of welded control points.
fn point_handles(ui: &Ui) -> Vec<Handle> {
    let selection = &ui.state().document.selection;
    let welds = Welds::of(selection.bezier(scene(ui)).unwrap());
    handles::visible(scene(ui), selection.item, welds.groups()).into_iter().map(|(handle, _)| handle).collect()
}
