//! The difference of two pictures, in false colours and in numbers, made by another thread.

use crate::app::rendering::BackgroundImage;
use crate::film::{Errors, LinearImage, compare, difference_image};
use crate::scene::Film;
use egui::{ColorImage, Context, TextureHandle};
use std::sync::Arc;

/// What is compared: two pictures of one size.
struct Pair {
    image: Arc<LinearImage>,
    reference: Arc<LinearImage>,
    /// Exposure and tone curve, for FLIP.
    film: Film,
}

impl PartialEq for Pair {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.image, &other.image)
            && Arc::ptr_eq(&self.reference, &other.reference)
            && (self.film.exposure, self.film.tone_curve) == (other.film.exposure, other.film.tone_curve)
    }
}

/// Numbers of a difference.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbers {
    pub(super) errors: Errors,
    /// Mean perceived difference; `None` without the feature `flip`.
    pub(super) flip: Option<f64>,
}

/// The difference of the two pictures that were asked for last.
#[derive(Default)]
pub(super) struct Difference {
    image: BackgroundImage<Pair, Option<Numbers>>,
}

impl Difference {
    /// Asks for the difference of two pictures of one size, with the exposure and the tone curve of a film.
    pub(super) fn ask(&mut self, ctx: &Context, image: &Arc<LinearImage>, reference: &Arc<LinearImage>, film: &Film) {
        let pair = Pair { image: Arc::clone(image), reference: Arc::clone(reference), film: *film };
        self.image.ask(ctx, pair, |pair| {
            let colors = difference_image(&pair.image, &pair.reference);
            let size = [colors.width() as usize, colors.height() as usize];
            // Fails only for pictures of two sizes, which nobody asks for.
            let errors = compare(&pair.image, &pair.reference, None).ok();
            (ColorImage::from_rgb(size, &colors), errors.map(|errors| Numbers { errors, flip: flip(pair) }))
        });
    }

    /// Takes a difference that was made.
    pub(super) fn poll(&mut self, ctx: &Context) {
        self.image.poll(ctx);
    }

    /// The false colours of the last difference that was made; `None` before the first.
    pub(super) fn texture(&self) -> Option<&TextureHandle> {
        self.image.texture()
    }

    /// The numbers of the difference to this reference; `None` before they are known.
    pub(super) fn numbers(&self, reference: &Arc<LinearImage>) -> Option<Numbers> {
        self.image.made().filter(|(pair, _)| Arc::ptr_eq(&pair.reference, reference)).and_then(|(_, numbers)| *numbers)
    }
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
