//! How the screen samples the picture, by the picture's scale.

use egui::{TextureFilter, TextureOptions};

/// Scale below which the screen averages over film pixels, screen pixels per film pixel: the four neighbours of a linear
/// filter would leave out pixels.
const MINIFIED: f32 = 0.75;
/// Scale from which film pixels are shown as squares, screen pixels per film pixel.
const PIXELS: f32 = 4.0;

/// How the screen samples the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(crate) enum Sampling {
    /// Averages over several film pixels.
    Minified,
    /// Interpolates between film pixels.
    #[default]
    Smooth,
    /// Shows film pixels as squares.
    Pixels,
}

impl Sampling {
    /// The sampling at a scale in screen pixels per film pixel.
    pub(crate) fn at(scale: f32) -> Self {
        if scale < MINIFIED {
            Self::Minified
        } else if scale < PIXELS {
            Self::Smooth
        } else {
            Self::Pixels
        }
    }

    /// The options of the picture's texture. A draft with fewer pixels than the film is always interpolated, which looks
    /// calmer.
    pub(super) fn options(self, full_size: bool) -> TextureOptions {
        let squares = self == Self::Pixels && full_size;
        TextureOptions {
            magnification: if squares { TextureFilter::Nearest } else { TextureFilter::Linear },
            minification: TextureFilter::Linear,
            mipmap_mode: (self == Self::Minified).then_some(TextureFilter::Linear),
            ..TextureOptions::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_chooses_the_filter() {
        for (scale, magnification, mipmap_mode) in [
            (0.3, TextureFilter::Linear, Some(TextureFilter::Linear)),
            (1.0, TextureFilter::Linear, None),
            (3.9, TextureFilter::Linear, None),
            (4.0, TextureFilter::Nearest, None),
        ] {
            let options = Sampling::at(scale).options(true);
            assert_eq!((options.magnification, options.mipmap_mode), (magnification, mipmap_mode), "at {scale}");
        }
        assert_eq!(Sampling::at(20.0).options(false).magnification, TextureFilter::Linear, "a coarse draft");
    }
}
