//! The view of the canvas.

use super::colors::{false_colors, scale_of, surfaces};
use super::field::Field;
use super::profile::Profile;
use super::statistics::Statistics;
use crate::app::commands::PictureView;
use crate::app::rendering::BackgroundImage;
use crate::engine::Frame;
use egui::{Color32, ColorImage, Context, Pos2, TextureHandle};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The picture that a view is of.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Key {
    view: PictureView,
    generation: u64,
    iteration: u64,
}

/// Numbers with their scale.
pub(super) struct Scaled {
    pub(super) field: Field,
    /// The end of the scale from 0.
    pub(super) scale: f32,
    /// Least, mean and greatest number of each object.
    statistics: BTreeMap<u32, Statistics>,
}

/// What the canvas shows of the scene.
#[derive(Default)]
pub(crate) struct Inspection {
    view: PictureView,
    image: BackgroundImage<Key, Option<Scaled>>,
    /// The ends of the line of a profile, film pixels.
    pub(super) line: Option<[Pos2; 2]>,
    /// Whether the next drag draws the line of a profile.
    pub(crate) draws_line: bool,
}

impl Inspection {
    /// The present view.
    pub(crate) fn view(&self) -> PictureView {
        self.view
    }

    /// Changes the view. The line of a profile stays.
    pub(crate) fn set_view(&mut self, view: PictureView) {
        self.view = view;
    }

    /// Whether the view has numbers.
    pub(crate) fn has_numbers(&self) -> bool {
        matches!(self.view, PictureView::Irradiance | PictureView::Error | PictureView::Distance)
    }

    /// Draws the line of a profile between two points in film pixels; `None` removes it.
    pub(crate) fn set_line(&mut self, line: Option<[Pos2; 2]>) {
        self.line = line;
        self.draws_line = false;
    }

    /// Begins the image of the view of the newest frame, and takes one that is ready.
    pub(crate) fn update(&mut self, ctx: &Context, frame: Option<&Arc<Frame>>) {
        self.image.poll(ctx);
        let Some(frame) = frame.filter(|frame| !frame.draft && self.view != PictureView::Light) else { return };
        let key = Key { view: self.view, generation: frame.generation, iteration: frame.iteration };
        let frame = Arc::clone(frame);
        self.image.ask(ctx, key, move |key| image_of(key.view, &frame));
    }

    /// The image of the present view; `None` where the canvas shows light, and before it is ready.
    pub(crate) fn texture(&self) -> Option<&TextureHandle> {
        self.image.texture().filter(|_| self.is_ready())
    }

    fn is_ready(&self) -> bool {
        self.image.made().is_some_and(|(key, _)| key.view == self.view)
    }

    /// The numbers of the image that is shown; `None` for a view without numbers.
    pub(super) fn scaled(&self) -> Option<&Scaled> {
        self.image.made().filter(|_| self.is_ready()).and_then(|(_, scaled)| scaled.as_ref())
    }

    /// The number at a column and row of the film.
    pub(crate) fn number_at(&self, (x, y): (u32, u32)) -> Option<f32> {
        self.scaled()?.field.at(x as usize, y as usize)
    }

    /// Least, mean and greatest number of an object.
    pub(super) fn statistics(&self, object: usize) -> Option<Statistics> {
        self.scaled()?.statistics.get(&u32::try_from(object).ok()?).copied()
    }

    /// The numbers along the line; `None` without a line or numbers.
    pub(crate) fn profile(&self) -> Option<Profile> {
        Some(Profile::along(&self.scaled()?.field, self.line?))
    }
}

/// The image of a view of a frame, with its numbers, if it has any. A frame that does not tell them has an empty image.
fn image_of(view: PictureView, frame: &Frame) -> (ColorImage, Option<Scaled>) {
    if let Some(field) = Field::of(view, frame) {
        let scale = scale_of(&field);
        let statistics = Statistics::of_objects(&field);
        return (false_colors(&field, scale), Some(Scaled { field, scale, statistics }));
    }
    let is_of_surfaces = matches!(view, PictureView::Albedo | PictureView::Normals);
    let image = frame.g_buffer.as_ref().filter(|_| is_of_surfaces).map(|g_buffer| surfaces(view, g_buffer));
    (image.unwrap_or_else(|| ColorImage::filled([1, 1], Color32::BLACK)), None)
}
