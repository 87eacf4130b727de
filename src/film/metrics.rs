use super::{ImageError, LinearImage, Mask};
use crate::math::Rgb;

/// Keeps the relative error of dark pixels finite; the square of a tenth of the radiance of a bright wall.
const RELATIVE_FLOOR: f64 = 0.01;

/// Part of the pixels that the trimmed errors keep, the best ones: outliers should not decide.
const TRIMMED_PART: f64 = 0.999;

/// How far a picture is from its reference, over pixels and channels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Pixels that counted.
    pub pixels: usize,
    /// `sqrt(mean((x - r)^2))`, in radiance.
    pub rmse: f64,
    /// `mean((x - r)^2 / (r^2 + 0.01))`.
    pub rel_mse: f64,
    /// [`Errors::rmse`] without the worst 0.1 % of the pixels.
    pub rmse_trimmed: f64,
    /// [`Errors::rel_mse`] without the worst 0.1 % of the pixels.
    pub rel_mse_trimmed: f64,
    /// Mean of the picture over mean of the reference: a bias shows here that noise hides elsewhere.
    pub mean_ratio: [f64; 3],
    /// Mean radiance of the reference over pixels and channels.
    pub reference_mean: f64,
}

/// Compares a picture with its reference, inside the mask where there is one.
///
/// Fails when the sizes differ. Values that are not finite make the errors so.
pub fn compare(image: &LinearImage, reference: &LinearImage, mask: Option<&Mask>) -> Result<Errors, ImageError> {
    let expected = (image.width, image.height);
    let same = |what, found| if found == expected { Ok(()) } else { Err(ImageError::Size { what, found, expected }) };
    same("reference", (reference.width, reference.height))?;
    mask.map_or(Ok(()), |mask| same("mask", (mask.width, mask.height)))?;
    let counts = |k: usize| mask.is_none_or(|mask| mask.inside[k]);
    let pairs = image.pixels.iter().zip(&reference.pixels).enumerate().filter(|(k, _)| counts(*k));
    Ok(errors(pairs.map(|(_, (x, r))| (*x, *r))))
}

fn errors(pairs: impl Iterator<Item = (Rgb, Rgb)>) -> Errors {
    let (mut squares, mut relative, mut sums) = (Vec::new(), Vec::new(), [[0.0; 3]; 2]);
    for (x, r) in pairs {
        let (x, r) = (x.to_array().map(f64::from), r.to_array().map(f64::from));
        let square = |c: usize| (x[c] - r[c]).powi(2);
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
        rmse: mean(&squares).sqrt(),
        rel_mse: mean(&relative),
        rmse_trimmed: trimmed_mean(&mut squares).sqrt(),
        rel_mse_trimmed: trimmed_mean(&mut relative),
        mean_ratio: std::array::from_fn(|c| sums[0][c] / sums[1][c]),
        reference_mean: sums[1].iter().sum::<f64>() / (3.0 * count),
    }
}

/// The mean; not a number where there is none.
fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn trimmed_mean(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    mean(&values[..(values.len() as f64 * TRIMMED_PART) as usize])
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
        assert_eq!(message, "the reference has 2 x 3 pixels, the image 3 x 2");
    }
}
