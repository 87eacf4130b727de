//! Tone mapping of linear images to a texture, off the UI thread. Exposure and tone curve restart no rendering.

use super::sampling::Sampling;
use crate::film::{LinearImage, ToneMap};
use crate::scene::ToneCurve;
use crossbeam_channel::{Receiver, Sender, bounded};
use egui::{Color32, ColorImage, Context, TextureHandle};
use std::sync::Arc;

/// A linear image with its display settings.
#[derive(Clone, Debug)]
struct Job {
    image: Arc<LinearImage>,
    exposure: f64,
    tone_curve: ToneCurve,
    /// Whether the image has the film's resolution; a draft may have fewer pixels.
    full_size: bool,
}

/// A tone-mapped image, and whether it has the film's resolution.
type Pixels = (Arc<ColorImage>, bool);

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

    fn run(&self) -> Arc<ColorImage> {
        let size = [self.image.width as usize, self.image.height as usize];
        let tone = ToneMap::new(self.exposure, self.tone_curve);
        let pixels = self.image.pixels.iter().map(|radiance| {
            let [red, green, blue] = tone.map(*radiance);
            Color32::from_rgb(red, green, blue)
        });
        Arc::new(ColorImage::new(size, pixels.collect()))
    }
}

impl Display {
    /// The texture; `None` before the first picture.
    pub(crate) fn texture(&self) -> Option<&TextureHandle> {
        self.texture.as_ref()
    }

    /// Whether the texture shows the newest requested image.
    pub(crate) fn is_up_to_date(&self) -> bool {
        !self.busy && self.waiting.is_none()
    }

    /// Requests a texture of this image. While a job is busy, a newer request replaces a waiting one.
    pub(crate) fn show(&mut self, ctx: &Context, image: &Arc<LinearImage>, film: &crate::scene::Film) {
        let full_size = (image.width, image.height) == (film.width, film.height);
        let job = Job { image: Arc::clone(image), exposure: film.exposure, tone_curve: film.tone_curve, full_size };
        if self.requested.as_ref().is_some_and(|requested| requested.same_result(&job)) {
            return;
        }
        self.requested = Some(job.clone());
        self.waiting = Some(job);
        self.start(ctx);
    }

    /// Uploads a finished image and starts the waiting job. Call it once per frame.
    pub(crate) fn poll(&mut self, ctx: &Context) {
        if let Ok(pixels) = self.done.1.try_recv() {
            self.busy = false;
            self.shown = Some(pixels);
            self.upload(ctx);
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
            if done.try_send((job.run(), job.full_size)).is_ok() {
                ctx.request_repaint();
            }
        });
    }

    fn upload(&mut self, ctx: &Context) {
        let Some((image, full_size)) = self.shown.clone() else { return };
        let options = self.sampling.options(full_size);
        match &mut self.texture {
            Some(texture) => texture.set(image, options),
            None => self.texture = Some(ctx.load_texture("picture", image, options)),
        }
    }
}
