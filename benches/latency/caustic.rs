//! Whether a picture shows the caustic: how like it is, where there is a caustic, to the converged picture.

use image::imageops::{FilterType, resize};
use image::{GrayImage, RgbImage, imageops};
use patchlight::engine::Session;
use patchlight::film::{LinearImage, ToneMap};
use patchlight::math::Rgb;
use patchlight::scene::SceneFile;
use patchlight::transport::{Cancel, Component};

/// So many take the picture near enough to the true one.
const ITERATIONS: u64 = 8;
/// There is a caustic where it brings more than this part of the light,
const SHARE: f32 = 0.1;
/// and so many pixels around, for its edge is what it is known by.
const MARGIN: usize = 4;

/// The converged picture of a scene, and where it has a caustic.
pub(crate) struct Caustic {
    shows: ToneMap,
    converged: GrayImage,
    without: GrayImage,
    region: Vec<bool>,
}

impl Caustic {
    pub(crate) fn render(file: &SceneFile) -> Self {
        let whole = picture(file, None);
        let caustics = picture(file, Some(Component::Caustics));
        let pairs = whole.pixels.iter().zip(&caustics.pixels);
        let is_lit: Vec<bool> = pairs.clone().map(|(all, part)| sum(*part) > SHARE * sum(*all)).collect();
        let rest = pairs.map(|(all, part)| *all - *part).collect();
        let shows = ToneMap::new(file.scene.film.exposure, file.scene.film.tone_curve);
        Self {
            converged: shown(&whole, &shows),
            without: shown(&LinearImage { pixels: rest, ..whole.clone() }, &shows),
            region: enlarged(&is_lit, whole.width as usize),
            shows,
        }
    }

    /// The correlation of a picture, enlarged to full size, with the converged one, of what the screen shows there: 1 is the
    /// same but for brightness and contrast.
    pub(crate) fn likeness(&self, image: &LinearImage) -> f64 {
        let (width, height) = self.converged.dimensions();
        self.correlation(&resize(&shown(image, &self.shows), width, height, FilterType::Triangle))
    }

    /// The same of the converged picture without its caustics, for comparison.
    pub(crate) fn likeness_without(&self) -> f64 {
        self.correlation(&self.without)
    }

    fn correlation(&self, image: &GrayImage) -> f64 {
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

/// What the screen shows, without colour.
fn shown(image: &LinearImage, shows: &ToneMap) -> GrayImage {
    let bytes = shows.map_image(image).into_flattened();
    imageops::grayscale(&RgbImage::from_raw(image.width, image.height, bytes).expect("there are three bytes a pixel"))
}

/// With the pixels around.
fn enlarged(region: &[bool], width: usize) -> Vec<bool> {
    let (columns, rows) = (width, region.len() / width);
    let near = |k: usize, end: usize| k.saturating_sub(MARGIN)..(k + MARGIN + 1).min(end);
    let any = |x: usize, y: usize| near(y, rows).any(|y| near(x, columns).any(|x| region[y * width + x]));
    (0..region.len()).map(|k| any(k % width, k / width)).collect()
}

/// Pearson's coefficient.
fn correlation(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    let pairs: Vec<_> = pairs.collect();
    let mean = |value: fn(f64, f64) -> f64| pairs.iter().map(|(x, y)| value(*x, *y)).sum::<f64>() / pairs.len() as f64;
    let (x, y) = (mean(|x, _| x), mean(|_, y| y));
    (mean(|x, y| x * y) - x * y) / ((mean(|x, _| x * x) - x * x) * (mean(|_, y| y * y) - y * y)).sqrt()
}
