//! The difference of two pictures, in false colours and in numbers, made by another thread.

use crate::film::{Errors, LinearImage, compare, difference_image};
use crate::scene::Film;
use crossbeam_channel::{Receiver, Sender, bounded};
use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use image::RgbImage;
use std::sync::Arc;

/// What is compared.
#[derive(Clone)]
struct Pair {
    image: Arc<LinearImage>,
    reference: Arc<LinearImage>,
    /// Exposure and tone curve, for FLIP.
    film: Film,
}

impl Pair {
    fn is_same(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.image, &other.image)
            && Arc::ptr_eq(&self.reference, &other.reference)
            && (self.film.exposure, self.film.tone_curve) == (other.film.exposure, other.film.tone_curve)
    }
}

/// Numbers of a difference.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbers {
    pub(super) errors: Errors,
    /// Mean perceived difference; `None` without the feature `flip`.
    pub(super) flip: Option<f64>,
}

/// The difference of the two pictures that were asked for last.
pub(crate) struct Difference {
    made: Option<(Pair, Numbers)>,
    texture: Option<TextureHandle>,
    busy: bool,
    done: (Sender<(Pair, Numbers, ColorImage)>, Receiver<(Pair, Numbers, ColorImage)>),
}

impl Default for Difference {
    fn default() -> Self {
        Self { made: None, texture: None, busy: false, done: bounded(1) }
    }
}

impl Difference {
    /// Asks for the difference of two pictures of one size, with the exposure and the tone curve of a film.
    pub(super) fn ask(&mut self, ctx: &Context, image: &Arc<LinearImage>, reference: &Arc<LinearImage>, film: &Film) {
        let pair = Pair { image: Arc::clone(image), reference: Arc::clone(reference), film: *film };
        if self.busy || self.made.as_ref().is_some_and(|(made, _)| made.is_same(&pair)) {
            return;
        }
        self.busy = true;
        let (done, ctx) = (self.done.0.clone(), ctx.clone());
        rayon::spawn(move || {
            // Fails only for pictures of two sizes, which nobody asks for.
            if let Ok(errors) = compare(&pair.image, &pair.reference, None) {
                let numbers = Numbers { errors, flip: flip(&pair) };
                let colors = for_texture(&difference_image(&pair.image, &pair.reference));
                // One job at a time, so the channel has room; it is closed only after the window.
                done.try_send((pair, numbers, colors)).ok();
            }
            ctx.request_repaint();
        });
    }

    /// Takes a difference that was made.
    pub(super) fn poll(&mut self, ctx: &Context) {
        if let Ok((pair, numbers, colors)) = self.done.1.try_recv() {
            self.busy = false;
            self.made = Some((pair, numbers));
            match &mut self.texture {
                Some(texture) => texture.set(colors, TextureOptions::NEAREST),
                None => self.texture = Some(ctx.load_texture("difference", colors, TextureOptions::NEAREST)),
            }
        }
    }

    /// The false colours of the last difference that was made; `None` before the first.
    pub(super) fn texture(&self) -> Option<&TextureHandle> {
        self.texture.as_ref()
    }

    /// The numbers of the difference to this reference; `None` before they are known.
    pub(super) fn numbers(&self, reference: &Arc<LinearImage>) -> Option<Numbers> {
        self.made.as_ref().filter(|(pair, _)| Arc::ptr_eq(&pair.reference, reference)).map(|(_, numbers)| *numbers)
    }
}

/// The pixels of an image for a texture.
fn for_texture(image: &RgbImage) -> ColorImage {
    ColorImage::from_rgb([image.width() as usize, image.height() as usize], image)
}

#[cfg(feature = "flip")]
fn flip(Pair { image, reference, film }: &Pair) -> Option<f64> {
    use crate::film::{ToneMap, flip, mean_inside};
    let tone = ToneMap::new(film.exposure, film.tone_curve);
    Some(mean_inside(&flip(&tone.map_image(image), &tone.map_image(reference)), None))
}

#[cfg(not(feature = "flip"))]
fn flip(_: &Pair) -> Option<f64> {
    None
}
