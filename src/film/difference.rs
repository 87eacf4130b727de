//! The difference of two pictures in false colours.

use super::LinearImage;
use crate::math::Rgb;
use image::RgbImage;

/// Relative difference of luminance that has the full colour.
pub const FULL_DIFFERENCE: f32 = 0.25;
/// Luminance that is added to that of the reference, over its mean: in nearly black pixels a ratio means nothing.
const FLOOR: f32 = 0.05;
/// The colours of darker, equal and brighter pixels: blue, pale, red.
const COLORS: [[u8; 3]; 3] = [[20, 70, 200], [236, 236, 228], [205, 40, 20]];

/// The relative difference of the luminance of each pixel: blue where the image is darker than the reference, which has the same size, red
/// where it is brighter.
pub fn difference_image(image: &LinearImage, reference: &LinearImage) -> RgbImage {
    let mean = reference.pixels.iter().map(luminance).sum::<f32>() / reference.pixels.len() as f32;
    RgbImage::from_fn(image.width, image.height, |x, y| {
        let index = y as usize * image.width as usize + x as usize;
        let [a, b] = [image, reference].map(|image| luminance(&image.pixels[index]));
        image::Rgb(difference_color((a - b) / (b + FLOOR * mean).max(f32::MIN_POSITIVE) / FULL_DIFFERENCE))
    })
}

/// The colour of a difference, from -1 to 1. NaN counts as none.
pub fn difference_color(difference: f32) -> [u8; 3] {
    let [negative, none, positive] = COLORS;
    let side = if difference < 0.0 { negative } else { positive };
    let part = if difference.is_nan() { 0.0 } else { difference.abs().min(1.0) };
    std::array::from_fn(|k| (f32::from(none[k]) + part * (f32::from(side[k]) - f32::from(none[k]))).round() as u8)
}

/// Luminance of linear sRGB, in the units of the radiance (IEC 61966-2-1).
fn luminance(radiance: &Rgb) -> f32 {
    radiance.dot(Rgb::new(0.2126, 0.7152, 0.0722))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn darker_is_blue_brighter_is_red_and_equal_is_pale() {
        let image = |value: f32| LinearImage { width: 1, height: 1, pixels: vec![Rgb::splat(value)] };
        let shown = |value: f32| difference_image(&image(value), &image(1.0)).get_pixel(0, 0).0;
        assert_eq!([shown(0.5), shown(1.0), shown(2.0)], COLORS);
        let slightly = shown(1.05)[1];
        assert!(slightly < COLORS[1][1] && slightly > COLORS[2][1], "{slightly}");
        assert_eq!(difference_image(&image(0.0), &image(0.0)).get_pixel(0, 0).0, COLORS[1], "two black pictures");
        assert_eq!(difference_color(f32::NAN), COLORS[1]);
    }
}
