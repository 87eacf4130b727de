//! Input on handles and gizmo: hover, click, drag, keys.

use super::falloff::Falloff;
use super::movement::Movement;
use super::scenery::{Scenery, Target};
use super::stage::Stage;
use super::steering::{Steering, released_at};
use super::{handle_widgets, nudge, overlay, readout, rectangle, snap};
use crate::app::commands::AppCommand;
use crate::app::document::{Edit, Item, Selection};
use egui::{CursorIcon, Key, PointerButton, Popup, Pos2, Rect, Response, Ui};
use glam::DVec3;

/// The work of pointer and keys on the handles, between frames.
#[derive(Debug, Default)]
pub(crate) struct Grasp {
    held: Option<Held>,
    /// The keys in the last frame of the drag.
    steering: Steering,
    /// Whether the next drag selects by a rectangle.
    pub(crate) selects_rectangle: bool,
    /// Soft selection.
    pub(crate) falloff: Falloff,
    /// The step of the grid that drags with Ctrl snap to, scene units; `None` for the automatic step.
    pub(crate) grid: Option<f64>,
    /// Time of the last nudge, seconds.
    nudged: Option<f64>,
    /// Whether keys were free for the canvas at the end of the last frame: Escape in a field or a menu only leaves it.
    keys_were_free: bool,
}

/// What the pointer holds.
#[derive(Debug)]
enum Held {
    Handles(Movement),
    /// A selection rectangle from this corner, screen points.
    Rectangle(Pos2),
}

impl Grasp {
    /// Whether a drag is in progress.
    pub(crate) fn is_holding(&self) -> bool {
        self.held.is_some()
    }

    /// Whether a key has moved the selection within the last moment: a next press belongs to the same undo step.
    pub(crate) fn is_nudging(&self, time: f64) -> bool {
        self.nudged.is_some_and(|nudged| time < nudged + nudge::PAUSE)
    }

    /// Ends the drag.
    pub(crate) fn release(&mut self) {
        self.held = None;
        self.selects_rectangle = false;
    }

    /// Paints the handles and the gizmo, and pushes the user's requests to select and move.
    /// Without `takes_pointer` the pointer moves the view.
    pub(crate) fn ui(
        &mut self,
        ui: &mut Ui,
        stage: &Stage<'_>,
        canvas: &Response,
        takes_pointer: bool,
        commands: &mut Vec<AppCommand>,
    ) {
        // Checked first, because egui ends drags on Escape.
        if (takes_pointer || self.is_holding()) && ui.input(|input| input.key_pressed(Key::Escape)) {
            self.escape(stage, commands);
        }
        let scenery = Scenery::new(stage);
        if takes_pointer {
            self.press(ui, stage, &scenery, canvas, commands);
        }
        let free = takes_pointer && !self.is_holding() && !self.selects_rectangle;
        let hot = canvas.hover_pos().filter(|_| free).and_then(|at| scenery.target(at));
        self.paint(ui, stage, &scenery, hot);
        self.pull(ui, stage, &scenery, canvas, commands);
        if canvas.drag_stopped() {
            self.held = None;
        }
        if takes_pointer || self.is_holding() {
            handle_widgets::ui(ui, stage, &scenery, hot, commands);
        }
        self.nudge(ui, stage, commands);
        click(ui, stage, &scenery, canvas, commands);
        if self.selects_rectangle && canvas.hovered() {
            ui.set_cursor_icon(CursorIcon::Crosshair);
        } else if hot.is_some() {
            ui.set_cursor_icon(CursorIcon::Grab);
        }
        self.keys_were_free = keys_are_free(ui);
    }

    /// Reverts the drag, or else leaves the selection by rectangle, or else selects no control point.
    fn escape(&mut self, stage: &Stage<'_>, commands: &mut Vec<AppCommand>) {
        let selection = &stage.document.selection;
        match self.held.take() {
            Some(Held::Handles(_)) => commands.push(AppCommand::CancelDrag),
            Some(Held::Rectangle(_)) => {}
            None if self.selects_rectangle => self.selects_rectangle = false,
            None if self.keys_were_free && !selection.points.is_empty() => {
                let points = Default::default();
                commands.push(AppCommand::Select(Selection { points, ..selection.clone() }));
            }
            None => {}
        }
    }

    /// Starts to drag what the pointer was pressed on. In a slow frame the pointer has left it by now.
    fn press(
        &mut self,
        ui: &Ui,
        stage: &Stage<'_>,
        scenery: &Scenery,
        canvas: &Response,
        commands: &mut Vec<AppCommand>,
    ) {
        let (pressed, modifiers) = ui.input(|input| (input.pointer.press_origin(), input.modifiers));
        let Some(pressed) = pressed.filter(|_| canvas.drag_started_by(PointerButton::Primary)) else {
            return;
        };
        let has_points = stage.shows_handles && stage.document.selection.surface(stage.document.scene()).is_some();
        let film = stage.transform.to_film(pressed);
        self.held = match scenery.target(pressed) {
            _ if self.selects_rectangle => Some(Held::Rectangle(pressed)),
            Some(Target::Handle(handle)) => {
                if !stage.is_selected(handle) {
                    commands.push(AppCommand::Select(stage.clicked(handle, false)));
                }
                Movement::of_handle(stage, handle, film, scenery.normal).map(Held::Handles)
            }
            Some(Target::Part(part)) => {
                let part = scenery.gizmo.as_ref().and_then(|gizmo| gizmo.part(part));
                part.and_then(|part| Movement::of_selection(stage, part.constraint(), film, scenery.normal))
                    .map(Held::Handles)
            }
            None => (has_points && modifiers.command).then_some(Held::Rectangle(pressed)),
        };
    }

    /// Moves what is held to the pointer.
    fn pull(
        &mut self,
        ui: &mut Ui,
        stage: &Stage<'_>,
        scenery: &Scenery,
        canvas: &Response,
        commands: &mut Vec<AppCommand>,
    ) {
        let Some(pointer) = canvas.interact_pointer_pos() else { return };
        match &self.held {
            Some(Held::Rectangle(corner)) => {
                let rect = Rect::from_two_pos(*corner, pointer);
                if canvas.drag_stopped() {
                    let extend = ui.input(|input| input.modifiers.shift);
                    commands.push(AppCommand::Select(rectangle::selected(stage, &scenery.drawn, rect, extend)));
                    self.selects_rectangle = false;
                } else {
                    rectangle::paint(&ui.painter_at(stage.transform.canvas), rect);
                }
            }
            Some(Held::Handles(held)) => {
                let at = if canvas.dragged_by(PointerButton::Primary) {
                    self.steering = Steering::of_keys(ui, held.normal);
                    Some(pointer)
                } else {
                    // The pointer may have moved until the button was released, and the keys may have been released since.
                    released_at(ui).filter(|_| canvas.drag_stopped())
                };
                let edit = at.and_then(|at| drag(ui, stage, (held, self.steering), at, (self.grid, &mut self.falloff)));
                commands.extend(edit.map(AppCommand::Edit));
            }
            None => {}
        }
    }

    /// Moves the selection by the arrow keys.
    fn nudge(&mut self, ui: &Ui, stage: &Stage<'_>, commands: &mut Vec<AppCommand>) {
        let (points, time) = ui.input(|input| (nudge::pressed(input), input.time));
        if points == DVec3::ZERO || self.is_holding() || !stage.shows_handles || !ui.is_enabled() || !keys_are_free(ui)
        {
            return;
        }
        let Some(movement) = Movement::by_keys(stage) else { return };
        let Some(at) = movement.position(stage) else { return };
        let radius = self.falloff.on.then(|| self.falloff.radius(movement.extent));
        let target = nudge::world_way(stage, at, points).map(|way| at + way);
        commands.extend(target.and_then(|target| movement.edit(stage, target, radius)).map(AppCommand::Edit));
        self.nudged = Some(time);
        // The undo step ends by a frame after the pause.
        ui.ctx().request_repaint_after_secs(nudge::PAUSE as f32);
    }

    fn paint(&self, ui: &Ui, stage: &Stage<'_>, scenery: &Scenery, hot: Option<Target>) {
        let painter = ui.painter_at(stage.transform.canvas);
        let selection = &stage.document.selection;
        let bezier = selection.bezier(stage.document.scene()).filter(|_| stage.shows_handles);
        if let (Item::Object(object), Some(bezier)) = (selection.item, bezier) {
            overlay::paint_net(&painter, stage, object, bezier);
        }
        let revolution = selection.revolution(stage.document.scene()).filter(|_| stage.shows_handles);
        if let Some(revolution) = revolution {
            overlay::paint_profile(&painter, stage, revolution);
        }
        if let Some(gizmo) = &scenery.gizmo {
            let part = hot.and_then(|hot| if let Target::Part(part) = hot { Some(part) } else { None });
            overlay::paint_gizmo(&painter, gizmo, part);
        }
        for drawn in &scenery.drawn {
            let held = matches!(&self.held, Some(Held::Handles(held)) if held.follows(drawn.handle));
            overlay::paint_handle(&painter, stage, drawn, held || hot == Some(Target::Handle(drawn.handle)));
        }
    }
}

/// Shows a drag of handles in progress. Returns the edit that moves them to the pointer: with Ctrl on the grid, with soft
/// selection together with their neighbours.
fn drag(
    ui: &mut Ui,
    stage: &Stage<'_>,
    (held, steering): (&Movement, Steering),
    pointer: Pos2,
    (grid, falloff): (Option<f64>, &mut Falloff),
) -> Option<Edit> {
    ui.set_cursor_icon(CursorIcon::Grabbing);
    let at = held.position(stage)?;
    let constraint = held.constraint(steering.axis);
    let scroll = ui.input(|input| input.smooth_scroll_delta().y);
    let grid = steering.snaps.then(|| grid.unwrap_or_else(|| snap::automatic_step(&stage.document.scene().camera)));
    let radius = (falloff.on && held.moves_points()).then(|| {
        falloff.radius(held.extent);
        falloff.scroll(scroll);
        falloff.radius(held.extent)
    });
    overlay::paint_constraint(ui.painter(), stage, at, constraint);
    if let Some(radius) = radius {
        overlay::paint_radius(&ui.painter_at(stage.transform.canvas), stage, at, radius);
    }
    readout::ui(ui, stage, (pointer, at), held.delta(stage), (grid, radius));
    let target = held.target(stage, stage.transform.to_film(pointer), constraint, grid);
    held.edit(stage, target, radius)
}

/// Whether no widget and no menu takes keys.
fn keys_are_free(ui: &Ui) -> bool {
    ui.is_enabled() && ui.memory(|memory| memory.focused().is_none()) && !Popup::is_any_open(ui.ctx())
}

/// Selects the clicked handle, or else the nearest object under the pointer, with its patch.
fn click(ui: &Ui, stage: &Stage<'_>, scenery: &Scenery, canvas: &Response, commands: &mut Vec<AppCommand>) {
    let Some(pointer) = canvas.interact_pointer_pos().filter(|_| canvas.clicked()) else { return };
    match scenery.target(pointer) {
        Some(Target::Handle(handle)) => {
            let extend = ui.input(|input| input.modifiers.shift);
            commands.push(AppCommand::Select(stage.clicked(handle, extend)));
        }
        Some(Target::Part(_)) => {}
        None => {
            let ray = stage.projection.ray(stage.transform.to_film(pointer));
            let picked = stage.sight.surfaces.nearest(&ray);
            commands.extend(picked.map(|pick| {
                AppCommand::Select(Selection { patch: pick.patch, ..Selection::of(Item::Object(pick.object)) })
            }));
        }
    }
}
