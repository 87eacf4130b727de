//! The picture with its handles: looking at it, picking in it, dragging in it.

use super::drag::{Constraint, Drag};
use super::overlay;
use super::picking;
use super::projection::Projection;
use super::view::{Placement, View};
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit, Handle, Item, Selection, handles};
use crate::app::theme;
use egui::{
    Color32, CursorIcon, Key, PointerButton, Pos2, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, Vec2,
    WidgetInfo,
};
use glam::DVec3;
use std::collections::BTreeSet;

/// Side of the square round a handle that takes the pointer, screen points.
const GRAB_SIZE: f32 = 16.0;
/// Zoom for one screen point of scrolling.
const WHEEL_ZOOM: f32 = 0.004;

/// What the canvas remembers from frame to frame.
#[derive(Debug)]
pub(crate) struct Canvas {
    pub(crate) view: View,
    /// Where the picture was put in the last frame.
    pub(crate) placement: Option<Placement>,
    /// The film pixel under the pointer.
    pub(crate) pixel: Option<(u32, u32)>,
    pub(crate) show_handles: bool,
    drag: Option<Drag>,
}

impl Default for Canvas {
    fn default() -> Self {
        Self { view: View::Fit, placement: None, pixel: None, show_handles: true, drag: None }
    }
}

/// What is shown of the scene.
#[derive(Clone, Copy)]
pub(crate) struct Picture<'a> {
    /// The newest picture, if there is one.
    pub(crate) texture: Option<&'a egui::TextureHandle>,
    /// Whether it is of the scene as it is now, or will be at once.
    pub(crate) current: bool,
}

impl Canvas {
    /// Shows the picture and says what the user did to it.
    pub(crate) fn show(
        &mut self,
        ui: &mut Ui,
        document: &Document,
        picture: Picture<'_>,
        commands: &mut Vec<AppCommand>,
    ) {
        let scene = document.scene();
        let film = Vec2::new(scene.film.width.max(1) as f32, scene.film.height.max(1) as f32);
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Picture"));
        let placement = self.view.place(rect, film);
        self.placement = Some(placement);
        paint_picture(ui, &placement, picture);
        if !ui.is_enabled() {
            self.drag = None;
        }
        let pointer = response.contains_pointer().then(|| ui.input(|input| input.pointer.hover_pos())).flatten();
        self.pixel = pointer.and_then(|pointer| placement.pixel(pointer));
        if let Some(projection) = Projection::new(&scene.camera, &scene.film) {
            let stage = Stage { document, placement, projection };
            pick(&stage, &response, commands);
            if self.show_handles {
                self.handles_ui(ui, &stage, &response, commands);
            }
        }
        self.navigate(ui, &response, &placement);
    }

    /// Wheel and pinch zoom to the pointer; dragging beside the handles pans.
    fn navigate(&mut self, ui: &Ui, response: &Response, placement: &Placement) {
        let (scroll, pinch, pointer) =
            ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta(), input.pointer.hover_pos()));
        let factor = pinch * (scroll * WHEEL_ZOOM).exp();
        if let Some(pointer) = pointer.filter(|_| response.contains_pointer() && factor != 1.0) {
            self.view = placement.zoomed(factor, pointer);
        } else if response.dragged() && self.drag.is_none() {
            self.view = placement.panned(response.drag_delta());
            ui.set_cursor_icon(CursorIcon::Grabbing);
        }
    }

    fn handles_ui(&mut self, ui: &mut Ui, stage: &Stage<'_>, canvas: &Response, commands: &mut Vec<AppCommand>) {
        // Before the handles, which Escape makes forget that they are dragged.
        if self.drag.is_some() && ui.input(|input| input.key_pressed(Key::Escape)) {
            self.drag = None;
            commands.push(AppCommand::CancelDrag);
        }
        let mut shown = stage.handles();
        // The nearest is added last and so takes the pointer first.
        shown.sort_by(|a, b| b.depth.total_cmp(&a.depth));
        let painter = ui.painter_at(stage.placement.canvas);
        if let Some(bezier) = stage.document.selection.bezier(stage.document.scene()) {
            overlay::paint_net(&painter, stage, bezier);
        }
        self.take_over(ui, stage, &shown, canvas, commands);
        for place in &shown {
            let response = handle_ui(ui, stage, place);
            self.act(ui, stage, place.handle, &response, commands);
            overlay::paint_handle(&painter, stage, place, &response);
        }
    }

    /// A handle that the pointer has left before the first frame of its drag. egui looks where the pointer is, not where the
    /// button went down, and finds the canvas; in a slow frame a hand comes that far.
    fn take_over(
        &mut self,
        ui: &Ui,
        stage: &Stage<'_>,
        shown: &[HandlePlace],
        canvas: &Response,
        commands: &mut Vec<AppCommand>,
    ) {
        if canvas.drag_started_by(PointerButton::Primary) {
            let pressed = ui.input(|input| input.pointer.press_origin());
            // The last is on top.
            let grabbed = pressed.and_then(|at| shown.iter().rev().find(|place| place.grab_rect().contains(at)));
            if let Some(place) = grabbed {
                self.begin_drag(ui, stage, place.handle, commands);
            }
        }
        if let Some(drag) = self.drag.filter(|_| canvas.dragged()) {
            self.go_on(ui, stage, drag.handle, canvas, commands);
        }
        if canvas.drag_stopped() {
            self.drag = None;
        }
    }

    fn act(&mut self, ui: &Ui, stage: &Stage<'_>, handle: Handle, response: &Response, commands: &mut Vec<AppCommand>) {
        let shift = ui.input(|input| input.modifiers.shift);
        if response.drag_started_by(PointerButton::Primary) {
            self.begin_drag(ui, stage, handle, commands);
        } else if response.clicked() {
            commands.push(AppCommand::Select(stage.clicked(handle, shift)));
        }
        if response.dragged_by(PointerButton::Primary) {
            self.go_on(ui, stage, handle, response, commands);
        } else if response.dragged() {
            self.view = stage.placement.panned(response.drag_delta());
        }
        if response.drag_stopped() {
            self.drag = None;
        }
    }

    fn begin_drag(&mut self, ui: &Ui, stage: &Stage<'_>, handle: Handle, commands: &mut Vec<AppCommand>) {
        let origin = ui.input(|input| input.pointer.press_origin());
        let start = handle.position(stage.document.scene());
        self.drag = origin
            .zip(start)
            .and_then(|(origin, start)| Drag::new(handle, start, stage.placement.to_film(origin), &stage.projection));
        if !stage.is_selected(handle) {
            commands.push(AppCommand::Select(stage.clicked(handle, false)));
        }
    }

    fn go_on(&self, ui: &Ui, stage: &Stage<'_>, handle: Handle, response: &Response, commands: &mut Vec<AppCommand>) {
        let drag = self.drag.filter(|drag| drag.handle == handle);
        let (Some(drag), Some(pointer)) = (drag, response.interact_pointer_pos()) else { return };
        let constraint = constraint(ui);
        overlay::paint_constraint(ui.painter(), stage, handle, constraint);
        let target = drag.target(stage.placement.to_film(pointer), constraint, &stage.projection);
        let by = target - handle.position(stage.document.scene()).unwrap_or(target);
        if by != DVec3::ZERO && by.is_finite() {
            commands.push(AppCommand::Edit(Edit::Move(stage.moving_with(handle), by)));
        }
    }
}

/// What is on the canvas in one frame.
pub(crate) struct Stage<'a> {
    pub(crate) document: &'a Document,
    pub(crate) placement: Placement,
    pub(crate) projection: Projection,
}

/// A handle in front of the eye.
pub(crate) struct HandlePlace {
    pub(crate) handle: Handle,
    pub(crate) screen: Pos2,
    depth: f64,
}

impl HandlePlace {
    /// Where it takes the pointer.
    fn grab_rect(&self) -> Rect {
        Rect::from_center_size(self.screen, Vec2::splat(GRAB_SIZE))
    }
}

impl Stage<'_> {
    /// The screen point of a world point in front of the eye.
    pub(crate) fn screen(&self, world: DVec3) -> Option<Pos2> {
        self.projection.project(world).map(|film| self.placement.to_screen(film))
    }

    /// Whether the selection holds it.
    pub(crate) fn is_selected(&self, handle: Handle) -> bool {
        let selection = &self.document.selection;
        match handle {
            Handle::Point { point, .. } => selection.item == handle.item() && selection.points.contains(&point),
            Handle::Object(_) | Handle::Light(_) => selection.item == handle.item(),
        }
    }

    fn handles(&self) -> Vec<HandlePlace> {
        let scene = self.document.scene();
        let mut places = Vec::new();
        for handle in handles::visible(scene, self.document.selection.item) {
            let Some(world) = handle.position(scene) else { continue };
            let Some(screen) = self.screen(world) else { continue };
            if self.placement.canvas.contains(screen) {
                places.push(HandlePlace { handle, screen, depth: self.projection.depth(world) });
            }
        }
        places
    }

    /// The selection after a click on a handle.
    fn clicked(&self, handle: Handle, extend: bool) -> Selection {
        let mut selection = self.document.selection.clone();
        if selection.item != handle.item() {
            selection = Selection::of(handle.item());
        }
        match handle {
            Handle::Point { point, .. } => selection.click_point(point, extend),
            Handle::Object(_) | Handle::Light(_) => selection.points.clear(),
        }
        selection
    }

    /// What moves with a handle: of control points the selected ones, and what lies at the same places.
    fn moving_with(&self, handle: Handle) -> Vec<Handle> {
        let Handle::Point { object, point } = handle else { return vec![handle] };
        let selection = &self.document.selection;
        let Some(bezier) = selection.bezier(self.document.scene()) else { return vec![handle] };
        let grabbed = if self.is_selected(handle) { selection.points.clone() } else { BTreeSet::from([point]) };
        let moving: BTreeSet<_> = grabbed.into_iter().flat_map(|point| handles::welded(bezier, point)).collect();
        moving.into_iter().map(|point| Handle::Point { object, point }).collect()
    }
}

fn constraint(ui: &Ui) -> Constraint {
    let keys = [(Key::X, DVec3::X), (Key::Y, DVec3::Y), (Key::Z, DVec3::Z)];
    let held = ui.input(|input| keys.into_iter().find(|(key, _)| input.key_down(*key)));
    held.map_or(Constraint::Facing, |(_, axis)| Constraint::Axis(axis))
}

fn handle_ui(ui: &mut Ui, stage: &Stage<'_>, place: &HandlePlace) -> Response {
    let response = ui.interact(place.grab_rect(), ui.scope_id().with(place.handle), Sense::click_and_drag());
    let label = place.handle.label(stage.document.scene());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label.clone()));
    let response = response.on_hover_cursor(CursorIcon::Grab);
    if response.dragged() { response } else { response.on_hover_text(label) }
}

/// A click beside the handles selects what is seen there.
fn pick(stage: &Stage<'_>, response: &Response, commands: &mut Vec<AppCommand>) {
    let Some(pointer) = response.interact_pointer_pos().filter(|_| response.clicked()) else { return };
    let ray = stage.projection.ray(stage.placement.to_film(pointer));
    if let Some(object) = picking::nearest_object(stage.document.scene(), &ray) {
        let item = Item::Object(object);
        if stage.document.selection.item != item || !stage.document.selection.points.is_empty() {
            commands.push(AppCommand::Select(Selection::of(item)));
        }
    }
}

fn paint_picture(ui: &Ui, placement: &Placement, Picture { texture, current }: Picture<'_>) {
    let palette = theme::palette(ui.visuals().dark_mode);
    let painter = ui.painter_at(placement.canvas);
    painter.rect_filled(placement.canvas, 0.0, palette.canvas);
    let picture = placement.picture();
    let tint = if current { Color32::WHITE } else { theme::overlay::OUTDATED };
    match texture {
        Some(texture) => {
            let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
            painter.image(texture.id(), picture, whole, tint);
        }
        None if current => {
            let font = egui::TextStyle::Body.resolve(ui.style());
            let center = placement.canvas.center();
            painter.text(center, egui::Align2::CENTER_CENTER, "Preparing the scene…", font, ui.visuals().text_color());
        }
        None => {}
    }
    painter.rect_stroke(picture, 0.0, Stroke::new(1.0, palette.frame), StrokeKind::Outside);
}
