//! How well a picture shows the caustic: its correlation with the converged picture over the pixels of the caustic.

use image::GrayImage;
use image::imageops::{FilterType, grayscale, resize};
use patchlight::engine::Session;
use patchlight::film::{LinearImage, ToneMap};
use patchlight::math::Rgb;
use patchlight::scene::SceneFile;
use patchlight::transport::{Cancel, Component};

/// Iterations of the converged picture.
const ITERATIONS: u64 = 8;
/// A pixel belongs to the caustic when mirrors and glass bring more than this fraction of its light. A lower fraction would take in
/// most pixels, since a polished wall reflects a little light everywhere; textures and shadows, which pictures without a caustic
/// show as well, would then dominate the correlation.
const FRACTION: f32 = 0.3;

/// The converged picture of a scene and the pixels of its caustic.
pub(crate) struct Caustic {
    shows: ToneMap,
    converged: GrayImage,
    region: Vec<bool>,
}

impl Caustic {
    /// `None` for a scene without caustics.
    pub(crate) fn render(file: &SceneFile) -> Option<Self> {
        let whole = picture(file, None);
        let caustics = picture(file, Some(Component::Caustics));
        let pairs = whole.pixels.iter().zip(&caustics.pixels);
        let region: Vec<bool> = pairs.map(|(all, caustics)| sum(*caustics) > FRACTION * sum(*all)).collect();
        let shows = ToneMap::new(file.scene.film.exposure, file.scene.film.tone_curve);
        let converged = grayscale(&shows.map_image(&whole));
        region.contains(&true).then_some(Self { converged, region, shows })
    }

    /// The correlation of a picture, enlarged to full size, with the converged one, over the displayed pixels of the caustic. 1
    /// means equal up to brightness and contrast.
    pub(crate) fn likeness(&self, image: &LinearImage) -> f64 {
        let (width, height) = self.converged.dimensions();
        let image = grayscale(&resize(&self.shows.map_image(image), width, height, FilterType::Triangle));
        let pairs = image.iter().zip(self.converged.iter()).zip(&self.region).filter(|(_, inside)| **inside);
        correlation(pairs.map(|((x, y), _)| (f64::from(*x), f64::from(*y))))
    }
}

fn picture(file: &SceneFile, component: Option<Component>) -> LinearImage {
    let mut session = Session::prepare(file, 1, None).expect("the scene can be prepared").only(component);
    while session.iterations() < ITERATIONS {
        session.advance(Cancel::NEVER);
    }
    session.frame(0).image.as_ref().clone()
}

fn sum(pixel: Rgb) -> f32 {
    pixel.to_array().iter().sum()
}

/// Pearson's correlation coefficient.
fn correlation(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    let pairs: Vec<_> = pairs.collect();
    let mean = |value: fn(f64, f64) -> f64| pairs.iter().map(|(x, y)| value(*x, *y)).sum::<f64>() / pairs.len() as f64;
    let (x, y) = (mean(|x, _| x), mean(|_, y| y));
    (mean(|x, y| x * y) - x * y) / ((mean(|x, _| x * x) - x * x) * (mean(|_, y| y * y) - y * y)).sqrt()
}
