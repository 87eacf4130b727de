use glam::{DVec2, DVec3};
use image::{Rgb, RgbImage};

/// Sample points along each side of a pixel.
const SAMPLES: u32 = 3;

/// An sRGB picture of a linear colour over the unit square, averaged over each pixel.
pub(crate) fn paint(width: u32, height: u32, color: impl Fn(DVec2) -> DVec3) -> RgbImage {
    RgbImage::from_fn(width, height, |x, y| {
        let sum: DVec3 = samples(x, y, width, height).map(&color).sum();
        Rgb((sum / f64::from(SAMPLES * SAMPLES)).to_array().map(|c| (255.0 * srgb_from_linear(c)).round() as u8))
    })
}

/// The normal map of a height over the unit square, both in the same unit; the height must repeat.
pub(crate) fn normal_map(size: u32, height: impl Fn(DVec2) -> f64) -> RgbImage {
    let heights: Vec<f64> = (0..size * size)
        .map(|k| samples(k % size, k / size, size, size).map(&height).sum::<f64>() / f64::from(SAMPLES * SAMPLES))
        .collect();
    let at = |x: u32, y: u32| heights[((y % size) * size + x % size) as usize];
    let per_texel = 0.5 * f64::from(size);
    RgbImage::from_fn(size, size, |x, y| {
        let along_u = per_texel * (at(x + 1, y) - at(x + size - 1, y));
        let along_v = per_texel * (at(x, y + size - 1) - at(x, y + 1));
        let normal = DVec3::new(-along_u, -along_v, 1.0).normalize();
        Rgb((127.5 * (normal + 1.0)).to_array().map(|c| c.round() as u8))
    })
}

/// Points spread evenly over a pixel, in the unit square with v upwards.
fn samples(x: u32, y: u32, width: u32, height: u32) -> impl Iterator<Item = DVec2> {
    (0..SAMPLES * SAMPLES).map(move |k| {
        let inside = DVec2::new(f64::from(k % SAMPLES) + 0.5, f64::from(k / SAMPLES) + 0.5) / f64::from(SAMPLES);
        let u = (f64::from(x) + inside.x) / f64::from(width);
        let v = 1.0 - (f64::from(y) + inside.y) / f64::from(height);
        DVec2::new(u, v)
    })
}

fn srgb_from_linear(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

/// The linear colour of a colour written `0xRRGGBB` in sRGB.
pub(crate) fn hex(code: u32) -> DVec3 {
    let linear = |byte: u32| {
        let x = f64::from(byte & 255) / 255.0;
        if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
    };
    DVec3::new(linear(code >> 16), linear(code >> 8), linear(code))
}

/// 0 up to `from`, 1 beyond `to`, and smooth between.
pub(crate) fn smoothstep(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
