//! What a screen shows, and how far it is from the converged picture.

use image::RgbImage;
use image::imageops::{FilterType, resize};
use patchlight::engine::Session;
use patchlight::film::{LinearImage, ToneMap, flip, mean_inside};
use patchlight::scene::SceneFile;
use patchlight::transport::Cancel;
use std::time::{Duration, Instant};

/// The converged picture of a scene, and how a screen shows it.
pub(crate) struct Screen {
    tone: ToneMap,
    converged: RgbImage,
    mean: f64,
}

/// How far what the screen shows is from the converged picture.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Distance {
    /// The mean FLIP.
    pub(crate) flip: f64,
    /// The root mean square of the differences between displayed values, from 0 to 1.
    pub(crate) rmse: f64,
    /// Mean radiance over that of the converged picture.
    pub(crate) brightness: f64,
}

impl Screen {
    /// Renders a scene for this time.
    pub(crate) fn converged(file: &SceneFile, time: Duration) -> Self {
        let tone = ToneMap::new(file.scene.film.exposure, file.scene.film.tone_curve);
        let mut session = Session::prepare(file, 2, None).expect("the scene can be prepared");
        let start = Instant::now();
        while start.elapsed() < time {
            session.advance(Cancel::NEVER);
        }
        let image = session.frame(0).image;
        Self { converged: tone.map_image(&image), mean: mean(&image), tone }
    }

    /// The distance of a picture, which the screen enlarges to the film's size.
    pub(crate) fn distance(&self, image: &LinearImage) -> Distance {
        let (width, height) = self.converged.dimensions();
        let shown = resize(&self.tone.map_image(image), width, height, FilterType::Triangle);
        let squares =
            shown.iter().zip(self.converged.iter()).map(|(x, y)| ((f64::from(*x) - f64::from(*y)) / 255.0).powi(2));
        let rmse = (squares.sum::<f64>() / self.converged.len() as f64).sqrt();
        let flip = mean_inside(&flip(&shown, &self.converged), None);
        Distance { flip, rmse, brightness: mean(image) / self.mean }
    }
}

fn mean(image: &LinearImage) -> f64 {
    image.pixels.iter().map(|pixel| f64::from(pixel.element_sum())).sum::<f64>() / image.pixels.len() as f64
}
