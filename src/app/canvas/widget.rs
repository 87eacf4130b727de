//! The canvas widget: the picture with its handles, and the pointer and keyboard input on it.

use super::analysis::AnalysisLayer;
use super::grasp::Grasp;
use super::light_paths::LightPathLayer;
use super::navigation::Navigation;
use super::pixels;
use super::projection::Projection;
use super::sight::Sight;
use super::split::{paint_beside, split_ui};
use super::stage::Stage;
use super::view::{ScreenTransform, View};
use crate::app::commands::AppCommand;
use crate::app::document::Document;
use crate::app::theme;
use crate::film::LinearImage;
use crate::scene::Scene;
use egui::{Color32, CursorIcon, Pos2, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo};

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
    pub(crate) analysis: AnalysisLayer,
    pub(crate) light_paths: LightPathLayer,
    /// What the camera sees of the handles.
    pub(crate) sight: Sight,
    /// Input on the handles.
    pub(crate) grasp: Grasp,
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
            analysis: AnalysisLayer::default(),
            light_paths: LightPathLayer::default(),
            sight: Sight::default(),
            grasp: Grasp::default(),
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
    /// The picture to the right of a line, and the line's place from 0 at the left to 1 at the right.
    pub(crate) beside: Option<(&'a egui::TextureHandle, f32)>,
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
        if let Some((texture, split)) = picture.beside {
            paint_beside(ui, &transform, texture, split);
        }
        if picture.texture.is_some() {
            pixels::paint_pixels(&ui.painter_at(rect), &transform, &seen.film, picture.image);
        }
        if !ui.is_enabled() {
            self.grasp.release();
        }
        if let Some((_, split)) = picture.beside {
            split_ui(ui, &transform, split, commands);
        }
        let pointer = response.contains_pointer().then(|| ui.input(|input| input.pointer.hover_pos())).flatten();
        self.pixel = pointer.and_then(|pointer| transform.pixel(pointer));
        if let Some(projection) = Projection::new(&seen.camera, &seen.film)
            && self.handles_ui(ui, (document, seen), (transform, projection), &response, commands)
        {
            return;
        }
        self.navigate(ui, &response, &transform);
    }

    /// Shows the handles, and moves the camera by drags and the wheel. Returns whether the camera took the pointer.
    fn handles_ui(
        &mut self,
        ui: &mut Ui,
        (document, seen): (&Document, &Scene),
        (transform, projection): (ScreenTransform, Projection),
        canvas: &Response,
        commands: &mut Vec<AppCommand>,
    ) -> bool {
        // While handles are dragged, what hides them stays as it was at the start.
        if !self.grasp.is_holding() {
            let pointer = canvas.hover_pos().map(|pointer| transform.to_film(pointer));
            self.sight.update(document, &projection, pointer);
            if self.sight.waits {
                ui.ctx().request_repaint();
            }
        }
        let shows_handles = self.show_handles;
        let stage = Stage { document, transform, projection, sight: &self.sight, shows_handles };
        self.analysis.show(ui, &stage);
        self.light_paths.show(ui, &stage, seen);
        let takes_pointer = !self.navigation.takes_pointer(ui);
        self.grasp.ui(ui, &stage, canvas, takes_pointer, commands);
        !self.grasp.is_holding() && self.navigation.navigate(ui, &stage, &seen.camera, canvas, commands)
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

    /// Zooms about the pointer with wheel and pinch, and pans with a drag, while no handle is held.
    fn navigate(&mut self, ui: &Ui, response: &Response, transform: &ScreenTransform) {
        let (scroll, pinch, pointer) =
            ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta(), input.pointer.hover_pos()));
        let factor = pinch * (scroll * WHEEL_ZOOM).exp();
        if self.grasp.is_holding() {
            return;
        }
        if let Some(pointer) = pointer.filter(|_| response.contains_pointer() && factor != 1.0) {
            self.view = transform.zoomed(factor, pointer);
        } else if response.dragged() {
            self.view = transform.panned(response.drag_delta());
            ui.set_cursor_icon(CursorIcon::Grabbing);
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
