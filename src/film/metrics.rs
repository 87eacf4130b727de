use super::{ImageError, LinearImage, Mask};
use crate::math::Rgb;

/// Keeps the relative error of dark pixels finite: the square of a tenth of the radiance of a bright wall.
const RELATIVE_FLOOR: f64 = 0.01;

/// The fraction of the pixels over which trimmed errors are means: without the largest errors, outliers do not
/// dominate.
const TRIMMED_FRACTION: f64 = 0.999;

/// The errors of an image against its reference, over pixels and channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// The number of compared pixels.
    pub pixels: usize,
    /// `sqrt(mean((x - r)^2))`, in radiance.
    pub rmse: f64,
    /// `mean((x - r)^2 / (r^2 + 0.01))`.
    pub rel_mse: f64,
    /// [`Errors::rmse`] without the worst 0.1 % of the pixels.
    pub rmse_trimmed: f64,
    /// [`Errors::rel_mse`] without the worst 0.1 % of the pixels.
    pub rel_mse_trimmed: f64,
    /// Mean of the image over mean of the reference, for each channel: shows a bias that noise hides in the mean
    /// squared errors.
    pub mean_ratio: [f64; 3],
    /// Mean radiance of the reference, over pixels and channels.
    pub reference_mean: f64,
}

/// Compares an image with its reference, inside the mask if there is a mask. Values that are not finite make the errors
/// not finite.
///
/// # Errors
///
/// If the sizes of image, reference and mask differ.
pub fn compare(image: &LinearImage, reference: &LinearImage, mask: Option<&Mask>) -> Result<Errors, ImageError> {
    compare_with_both(image, reference, reference, mask)
}

/// Compares an image with two references of independent noise, which the errors exclude: they are means of the product
/// of both differences instead of means of squares. Means and weights use the first reference. For tiny errors noise
/// may make the mean of products negative; the RMSE is then 0.
///
/// # Errors
///
/// If the sizes of image, references and mask differ.
pub fn compare_with_both(
    image: &LinearImage,
    first: &LinearImage,
    second: &LinearImage,
    mask: Option<&Mask>,
) -> Result<Errors, ImageError> {
    let expected = (image.width, image.height);
    let same = |what, found| if found == expected { Ok(()) } else { Err(ImageError::Size { what, found, expected }) };
    same("reference", (first.width, first.height))?;
    same("second reference", (second.width, second.height))?;
    mask.map_or(Ok(()), |mask| same("mask", (mask.width, mask.height)))?;
    let counts = |k: &usize| mask.is_none_or(|mask| mask.inside[*k]);
    let pixels = (0..image.pixels.len()).filter(counts);
    Ok(errors(pixels.map(|k| [image.pixels[k], first.pixels[k], second.pixels[k]])))
}

fn errors(pixels: impl Iterator<Item = [Rgb; 3]>) -> Errors {
    let (mut squares, mut relative, mut sums) = (Vec::new(), Vec::new(), [[0.0; 3]; 2]);
    for pixel in pixels {
        let [x, r, second] = pixel.map(|rgb| rgb.to_array().map(f64::from));
        let square = |c: usize| (x[c] - r[c]) * (x[c] - second[c]);
        squares.push((0..3).map(square).sum::<f64>() / 3.0);
        relative.push((0..3).map(|c| square(c) / (r[c] * r[c] + RELATIVE_FLOOR)).sum::<f64>() / 3.0);
        for c in 0..3 {
            sums[0][c] += x[c];
            sums[1][c] += r[c];
        }
    }
    let count = squares.len() as f64;
    Errors {
        pixels: squares.len(),
        rmse: root(mean(&squares)),
        rel_mse: mean(&relative).max(0.0),
        rmse_trimmed: root(trimmed_mean(&mut squares)),
        rel_mse_trimmed: trimmed_mean(&mut relative).max(0.0),
        mean_ratio: std::array::from_fn(|c| sums[0][c] / sums[1][c]),
        reference_mean: sums[1].iter().sum::<f64>() / (3.0 * count),
    }
}

/// The mean; NaN for no values.
fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The square root; 0 for negative numbers, NaN for NaN.
fn root(square: f64) -> f64 {
    if square < 0.0 { 0.0 } else { square.sqrt() }
}

fn trimmed_mean(values: &mut [f64]) -> f64 {
    values.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    mean(&values[..(values.len() as f64 * TRIMMED_FRACTION) as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(pixels: Vec<Rgb>) -> LinearImage {
        LinearImage { width: pixels.len() as u32, height: 1, pixels }
    }

    #[test]
    fn errors_are_the_formulas() {
        let x = image(vec![Rgb::new(1.0, 2.0, 3.0), Rgb::splat(5.0)]);
        let r = image(vec![Rgb::new(1.0, 1.0, 1.0), Rgb::splat(5.0)]);
        let errors = compare(&x, &r, None).unwrap();
        assert_eq!(errors.pixels, 2);
        assert!((errors.rmse - (5f64 / 6.0).sqrt()).abs() < 1e-15);
        assert!((errors.rel_mse - 5.0 / 6.0 / 1.01).abs() < 1e-15);
        assert_eq!(errors.mean_ratio, [1.0, 7.0 / 6.0, 8.0 / 6.0]);
        let mask = Mask { width: 2, height: 1, inside: vec![false, true] };
        assert_eq!(compare(&x, &r, Some(&mask)).unwrap().rmse, 0.0);
    }

    #[test]
    fn two_references_cancel_their_noise() {
        let x = image(vec![Rgb::splat(3.0); 4]);
        // The truth is 1; the noise of the second reference does not depend on the noise of the first.
        let [first, second] = [[1.5, 1.5, 0.5, 0.5], [1.1, 0.9, 1.1, 0.9]].map(|r| image(r.map(Rgb::splat).to_vec()));
        let errors = compare_with_both(&x, &first, &second, None).unwrap();
        assert!((errors.rmse - 2.0).abs() < 1e-6, "{errors:?}");
        assert!(
            (errors.rel_mse - (1.5 / 2.26 + 2.5 / 0.26)).abs() < 1e-6,
            "the weights use the first reference: {errors:?}"
        );
        assert_eq!(errors.reference_mean, 1.0);
        let between = compare_with_both(&image(vec![Rgb::splat(0.7); 4]), &image(vec![Rgb::splat(0.6); 4]), &x, None);
        assert_eq!(between.unwrap().rmse, 0.0, "0 for the root of a negative mean");
    }

    #[test]
    fn one_pixel_in_a_thousand_is_trimmed() {
        let mut pixels = vec![Rgb::ZERO; 2000];
        let reference = image(pixels.clone());
        pixels[7] = Rgb::splat(1e6);
        pixels[8] = Rgb::splat(1e6);
        assert_eq!(compare(&image(pixels.clone()), &reference, None).unwrap().rmse_trimmed, 0.0);
        pixels[9] = Rgb::splat(1e6);
        assert!(compare(&image(pixels), &reference, None).unwrap().rmse_trimmed > 0.0);
    }

    #[test]
    fn sizes_must_agree() {
        let message = compare(&LinearImage::black(3, 2), &LinearImage::black(2, 3), None).unwrap_err().to_string();
        assert_eq!(message, "the reference has 2 x 3 pixels, the picture 3 x 2");
        let [wide, high] = [LinearImage::black(3, 2), LinearImage::black(2, 3)];
        let message = compare_with_both(&wide, &wide, &high, None).unwrap_err().to_string();
        assert_eq!(message, "the second reference has 2 x 3 pixels, the picture 3 x 2");
    }
}
