use crate::math::Rgb;

/// A picture in linear Rec.709 radiance.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct LinearImage {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Row after row, the top row first: `width * height` of them.
    pub pixels: Vec<Rgb>,
}

impl LinearImage {
    /// A black picture.
    pub fn black(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![Rgb::ZERO; width as usize * height as usize] }
    }
}
