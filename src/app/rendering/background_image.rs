//! An image that another thread makes, with what it found on the way.

use crossbeam_channel::{Receiver, Sender, bounded};
use egui::{ColorImage, Context, TextureHandle, TextureOptions};

/// An image and what comes with it, as made last for a key. A new one is begun once the one before is done.
pub(crate) struct BackgroundImage<K, V> {
    made: Option<(K, V)>,
    texture: Option<TextureHandle>,
    busy: bool,
    done: Channel<Made<K, V>>,
}

type Made<K, V> = (K, ColorImage, V);
type Channel<T> = (Sender<T>, Receiver<T>);

impl<K, V> Default for BackgroundImage<K, V> {
    fn default() -> Self {
        Self { made: None, texture: None, busy: false, done: bounded(1) }
    }
}

impl<K: PartialEq + Send + 'static, V: Send + 'static> BackgroundImage<K, V> {
    /// Begins the image of this key, unless it is there or another one is being made.
    pub(crate) fn ask(&mut self, ctx: &Context, key: K, make: impl FnOnce(&K) -> (ColorImage, V) + Send + 'static) {
        if self.busy || self.made.as_ref().is_some_and(|(made, _)| *made == key) {
            return;
        }
        self.busy = true;
        let (done, ctx) = (self.done.0.clone(), ctx.clone());
        rayon::spawn(move || {
            let (image, found) = make(&key);
            // One job at a time, so the channel has room; it is closed only after the window.
            done.try_send((key, image, found)).ok();
            ctx.request_repaint();
        });
    }

    /// Takes an image that was made.
    pub(crate) fn poll(&mut self, ctx: &Context) {
        if let Ok((key, image, found)) = self.done.1.try_recv() {
            self.busy = false;
            self.made = Some((key, found));
            match &mut self.texture {
                Some(texture) => texture.set(image, TextureOptions::NEAREST),
                None => self.texture = Some(ctx.load_texture("background image", image, TextureOptions::NEAREST)),
            }
        }
    }

    /// The texture of the image that was made last; `None` before the first.
    pub(crate) fn texture(&self) -> Option<&TextureHandle> {
        self.texture.as_ref()
    }

    /// The key of the image that was made last, and what came with it; `None` before the first.
    pub(crate) fn made(&self) -> Option<(&K, &V)> {
        self.made.as_ref().map(|(key, found)| (key, found))
    }
}
