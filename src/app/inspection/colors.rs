//! False colours and isolines of numbers; albedo and normals as colours.

use super::field::Field;
use crate::app::commands::PictureView;
use crate::app::theme::overlay;
use crate::engine::GBuffer;
use crate::film::ToneMap;
use crate::math::Rgb;
use crate::scene::ToneCurve;
use colorous::VIRIDIS;
use egui::{Color32, ColorImage};

/// Isolines between 0 and the greatest number of the scale.
pub(super) const LINES: u32 = 10;
/// Part of the numbers that the scale holds: a lamp's highlight would leave all else dark.
const SHOWN: f64 = 0.99;

/// The end of the scale from 0: a round number (1, 2 or 5 times a power of ten) that all but the greatest numbers lie below.
pub(super) fn scale_of(field: &Field) -> f32 {
    let mut values: Vec<f32> = field.values.iter().copied().filter(|value| value.is_finite()).collect();
    if values.is_empty() {
        return 1.0;
    }
    let index = ((values.len() - 1) as f64 * SHOWN) as usize;
    let (_, most, _) = values.select_nth_unstable_by(index, f32::total_cmp);
    round_up(*most)
}

fn round_up(value: f32) -> f32 {
    if !(value > f32::MIN_POSITIVE) {
        return 1.0;
    }
    let power = 10f32.powf(value.log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|step| step * power).into_iter().find(|step| *step >= value * 0.999_99).unwrap_or(value)
}

/// The colour of a part of the scale, from 0 to 1.
pub(super) fn color(part: f32) -> Color32 {
    let colorous::Color { r, g, b } = VIRIDIS.eval_continuous(f64::from(part.clamp(0.0, 1.0)));
    Color32::from_rgb(r, g, b)
}

/// The numbers in false colours, with isolines where a neighbour of the same object lies beyond the next line.
pub(super) fn false_colors(field: &Field, scale: f32) -> ColorImage {
    let step = scale / LINES as f32;
    let line = |index: usize| (field.values[index] / step).floor();
    let crosses = |index: usize, other: Option<usize>| {
        other.is_some_and(|other| {
            let is_one_surface = field.objects[index] == field.objects[other];
            is_one_surface && field.values[other].is_finite() && line(other) != line(index)
        })
    };
    let pixel = |index: usize| {
        let value = field.values[index];
        if !value.is_finite() {
            return overlay::NO_VALUE;
        }
        let right = (index % field.width + 1 < field.width).then_some(index + 1);
        let below = (index + field.width < field.values.len()).then_some(index + field.width);
        let color = color(value / scale);
        if crosses(index, right) || crosses(index, below) { color.lerp_to_gamma(Color32::BLACK, 0.55) } else { color }
    };
    ColorImage::new([field.width, field.height], (0..field.values.len()).map(pixel).collect())
}

/// The albedo or the normals of what a G-buffer holds.
pub(super) fn surfaces(view: PictureView, g_buffer: &GBuffer) -> ColorImage {
    let tone = ToneMap::new(0.0, ToneCurve::Srgb);
    let rgb = |[red, green, blue]: [u8; 3]| Color32::from_rgb(red, green, blue);
    let pixel = |hit: &crate::transport::FirstHit| match (hit.facet, view) {
        (None, _) => overlay::NO_VALUE,
        (Some(facet), PictureView::Albedo) => rgb(tone.map(facet.albedo)),
        (Some(facet), _) => {
            let Rgb { x, y, z } = 127.5 * (facet.normal + Rgb::ONE);
            rgb([x, y, z].map(|channel| channel.round() as u8))
        }
    };
    let pixels = g_buffer.first_hits.iter().map(pixel).collect();
    ColorImage::new(g_buffer.size.map(|side| side as usize), pixels)
}

#[cfg(test)]
mod tests {
    use super::super::field::tests::field;
    use super::*;

    #[test]
    fn the_scale_ends_at_a_round_number_above_nearly_all() {
        for (value, end) in [(0.9, 1.0), (1.0, 1.0), (1.2, 2.0), (30.0, 50.0), (0.0007, 0.001), (0.0, 1.0)] {
            assert!((round_up(value) / end - 1.0).abs() < 1e-5, "{value}: {}", round_up(value));
        }
        let mut values = vec![1.5; 1000];
        values[3] = 1e9;
        values[4] = f32::NAN;
        assert_eq!(scale_of(&field(10, values)), 2.0);
        assert_eq!(scale_of(&field(1, vec![f32::NAN])), 1.0);
    }

    #[test]
    fn isolines_lie_where_the_numbers_cross_them() {
        let ramp: Vec<f32> = (0..100).map(|x| x as f32 / 100.0).collect();
        let colors = false_colors(&field(100, ramp), 1.0);
        let is_line = |x: usize| colors.pixels[x] != color(x as f32 / 100.0);
        let lines: Vec<usize> = (0..100).filter(|x| is_line(*x)).collect();
        assert_eq!(lines.len(), 9, "{lines:?}");
        assert!(lines.iter().zip(1..).all(|(x, k)| x.abs_diff(10 * k) <= 1), "{lines:?}");
        assert_eq!(false_colors(&field(1, vec![f32::NAN]), 1.0).pixels, [overlay::NO_VALUE]);
    }
}
