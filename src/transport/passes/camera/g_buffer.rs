//! A G-buffer \[SaitoTakahashi90\]: what the first ray of each pixel meets, without any light.

use super::first_hit::FirstHit;
use super::sampling::trace_first_rays;
use crate::transport::pass::Rows;
use crate::transport::passes::input::PassInput;

/// What the first rays of the pixels of some rows meet, pixel by pixel; `None` when cancelled.
pub fn g_buffer(input: &PassInput, rows: &Rows) -> Option<Vec<FirstHit>> {
    let PassInput { world, plan, iteration, .. } = *input;
    let width = plan.camera.width;
    let mut first_hits = Vec::with_capacity(rows.len() * width as usize);
    for row in rows.clone() {
        if input.cancel.is_cancelled() {
            return None;
        }
        let mut first_rays = trace_first_rays(input, row, 0..width).into_iter();
        first_hits.extend((0..width).map(|column| {
            let samples = plan.camera_samples(row * width + column, iteration).count();
            // All samples of the pixel, of which the first one counts.
            let first = first_rays.by_ref().take(samples).reduce(|first, _| first);
            let hit = first.and_then(|first| first.hit.map(|hit| (first.ray, hit)));
            hit.map_or(FirstHit::NONE, |(ray, hit)| FirstHit::with_surface(world, &ray, hit))
        }));
    }
    Some(first_hits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;
    use crate::transport::pass::Cancel;
    use crate::transport::passes::camera_pass;
    use crate::transport::plan::{DraftSize, Plan};
    use crate::transport::testing::{self, lamp, sphere};
    use crate::world::World;

    /// A grey ball before a background.
    fn ball() -> World {
        let film = "[film]\nwidth = 24\nheight = 20\n";
        testing::world(&[&sphere("ball", [0.0; 3], 0.7, "grey"), &lamp([1.0, 3.0, 2.0]), film].concat())
    }

    #[test]
    fn a_g_buffer_holds_what_the_camera_pass_meets_first() {
        let world = ball();
        let plan = Plan::new(&world).draft(DraftSize { coarseness: 2, thinning: 1 });
        let input = PassInput::uncancelled(&world, &plan, 1, 1);
        let alone = g_buffer(&input, &(0..10)).expect("never cancelled");
        let with_light = camera_pass(&input, &(0..10)).expect("never cancelled").first_hits;
        assert_eq!((alone.len(), with_light.len()), (120, 120));
        for (a, b) in alone.iter().zip(&with_light) {
            assert_eq!((a.depth, a.is_matte, a.facet.is_some()), (b.depth, b.is_matte, b.facet.is_some()));
            assert!(a.facet.zip(b.facet).is_none_or(|(a, b)| a.normal == b.normal && a.tag == b.tag));
        }
        let middle = alone[5 * 12 + 6].facet.expect("the ball is in the middle");
        assert!(middle.albedo == Rgb::splat(0.5) && middle.normal.z > 0.9, "{middle:?}");
        assert!(alone[0].facet.is_none() && alone[0].depth.is_infinite(), "the background");
    }

    #[test]
    fn pixels_that_are_left_out_meet_nothing() {
        let world = ball();
        let chosen = (0..24 * 20).map(|index| index % 2 == 0).collect();
        let plan = Plan::new(&world).draft(DraftSize::FULL).of_pixels(chosen);
        let input = PassInput::uncancelled(&world, &plan, 1, 1);
        let found = g_buffer(&input, &(10..11)).expect("never cancelled");
        let met: Vec<bool> = found[10..14].iter().map(|hit| hit.facet.is_some()).collect();
        assert_eq!(met, [true, false, true, false]);
        let cancelled = PassInput { cancel: Cancel::when(&|| true), ..input };
        assert!(g_buffer(&cancelled, &(0..20)).is_none());
    }
}
