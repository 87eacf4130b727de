use super::LinearImage;
use crate::{math::Rgb, scene::ToneCurve};
use image::RgbImage;

/// Radiance below this is black in 8 bits: half a step of the sRGB curve is 1.5e-4.
const DARKEST: f32 = 1.0 / 8192.0;

/// Radiance above this is white on both curves.
const BRIGHTEST: f32 = 64.0;

/// Bits of the mantissa that index the table: its cells, 1/512 of an octave, are at most 0.17 steps of 8 bits wide.
const MANTISSA_BITS: u32 = 9;

const SHIFT: u32 = f32::MANTISSA_DIGITS - 1 - MANTISSA_BITS;

/// The map from linear radiance to sRGB: exposure and tone curve, for 8 bits in one table.
#[derive(Clone, Debug)]
pub struct ToneMap {
    gain: f32,
    curve: ToneCurve,
    table: Vec<u8>,
}

impl ToneMap {
    /// The map of an exposure in stops (each doubles the brightness) and a tone curve.
    pub fn new(exposure: f64, curve: ToneCurve) -> Self {
        let first = DARKEST.to_bits() >> SHIFT;
        let last = BRIGHTEST.to_bits() >> SHIFT;
        let middle_of_cell = |cell: u32| f32::from_bits((cell << SHIFT) | (1 << (SHIFT - 1)));
        let step = |cell: u32| (encode(middle_of_cell(cell), curve) * 255.0).round() as u8;
        Self { gain: exposure.exp2() as f32, curve, table: (first..last).map(step).collect() }
    }

    /// The 8-bit sRGB colour of a radiance. NaN is black.
    pub fn map(&self, radiance: Rgb) -> [u8; 3] {
        (radiance * self.gain).to_array().map(|x| self.look_up(x))
    }

    /// The 16-bit sRGB colour of a radiance. NaN is black.
    pub fn map_to_16_bits(&self, radiance: Rgb) -> [u16; 3] {
        // `max` returns the other operand for NaN.
        (radiance * self.gain).to_array().map(|x| (encode(x.max(0.0), self.curve) * 65535.0).round() as u16)
    }

    /// The image in 8-bit sRGB colours.
    pub fn map_image(&self, image: &LinearImage) -> RgbImage {
        RgbImage::from_fn(image.width, image.height, |x, y| {
            let index = y as usize * image.width as usize + x as usize;
            image::Rgb(self.map(image.pixels[index]))
        })
    }

    fn look_up(&self, x: f32) -> u8 {
        // Black for NaN: `max` returns the other operand.
        let x = x.max(0.0);
        if x < DARKEST {
            return 0;
        }
        let cell = (x.to_bits() >> SHIFT) - (DARKEST.to_bits() >> SHIFT);
        self.table.get(cell as usize).copied().unwrap_or(u8::MAX)
    }
}

/// The sRGB value of a radiance, from 0 to 1.
fn encode(x: f32, curve: ToneCurve) -> f32 {
    let x = match curve {
        ToneCurve::Srgb => x,
        ToneCurve::Filmic => roll_off(x),
    };
    srgb_from_linear(x.min(1.0))
}

/// Keeps radiance below the knee and lets highlights approach 1, by the curve `t / (1 + t)` \[Reinhard02\] above the knee,
/// with slope 1 there.
fn roll_off(x: f32) -> f32 {
    const KNEE: f32 = 0.5;
    let t = (x - KNEE) / (1.0 - KNEE);
    if t <= 0.0 { x } else { KNEE + (1.0 - KNEE) * t / (1.0 + t) }
}

/// The sRGB curve of IEC 61966-2-1, from 0 to 1.
fn srgb_from_linear(x: f32) -> f32 {
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_curve() {
        for curve in [ToneCurve::Srgb, ToneCurve::Filmic] {
            let tone = ToneMap::new(1.0, curve);
            for k in 0..200_000 {
                let x = 1e-6 * 1.000_1f32.powi(k);
                let exact = match curve {
                    ToneCurve::Srgb => srgb_from_linear((2.0 * x).min(1.0)),
                    ToneCurve::Filmic => srgb_from_linear(roll_off(2.0 * x).min(1.0)),
                } * 255.0;
                let shown = f32::from(tone.map(Rgb::splat(x))[1]);
                // Half a step of rounding and half a cell.
                assert!((shown - exact).abs() <= 0.5 + 0.085 + 1e-3, "{curve:?}: {x} shows {shown}, exactly {exact}");
            }
        }
    }

    #[test]
    fn odd_numbers_have_a_place() {
        let tone = ToneMap::new(0.0, ToneCurve::Srgb);
        assert_eq!(tone.map(Rgb::new(f32::NAN, f32::INFINITY, f32::NEG_INFINITY)), [0, 255, 0]);
        assert_eq!(tone.map(Rgb::new(-0.0, 1.0, f32::MIN_POSITIVE)), [0, 255, 0]);
        assert_eq!(ToneMap::new(64.0, ToneCurve::Filmic).map(Rgb::ONE), [255; 3]);
        assert_eq!(ToneMap::new(-64.0, ToneCurve::Filmic).map(Rgb::ONE), [0; 3]);
    }

    #[test]
    fn filmic_keeps_highlights_apart_and_leaves_the_dark_half() {
        let (srgb, filmic) = (ToneMap::new(0.0, ToneCurve::Srgb), ToneMap::new(0.0, ToneCurve::Filmic));
        assert_eq!(srgb.map(Rgb::splat(0.4)), filmic.map(Rgb::splat(0.4)));
        assert!(filmic.map(Rgb::splat(2.0))[0] < filmic.map(Rgb::splat(4.0))[0]);
    }
}
