//! A small picture of a snapshot.

use super::snapshot::Snapshot;
use crate::film::ToneMap;
use crate::math::Rgb;
use crate::scene::Film;
use egui::{Color32, ColorImage};

/// Height of a thumbnail, pixels.
const HEIGHT: u32 = 72;
/// Its greatest width, pixels.
const MOST_WIDTH: u32 = 160;

/// The picture, reduced to the means of blocks, as a screen shows it with the film's exposure and tone curve.
pub(super) fn thumbnail(snapshot: &Snapshot, film: &Film) -> ColorImage {
    let image = &snapshot.image;
    let width = (HEIGHT * image.width / image.height.max(1)).clamp(1, MOST_WIDTH);
    let tone = ToneMap::new(film.exposure, film.tone_curve);
    let block = |k: u32, count: u32, of: u32| {
        let [from, to] = [k, k + 1].map(|k| (u64::from(k) * u64::from(of) / u64::from(count)) as usize);
        from..to.max(from + 1)
    };
    let pixel = |x: u32, y: u32| {
        let (columns, rows) = (block(x, width, image.width), block(y, HEIGHT, image.height));
        let count = (columns.len() * rows.len()) as f32;
        let sum: Rgb =
            rows.flat_map(|row| image.pixels[row * image.width as usize..][columns.clone()].iter()).copied().sum();
        let [red, green, blue] = tone.map(sum / count);
        Color32::from_rgb(red, green, blue)
    };
    let pixels = (0..HEIGHT).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect();
    ColorImage::new([width as usize, HEIGHT as usize], pixels)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::LinearImage;
    use crate::scene::ToneCurve;
    use std::sync::Arc;

    #[test]
    fn blocks_of_any_size_have_their_mean() {
        for (width, height) in [(1, 1), (3, 200), (400, 100), (16, 16)] {
            let image = LinearImage { width, height, pixels: vec![Rgb::X; (width * height) as usize] };
            let (name, image) = (String::new(), Arc::new(image));
            let snapshot = Snapshot { name, image, file: None, iterations: 1, seconds: None, error: None };
            let film = Film { exposure: 0.0, tone_curve: ToneCurve::Srgb, ..Film::default() };
            let small = thumbnail(&snapshot, &film);
            assert!(small.pixels.iter().all(|pixel| *pixel == Color32::RED), "{width} x {height}");
            assert!(small.size[0] >= 1 && small.size[1] == 72);
        }
    }
}
