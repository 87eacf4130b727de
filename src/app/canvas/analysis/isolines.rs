//! Lines of constant u and v.

use super::raster::Fragment;
use glam::Vec2;

/// Steps of a parameter between its lines, over a patch.
const STEPS: f32 = 4.0;
/// Half the width of a line, pixels.
const HALF_WIDTH: f32 = 0.8;
/// Half the width of the line along an edge of a patch, pixels.
const HALF_WIDTH_OF_EDGE: f32 = 1.5;

/// The part of a pixel that lines of constant u or v cover, from 0 to 1; each line is wider by `margin` pixels on both sides.
pub(super) fn coverage(fragment: &Fragment, margin: f32) -> f32 {
    let [right, down] = fragment.gradients;
    let of_u = along(fragment.uv.x, Vec2::new(right.x, down.x), margin);
    let of_v = along(fragment.uv.y, Vec2::new(right.y, down.y), margin);
    of_u.max(of_v)
}

/// The coverage by the lines of one parameter with its change per pixel.
fn along(parameter: f32, gradient: Vec2, margin: f32) -> f32 {
    let nearest = (STEPS * parameter).round() / STEPS;
    let half_width = if nearest <= 0.0 || nearest >= 1.0 { HALF_WIDTH_OF_EDGE } else { HALF_WIDTH };
    let distance = (parameter - nearest).abs() / gradient.length().max(f32::MIN_POSITIVE);
    let covered = (half_width + margin + 0.5 - distance).clamp(0.0, 1.0);
    // Lines nearer to each other than some pixels would fill the surface.
    let spacing = 1.0 / (STEPS * gradient.length()).max(f32::MIN_POSITIVE);
    covered * ((spacing - 4.0) / 4.0).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(u: f32, v: f32, change: f32) -> f32 {
        let gradients = [Vec2::new(change, 0.0), Vec2::new(0.0, change)];
        coverage(&Fragment { patch: 0, uv: Vec2::new(u, v), gradients }, 0.0)
    }

    #[test]
    fn lines_lie_at_quarters_and_edges_are_wider() {
        for u in [0.0, 0.25, 0.5, 0.75, 1.0] {
            assert_eq!((at(u, 0.6, 0.005), at(0.6, u, 0.005)), (1.0, 1.0), "{u}");
        }
        assert_eq!(at(0.6, 0.4, 0.005), 0.0, "between the lines");
        assert!(at(0.007, 0.4, 0.005) > at(0.257, 0.4, 0.005), "1.4 pixels from an edge and from a line");
        assert_eq!(at(0.5, 0.5, 0.1), 0.0, "lines 2.5 pixels apart");
    }
}
