//! Tone mapping of linear images to a texture. Exposure and tone curve restart no rendering.

use super::sampling::Sampling;
use crate::film::{LinearImage, ToneMap};
use crate::scene::ToneCurve;
use crossbeam_channel::{Receiver, Sender, bounded};
use egui::{Color32, ColorImage, Context, TextureHandle};
use std::sync::Arc;

/// The most pixels that the window's thread maps itself, in about a millisecond: the frame that gets them shows them. Other threads map
/// larger images, for a later frame.
const AT_ONCE: usize = 512 * 512;

/// A linear image with its display settings.
#[derive(Clone, Debug)]
struct Job {
    /// Numbers jobs in their order.
    number: u64,
    image: Arc<LinearImage>,
    exposure: f64,
    tone_curve: ToneCurve,
    /// Whether the image has the film's resolution; a draft may have fewer pixels.
    full_size: bool,
}

/// A tone-mapped image.
#[derive(Clone, Debug)]
struct Pixels {
    image: Arc<ColorImage>,
    /// The number of the job.
    number: u64,
    /// Whether the image has the film's resolution.
    full_size: bool,
}

/// The texture of the newest picture.
pub(crate) struct Display {
    texture: Option<TextureHandle>,
    /// The image in the texture, for a change of the sampling.
    shown: Option<Pixels>,
    sampling: Sampling,
    requested: Option<Job>,
    /// The newest image, which waits until the current job is done.
    waiting: Option<Job>,
    busy: bool,
    done: (Sender<Pixels>, Receiver<Pixels>),
}

impl Default for Display {
    fn default() -> Self {
        Self {
            texture: None,
            shown: None,
            sampling: Sampling::default(),
            requested: None,
            waiting: None,
            busy: false,
            done: bounded(1),
        }
    }
}

impl Job {
    fn same_result(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.image, &other.image) && self.exposure == other.exposure && self.tone_curve == other.tone_curve
    }

    fn run(&self) -> Pixels {
        let size = [self.image.width as usize, self.image.height as usize];
        let tone = ToneMap::new(self.exposure, self.tone_curve);
        let pixels = self.image.pixels.iter().map(|radiance| {
            let [red, green, blue] = tone.map(*radiance);
            Color32::from_rgb(red, green, blue)
        });
        let image = Arc::new(ColorImage::new(size, pixels.collect()));
        Pixels { image, number: self.number, full_size: self.full_size }
    }
}

impl Display {
    /// The texture; `None` before the first picture.
    pub(crate) fn texture(&self) -> Option<&TextureHandle> {
        self.texture.as_ref()
    }

    /// The tone-mapped picture in the texture; `None` before the first.
    pub(crate) fn picture(&self) -> Option<&Arc<ColorImage>> {
        self.shown.as_ref().map(|shown| &shown.image)
    }

    /// Whether the texture shows the newest requested image.
    pub(crate) fn is_up_to_date(&self) -> bool {
        self.requested.as_ref().map(|job| job.number) == self.shown.as_ref().map(|shown| shown.number)
    }

    /// Shows an image of few pixels at once, and requests a texture of a larger one. While a job is busy, a newer request replaces a waiting
    /// one.
    pub(crate) fn show(&mut self, ctx: &Context, image: &Arc<LinearImage>, film: &crate::scene::Film) {
        let full_size = (image.width, image.height) == (film.width, film.height);
        let number = self.requested.as_ref().map_or(1, |requested| requested.number + 1);
        let (image, exposure, tone_curve) = (Arc::clone(image), film.exposure, film.tone_curve);
        let job = Job { number, image, exposure, tone_curve, full_size };
        if self.requested.as_ref().is_some_and(|requested| requested.same_result(&job)) {
            return;
        }
        self.requested = Some(job.clone());
        if job.image.pixels.len() <= AT_ONCE {
            self.waiting = None;
            self.take(ctx, job.run());
        } else {
            self.waiting = Some(job);
            self.start(ctx);
        }
    }

    /// Shows these pixels, unless newer ones are shown.
    fn take(&mut self, ctx: &Context, pixels: Pixels) {
        if self.shown.as_ref().is_none_or(|shown| shown.number < pixels.number) {
            self.shown = Some(pixels);
            self.upload(ctx);
        }
    }

    /// Uploads a finished image and starts the waiting job. Call it once per frame.
    pub(crate) fn poll(&mut self, ctx: &Context) {
        if let Ok(pixels) = self.done.1.try_recv() {
            self.busy = false;
            self.take(ctx, pixels);
        }
        self.start(ctx);
    }

    /// How the texture is sampled.
    #[cfg(test)]
    pub(crate) fn sampling(&self) -> Sampling {
        self.sampling
    }

    /// Samples the texture in this way from now on.
    pub(crate) fn sample(&mut self, ctx: &Context, sampling: Sampling) {
        if self.sampling != sampling {
            self.sampling = sampling;
            self.upload(ctx);
        }
    }

    fn start(&mut self, ctx: &Context) {
        if self.busy {
            return;
        }
        let Some(job) = self.waiting.take() else { return };
        self.busy = true;
        let (done, ctx) = (self.done.0.clone(), ctx.clone());
        rayon::spawn(move || {
            // One job runs at a time, so the channel has room; it is closed only after the window.
            if done.try_send(job.run()).is_ok() {
                ctx.request_repaint();
            }
        });
    }

    fn upload(&mut self, ctx: &Context) {
        let Some(Pixels { image, full_size, .. }) = self.shown.clone() else { return };
        let options = self.sampling.options(full_size);
        match &mut self.texture {
            Some(texture) => texture.set(image, options),
            None => self.texture = Some(ctx.load_texture("picture", image, options)),
        }
    }
}
