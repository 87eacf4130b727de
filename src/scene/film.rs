use serde::{Deserialize, Serialize};

/// The size of the image, and how it is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film {
    /// Pixels per row, 1 to 16384.
    pub width: u32,
    /// Rows of pixels, 1 to 16384.
    pub height: u32,
    /// Exposure in stops, for the screen and PNG files.
    pub exposure: f64,
    /// The tone curve, for the screen and PNG files.
    pub tone_curve: ToneCurve,
}

impl Film {
    /// Most pixels along a side.
    pub const MOST_PIXELS: u32 = 16384;
    /// Largest exposure in either direction, stops.
    pub const MOST_EXPOSURE: f64 = 64.0;
}

impl Default for Film {
    fn default() -> Self {
        Self { width: 512, height: 512, exposure: 0.0, tone_curve: ToneCurve::Srgb }
    }
}

/// The map from linear radiance to display values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum ToneCurve {
    /// The sRGB transfer function; clips at 1.
    #[default]
    Srgb,
    /// The sRGB transfer function with a shoulder that compresses highlights.
    Filmic,
}
