//! Curvature as a colour.

use super::choice::Shading;
use crate::app::theme::overlay;
use crate::geometry::bezier::Derivatives;
use egui::{Color32, lerp};

/// The share of the surface whose curvature lies within the scale; the rest has the colours of its ends.
const WITHIN: f64 = 0.95;

/// Rounding of coordinates makes the normal of a flat surface turn by less than this, radians.
const FLAT: f64 = 1e-9;

/// The curvature at a point of a surface in world space, with respect to the outside of a surface; `None` for stripes, and where the
/// surface has no normal.
pub(super) fn value(shading: Shading, derivatives: &Derivatives, is_mirrored: bool) -> Option<f64> {
    let curvature = derivatives.curvature()?;
    match shading {
        Shading::MeanCurvature => Some(if is_mirrored { -curvature.mean } else { curvature.mean }),
        Shading::GaussianCurvature => Some(curvature.gaussian),
        Shading::Zebra => None,
    }
}

/// The end of the scale for these curvatures: 1, 2 or 5 times a power of ten. For a surface of this size that is flat but for rounding
/// it is 1.
pub(super) fn scale(shading: Shading, mut values: Vec<f64>, size: f64) -> f64 {
    values.iter_mut().for_each(|value| *value = value.abs());
    values.retain(|value| value.is_finite());
    let index = ((WITHIN * values.len() as f64) as usize).min(values.len().saturating_sub(1));
    if values.is_empty() {
        return 1.0;
    }
    let (_, &mut end, _) = values.select_nth_unstable_by(index, f64::total_cmp);
    // The bending over the whole surface: the turn of the normal, or its square.
    let bending = end * if shading == Shading::GaussianCurvature { size * size } else { size };
    if bending > FLAT { rounded_up(end) } else { 1.0 }
}

/// 1, 2 or 5 times a power of ten.
fn rounded_up(number: f64) -> f64 {
    let power = 10_f64.powf(number.log10().floor());
    // Rounding must not lift 2 to 5.
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    let round = steps.into_iter().find(|step| number <= step * (1.0 + 1e-12)).unwrap_or(number);
    // The number with one digit, for the legend: 2e-5, not 2.0000000000000002e-5.
    format!("{round:.0e}").parse().unwrap_or(round)
}

/// The colour of a curvature, from -1 to 1 of the scale.
pub(super) fn color(value: f64) -> Color32 {
    let [negative, flat, positive] = overlay::CURVATURE;
    let end = if value < 0.0 { negative } else { positive };
    let amount = (value.abs().min(1.0)) as f32;
    let channel = |flat: u8, end: u8| lerp(f32::from(flat)..=f32::from(end), amount).round() as u8;
    Color32::from_rgb(channel(flat.r(), end.r()), channel(flat.g(), end.g()), channel(flat.b(), end.b()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_a_round_number_that_outliers_do_not_stretch() {
        let scale = |values: Vec<f64>| scale(Shading::MeanCurvature, values, 1.0);
        assert_eq!(scale(vec![]), 1.0);
        assert_eq!(scale(vec![1e-14; 9]), 1.0, "a flat surface");
        assert_eq!(scale(vec![-3.2; 100]), 5.0);
        assert_eq!(scale(vec![0.02; 100]), 0.02);
        assert_eq!(scale(vec![1.1e-5; 100]).to_string(), "0.00002");
        assert_eq!(super::scale(Shading::MeanCurvature, vec![1e-12; 9], 1e10), 1e-12, "a ball as large as a planet");
        let outliers = (0..100).map(|k| if k < 96 { 0.7 } else { f64::from(k) * 1e6 });
        assert_eq!(scale(outliers.chain([f64::INFINITY]).collect()), 1.0);
    }

    #[test]
    fn the_ends_of_the_scale_have_its_colours() {
        let [negative, flat, positive] = overlay::CURVATURE;
        assert_eq!([-7.0, -1.0, 0.0, 1.0, 3.0].map(color), [negative, negative, flat, positive, positive]);
    }
}
