//! The FLIP metric: the perceived difference when flipping between two images \[Andersson20\].

use super::Mask;
use image::RgbImage;
use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8};

/// For each pixel, the perceived difference of two displayed images of the same size, from 0 to 1.
pub fn flip(image: &RgbImage, reference: &RgbImage) -> Vec<f32> {
    let shown = |image: &RgbImage| FlipImageRgb8::with_data(image.width(), image.height(), image);
    nv_flip::flip(shown(reference), shown(image), DEFAULT_PIXELS_PER_DEGREE).to_vec()
}

/// The mean of per-pixel values over the pixels inside the mask; NaN for an empty mask.
pub fn mean_inside(differences: &[f32], mask: Option<&Mask>) -> f64 {
    let counts = |k: usize| mask.is_none_or(|mask| mask.inside[k]);
    let counting = differences.iter().enumerate().filter(|(k, _)| counts(*k));
    let (sum, count) = counting.fold((0.0, 0), |(sum, count), (_, x)| (sum + f64::from(*x), count + 1));
    sum / f64::from(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn equal_images_differ_by_0_and_black_from_white_by_1() {
        let [black, gray, white] = [0, 124, 255].map(|value| RgbImage::from_pixel(32, 32, image::Rgb([value; 3])));
        assert_eq!(mean_inside(&flip(&gray, &gray), None), 0.0);
        let most = mean_inside(&flip(&black, &white), None);
        assert!(most > 0.95, "{most}");
        let some = mean_inside(&flip(&gray, &white), None);
        assert!(0.1 < some && some < most, "{some}");
    }

    #[test]
    fn only_pixels_inside_count() {
        let mask = Mask { width: 2, height: 1, inside: vec![false, true] };
        assert_eq!(mean_inside(&[1.0, 0.25], Some(&mask)), 0.25);
        assert!(mean_inside(&[], None).is_nan());
    }
}
