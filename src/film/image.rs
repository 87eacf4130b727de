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
    /// A black image.
    pub fn black(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![Rgb::ZERO; width as usize * height as usize] }
    }
}
