//! How well a picture shows the caustic: its correlation with the converged picture over the pixels of the caustic.

use image::imageops::{FilterType, grayscale, resize};
use image::{GrayImage, RgbImage};
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
    without: RgbImage,
    region: Vec<bool>,
}

impl Caustic {
    pub(crate) fn render(file: &SceneFile) -> Self {
        let whole = picture(file, None);
        let caustics = picture(file, Some(Component::Caustics));
        let pairs = whole.pixels.iter().zip(&caustics.pixels);
        let region = pairs.clone().map(|(all, caustics)| sum(*caustics) > FRACTION * sum(*all)).collect();
        let rest = pairs.map(|(all, caustics)| *all - *caustics).collect();
        let shows = ToneMap::new(file.scene.film.exposure, file.scene.film.tone_curve);
        Self {
            converged: grayscale(&shown(&whole, &shows)),
            without: shown(&LinearImage { pixels: rest, ..whole.clone() }, &shows),
            region,
            shows,
        }
    }

    /// The correlation of a picture, enlarged to full size, with the converged one, over the displayed pixels of the caustic. 1
    /// means equal up to brightness and contrast.
    pub(crate) fn likeness(&self, image: &LinearImage) -> f64 {
        self.correlation(&shown(image, &self.shows))
    }

    /// The correlation of the converged picture without its caustics on a film of `width` pixels, for comparison.
    pub(crate) fn likeness_without(&self, width: u32) -> f64 {
        let height = width * self.without.height() / self.without.width();
        self.correlation(&resize(&self.without, width, height, FilterType::Triangle))
    }

    fn correlation(&self, image: &RgbImage) -> f64 {
        let (width, height) = self.converged.dimensions();
        let image = grayscale(&resize(image, width, height, FilterType::Triangle));
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

/// The picture as displayed: tone-mapped and 8 bits a channel.
fn shown(image: &LinearImage, shows: &ToneMap) -> RgbImage {
    let bytes = shows.map_image(image).into_flattened();
    RgbImage::from_raw(image.width, image.height, bytes).expect("there are three bytes a pixel")
}

/// Pearson's correlation coefficient.
fn correlation(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    let pairs: Vec<_> = pairs.collect();
    let mean = |value: fn(f64, f64) -> f64| pairs.iter().map(|(x, y)| value(*x, *y)).sum::<f64>() / pairs.len() as f64;
    let (x, y) = (mean(|x, _| x), mean(|_, y| y));
    (mean(|x, y| x * y) - x * y) / ((mean(|x, _| x * x) - x * x) * (mean(|_, y| y * y) - y * y)).sqrt()
}
