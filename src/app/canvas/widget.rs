//! The canvas widget: the picture with its handles, and the pointer and keyboard input on it.

use super::drag::{Constraint, Drag};
use super::navigation::Navigation;
use super::overlay;
use super::picking;
use super::pixels;
use super::projection::Projection;
use super::stage::{self, ScreenHandle, Stage};
use super::view::{ScreenTransform, View};
use crate::app::commands::AppCommand;
use crate::app::document::{Document, Edit, Handle, Item, Selection};
use crate::app::theme;
use crate::film::LinearImage;
use crate::scene::Scene;
use egui::{
    Color32, CursorIcon, Key, PointerButton, Pos2, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, Vec2,
    WidgetInfo,
};
use glam::DVec3;

/// Logarithm of the zoom factor per screen point of scrolling.
const WHEEL_ZOOM: f32 = 0.004;

/// The state of the canvas between frames.
#[derive(Debug)]
pub(crate) struct Canvas {
    pub(crate) view: View,
    /// The transform of the last frame; `None` before the first.
    pub(crate) transform: Option<ScreenTransform>,
    /// Column and row of the film pixel under the pointer.
    pub(crate) pixel: Option<(u32, u32)>,
    pub(crate) show_handles: bool,
    /// Whether the picture has the size of the canvas.
    pub(crate) matches_window: bool,
    pub(crate) navigation: Navigation,
    drag: Option<Drag>,
}

impl Default for Canvas {
    fn default() -> Self {
        Self {
            view: View::Fit,
            transform: None,
            pixel: None,
            show_handles: true,
            matches_window: false,
            navigation: Navigation::default(),
            drag: None,
        }
    }
}

/// The picture on the canvas.
#[derive(Clone, Copy)]
pub(crate) struct Picture<'a> {
    /// The newest picture; `None` before the first.
    pub(crate) texture: Option<&'a egui::TextureHandle>,
    /// The linear image of the newest picture; `None` where it has fewer pixels than the film.
    pub(crate) image: Option<&'a LinearImage>,
    /// Whether the picture shows the present scene, or soon will; any other picture is dimmed.
    pub(crate) current: bool,
}

impl Canvas {
    /// Shows the picture with its handles, and pushes the user's requests. `seen` is the document's scene with the camera and
    /// the film of the picture.
    pub(crate) fn show(
        &mut self,
        ui: &mut Ui,
        document: &Document,
        seen: &Scene,
        picture: Picture<'_>,
        commands: &mut Vec<AppCommand>,
    ) {
        let film = Vec2::new(seen.film.width.max(1) as f32, seen.film.height.max(1) as f32);
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Picture"));
        let transform = if self.matches_window && self.view == View::Fit {
            ScreenTransform::filling(rect, film, ui.ctx().pixels_per_point())
        } else {
            self.view.transform(rect, film)
        };
        self.transform = Some(transform);
        paint_picture(ui, &transform, picture);
        if picture.texture.is_some() {
            pixels::paint_pixels(&ui.painter_at(rect), &transform, &seen.film, picture.image);
        }
        if !ui.is_enabled() {
            self.drag = None;
        }
        let pointer = response.contains_pointer().then(|| ui.input(|input| input.pointer.hover_pos())).flatten();
        self.pixel = pointer.and_then(|pointer| transform.pixel(pointer));
        if let Some(projection) = Projection::new(&seen.camera, &seen.film) {
            let stage = Stage { document, transform, projection };
            let drawn = if self.show_handles { stage.handles() } else { Vec::new() };
            pick(ui, &stage, &drawn, &response, commands);
            if self.show_handles {
                self.handles_ui(ui, &stage, &drawn, &response, commands);
            }
            if self.drag.is_none() && self.navigation.navigate(ui, &stage, &seen.camera, &response, commands) {
                return;
            }
        }
        self.navigate(ui, &response, &transform);
    }

    /// Shows the whole picture.
    pub(crate) fn fit(&mut self) {
        self.view = View::Fit;
    }

    /// Shows the whole picture, unless it already is on the canvas.
    pub(crate) fn show_all(&mut self) {
        if self.transform.is_some_and(|transform| !transform.canvas.contains_rect(transform.picture())) {
            self.fit();
        }
    }

    /// Shows one film pixel per screen pixel.
    pub(crate) fn one_to_one(&mut self, pixels_per_point: f32) {
        if let Some(transform) = self.transform {
            self.view = transform.one_to_one(pixels_per_point);
        }
    }

    /// Zooms by `factor` about the canvas centre.
    pub(crate) fn zoom(&mut self, factor: f32) {
        if let Some(transform) = self.transform {
            self.view = transform.zoomed(factor, transform.canvas.center());
        }
    }

    /// Zooms about the pointer with wheel and pinch; pans with a drag that holds no handle.
    fn navigate(&mut self, ui: &Ui, response: &Response, transform: &ScreenTransform) {
        let (scroll, pinch, pointer) =
            ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta(), input.pointer.hover_pos()));
        let factor = pinch * (scroll * WHEEL_ZOOM).exp();
        if let Some(pointer) = pointer.filter(|_| response.contains_pointer() && factor != 1.0) {
            self.view = transform.zoomed(factor, pointer);
        } else if response.dragged() && self.drag.is_none() {
            self.view = transform.panned(response.drag_delta());
            ui.set_cursor_icon(CursorIcon::Grabbing);
        }
    }

    fn handles_ui(
        &mut self,
        ui: &mut Ui,
        stage: &Stage<'_>,
        drawn: &[ScreenHandle],
        canvas: &Response,
        commands: &mut Vec<AppCommand>,
    ) {
        // Checked before the handles, because egui ends their drags on Escape.
        if self.drag.is_some() && ui.input(|input| input.key_pressed(Key::Escape)) {
            self.drag = None;
            commands.push(AppCommand::CancelDrag);
        }
        let near = canvas.hover_pos().and_then(|at| stage::grabbed(drawn, at));
        let painter = ui.painter_at(stage.transform.canvas);
        if let Some(bezier) = stage.document.selection.bezier(stage.document.scene()) {
            overlay::paint_net(&painter, stage, bezier);
        }
        let takes_pointer = self.drag.is_some() || !self.navigation.takes_pointer(ui);
        if takes_pointer {
            self.drag_from_canvas(ui, stage, drawn, canvas, commands);
        }
        for screen_handle in drawn {
            if !takes_pointer {
                overlay::paint_handle(&painter, stage, screen_handle, false);
                continue;
            }
            let response = handle_ui(ui, stage, screen_handle);
            self.respond(ui, stage, screen_handle.handle, &response, commands);
            let hot = response.hovered() || response.dragged() || near == Some(screen_handle.handle);
            overlay::paint_handle(&painter, stage, screen_handle, hot);
        }
    }

    /// Drags a handle beside the pointer, or a handle that the pointer left before the first frame of the drag: in a slow frame
    /// the pointer moves that far, and egui then gives the drag to the canvas under the pointer.
    fn drag_from_canvas(
        &mut self,
        ui: &Ui,
        stage: &Stage<'_>,
        drawn: &[ScreenHandle],
        canvas: &Response,
        commands: &mut Vec<AppCommand>,
    ) {
        if canvas.drag_started_by(PointerButton::Primary) {
            let pressed = ui.input(|input| input.pointer.press_origin());
            if let Some(handle) = pressed.and_then(|at| stage::grabbed(drawn, at)) {
                self.begin_drag(ui, stage, handle, commands);
            }
        }
        if let Some(drag) = self.drag.filter(|_| canvas.dragged()) {
            self.continue_drag(ui, stage, drag.handle, canvas, commands);
        }
        if canvas.drag_stopped() {
            self.drag = None;
        }
    }

    /// Selects a clicked handle, and moves a dragged one; a drag with another button pans.
    fn respond(
        &mut self,
        ui: &Ui,
        stage: &Stage<'_>,
        handle: Handle,
        response: &Response,
        commands: &mut Vec<AppCommand>,
    ) {
        let shift = ui.input(|input| input.modifiers.shift);
        if response.drag_started_by(PointerButton::Primary) {
            self.begin_drag(ui, stage, handle, commands);
        } else if response.clicked() {
            commands.push(AppCommand::Select(stage.clicked(handle, shift)));
        }
        if response.dragged_by(PointerButton::Primary) {
            self.continue_drag(ui, stage, handle, response, commands);
        } else if response.dragged() {
            self.view = stage.transform.panned(response.drag_delta());
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
            .and_then(|(origin, start)| Drag::new(handle, start, stage.transform.to_film(origin), &stage.projection));
        if !stage.is_selected(handle) {
            commands.push(AppCommand::Select(stage.clicked(handle, false)));
        }
    }

    fn continue_drag(
        &self,
        ui: &Ui,
        stage: &Stage<'_>,
        handle: Handle,
        response: &Response,
        commands: &mut Vec<AppCommand>,
    ) {
        let drag = self.drag.filter(|drag| drag.handle == handle);
        let (Some(drag), Some(pointer)) = (drag, response.interact_pointer_pos()) else { return };
        let constraint = constraint(ui);
        overlay::paint_constraint(ui.painter(), stage, handle, constraint);
        let target = drag.target(stage.transform.to_film(pointer), constraint, &stage.projection);
        let by = target - handle.position(stage.document.scene()).unwrap_or(target);
        if by != DVec3::ZERO && by.is_finite() {
            commands.push(AppCommand::Edit(Edit::Move(stage.moved_with(handle), by)));
        }
    }
}

/// The constraint of the axis key that is held down.
fn constraint(ui: &Ui) -> Constraint {
    let keys = [(Key::X, DVec3::X), (Key::Y, DVec3::Y), (Key::Z, DVec3::Z)];
    let held = ui.input(|input| keys.into_iter().find(|(key, _)| input.key_down(*key)));
    held.map_or(Constraint::Facing, |(_, axis)| Constraint::Axis(axis))
}

fn handle_ui(ui: &mut Ui, stage: &Stage<'_>, drawn: &ScreenHandle) -> Response {
    let response = ui.interact(drawn.grab_rect(), ui.scope_id().with(drawn.handle), Sense::click_and_drag());
    let label = drawn.handle.label(stage.document.scene());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, label.clone()));
    let response = response.on_hover_cursor(CursorIcon::Grab);
    if response.dragged() { response } else { response.on_hover_text(label) }
}

/// Selects the handle beside a click on the picture, or else the nearest object under it.
fn pick(ui: &Ui, stage: &Stage<'_>, drawn: &[ScreenHandle], response: &Response, commands: &mut Vec<AppCommand>) {
    let Some(pointer) = response.interact_pointer_pos().filter(|_| response.clicked()) else { return };
    if let Some(handle) = stage::grabbed(drawn, pointer) {
        let shift = ui.input(|input| input.modifiers.shift);
        commands.push(AppCommand::Select(stage.clicked(handle, shift)));
        return;
    }
    let ray = stage.projection.ray(stage.transform.to_film(pointer));
    if let Some(object) = picking::nearest_object(stage.document.scene(), &ray) {
        let item = Item::Object(object);
        if stage.document.selection.item != item || !stage.document.selection.points.is_empty() {
            commands.push(AppCommand::Select(Selection::of(item)));
        }
    }
}

fn paint_picture(ui: &Ui, transform: &ScreenTransform, Picture { texture, current, .. }: Picture<'_>) {
    let palette = theme::palette(ui.visuals().dark_mode);
    let painter = ui.painter_at(transform.canvas);
    painter.rect_filled(transform.canvas, 0.0, palette.canvas);
    let picture = transform.picture();
    let tint = if current { Color32::WHITE } else { theme::overlay::OUTDATED };
    match texture {
        Some(texture) => {
            let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
            painter.image(texture.id(), picture, whole, tint);
        }
        None if current => {
            let font = egui::TextStyle::Body.resolve(ui.style());
            let center = transform.canvas.center();
            painter.text(center, egui::Align2::CENTER_CENTER, "Preparing the scene…", font, ui.visuals().text_color());
        }
        None => {}
    }
    painter.rect_stroke(picture, 0.0, Stroke::new(1.0, palette.frame), StrokeKind::Outside);
}
