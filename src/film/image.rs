use crate::math::Rgb;

/// An image of radiance, in linear Rec.709 RGB.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct LinearImage {
    /// Pixels per row.
    pub width: u32,
    /// Rows of pixels.
    pub height: u32,
    /// The `width * height` pixels, row by row from the top.
    pub pixels: Vec<Rgb>,
}

impl LinearImage {
    /// The image of these pixels, row by row from the top. Density estimates may be negative, so that their mean over iterations is not
    /// biased; radiance is not: a picture shows the positive part of the mean, which is nowhere farther from the truth.
    pub fn positive_part(width: u32, height: u32, pixels: impl IntoIterator<Item = Rgb>) -> Self {
        Self { width, height, pixels: pixels.into_iter().map(|pixel| pixel.max(Rgb::ZERO)).collect() }
    }

    /// A black image.
    pub fn black(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![Rgb::ZERO; width as usize * height as usize] }
    }
}
