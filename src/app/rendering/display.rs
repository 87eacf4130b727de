//! From linear light to a texture, off the UI thread. Exposure and tone curve live here and restart nothing.

use crate::film::{LinearImage, ToneMap};
use crate::scene::ToneCurve;
use crossbeam_channel::{Receiver, Sender, bounded};
use egui::{Color32, ColorImage, Context, TextureFilter, TextureHandle, TextureOptions};
use std::sync::Arc;

/// A picture and how to show it.
#[derive(Clone, Debug)]
struct Job {
    image: Arc<LinearImage>,
    exposure: f64,
    tone_curve: ToneCurve,
    /// Whether a pixel of it is a pixel of the film.
    full_size: bool,
}

/// A picture for the screen, and whether it is of the film's size.
type Pixels = (Arc<ColorImage>, bool);

/// Keeps a texture of the newest picture.
pub(crate) struct Display {
    texture: Option<TextureHandle>,
    shown: Option<Job>,
    /// The newest picture that waits for the one under work.
    waiting: Option<Job>,
    busy: bool,
    done: (Sender<Pixels>, Receiver<Pixels>),
}

impl Default for Display {
    fn default() -> Self {
        Self { texture: None, shown: None, waiting: None, busy: false, done: bounded(1) }
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
    /// The texture, once there is one.
    pub(crate) fn texture(&self) -> Option<&TextureHandle> {
        self.texture.as_ref()
    }

    /// Shows this picture as soon as it can; of several that come meanwhile, the newest.
    pub(crate) fn show(&mut self, ctx: &Context, image: &Arc<LinearImage>, film: &crate::scene::Film) {
        let full_size = (image.width, image.height) == (film.width, film.height);
        let job = Job { image: Arc::clone(image), exposure: film.exposure, tone_curve: film.tone_curve, full_size };
        if self.shown.as_ref().is_some_and(|shown| shown.same_result(&job)) {
            return;
        }
        self.shown = Some(job.clone());
        self.waiting = Some(job);
        self.start(ctx);
    }

    /// Takes what is done and starts what waits. To be called once a frame.
    pub(crate) fn poll(&mut self, ctx: &Context) {
        if let Ok((image, full_size)) = self.done.1.try_recv() {
            self.busy = false;
            self.upload(ctx, image, full_size);
        }
        self.start(ctx);
    }

    fn start(&mut self, ctx: &Context) {
        if self.busy {
            return;
        }
        let Some(job) = self.waiting.take() else { return };
        self.busy = true;
        let (done, ctx) = (self.done.0.clone(), ctx.clone());
        rayon::spawn(move || {
            // There is one job at a time, so the channel has room; it is closed only when nobody looks any more.
            if done.try_send((job.run(), job.full_size)).is_ok() {
                ctx.request_repaint();
            }
        });
    }

    fn upload(&mut self, ctx: &Context, image: Arc<ColorImage>, full_size: bool) {
        // Whole pixels are shown as they are; a draft of fewer pixels looks calmer when smoothed.
        let magnification = if full_size { TextureFilter::Nearest } else { TextureFilter::Linear };
        let options = TextureOptions { magnification, minification: TextureFilter::Linear, ..Default::default() };
        match &mut self.texture {
            Some(texture) => texture.set(image, options),
            None => self.texture = Some(ctx.load_texture("picture", image, options)),
        }
    }
}
