/// The picture's size and how it is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film {
    /// Pixels, 1 to 16384.
    pub width: u32,
    /// Pixels, 1 to 16384.
    pub height: u32,
    /// Stops; for the screen and PNG only.
    pub exposure: f64,
    /// For the screen and PNG only.
    pub tone_curve: ToneCurve,
}

impl Default for Film {
    fn default() -> Self {
        Self { width: 512, height: 512, exposure: 0.0, tone_curve: ToneCurve::Srgb }
    }
}

/// How linear radiance becomes what a screen shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ToneCurve {
    /// The sRGB curve; clips at 1.
    #[default]
    Srgb,
    /// Rolls highlights off.
    Filmic,
}
