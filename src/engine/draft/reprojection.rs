//! Where the camera that has moved saw before what it sees now.

use super::grid::{Between, around};
use super::image::Draft;
use crate::transport::FirstHit;
use crate::world::Camera;
use glam::DVec2;

/// Relative difference between the depth of a point before the move and the depth seen then, up to which the point was seen. Over a pixel of
/// a draft a surface that the camera sees at a flat angle changes its depth by a few percent.
const SAME_DEPTH: f32 = 0.02;
/// Second difference of the inverse depths of neighbours, over the inverse depth, up to which they belong to one surface. Along a plane it
/// is 0.
const BENT: f32 = 0.02;

/// The move of a camera.
pub(super) struct Reprojection<'a> {
    /// The cameras with the film's grid.
    pub(super) before: Camera,
    pub(super) after: Camera,
    /// The draft before the move.
    draft: &'a Draft,
    inverse_depths: Inverse,
    /// What the pixels of the draft after the move meet first.
    after_hits: &'a [FirstHit],
    /// For each pixel of the draft after the move, whether a matte surface is all around it.
    is_matte: Vec<bool>,
}

/// Inverse depths of a draft, 1 over scene units. Between the pixels of a plane they are linear.
struct Inverse {
    size: [u32; 2],
    depths: Vec<f32>,
}

impl Inverse {
    fn of(draft: &Draft) -> Self {
        Self {
            size: draft.g_buffer.size,
            depths: draft.g_buffer.first_hits.iter().map(|hit| 1.0 / hit.depth).collect(),
        }
    }

    fn at(&self, x: f32, y: f32) -> f32 {
        Between::new(self.size, x, y).mean(|index| self.depths[index])
    }

    /// Whether the neighbours on opposite sides of a pixel lie on one surface with it.
    fn is_smooth(&self, index: usize) -> bool {
        let [width, height] = self.size.map(|count| count as usize);
        let (x, y) = (index % width, index / width);
        let straight = |step: usize, inside: bool| {
            !inside || {
                let [a, b, c] = [index - step, index, index + step].map(|index| self.depths[index]);
                (a - 2.0 * b + c).abs() <= BENT * b
            }
        };
        straight(1, x > 0 && x + 1 < width) && straight(width, y > 0 && y + 1 < height)
    }
}

impl<'a> Reprojection<'a> {
    /// The move between two cameras, of each of which there is a draft.
    pub(super) fn new([before, after]: [Camera; 2], drafts: [&'a Draft; 2]) -> Self {
        let inverse_depths = Inverse::of(drafts[1]);
        let fits = |index: usize| drafts[1].g_buffer.first_hits[index].is_matte && inverse_depths.is_smooth(index);
        let size = drafts[1].g_buffer.size;
        let is_matte = (0..drafts[1].g_buffer.first_hits.len()).map(|index| around(size, index).all(fits)).collect();
        Self { before, after, draft: drafts[0], after_hits: &drafts[1].g_buffer.first_hits, inverse_depths, is_matte }
    }

    /// The film position before the move of the point that the camera now sees at a film position; `None` where another surface may have
    /// hidden it, it was seen from its other side, or its look depends on the place from which it is seen.
    pub(super) fn before(&self, x: f32, y: f32) -> Option<[f32; 2]> {
        let scale = |position: f32, of: u32, to: u32| position * to as f32 / of as f32;
        let on_draft = |x: f32, y: f32, [width, height]: [u32; 2]| {
            (scale(x, self.after.width, width), scale(y, self.after.height, height))
        };
        let (column, row) = on_draft(x, y, self.inverse_depths.size);
        let [width, height] = self.inverse_depths.size;
        let index = (row as u32).min(height - 1) * width + (column as u32).min(width - 1);
        if !self.is_matte[index as usize] {
            return None;
        }
        let ray = self.after.ray(DVec2::new(x.into(), y.into()));
        let point = ray.at(1.0 / f64::from(self.inverse_depths.at(column, row)));
        let seen = self.before.film_position(point)?.as_vec2();
        let inside =
            seen.x >= 0.0 && seen.y >= 0.0 && seen.x < self.before.width as f32 && seen.y < self.before.height as f32;
        let distance = self.before.position.distance(point) as f32;
        let (column, row) = on_draft(seen.x, seen.y, self.draft.g_buffer.size);
        let between = Between::new(self.draft.g_buffer.size, column, row);
        let surface = |hit: &FirstHit| hit.facet.map(|facet| facet.tag);
        let seen_now = surface(&self.after_hits[index as usize]);
        let same_side =
            between.weights().iter().all(|(pixel, _)| surface(&self.draft.g_buffer.first_hits[*pixel]) == seen_now);
        let then = 1.0 / between.mean(|index| 1.0 / self.draft.g_buffer.first_hits[index].depth);
        (inside && same_side && (then - distance).abs() <= SAME_DEPTH * distance).then_some(seen.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;
    use crate::scene;
    use crate::transport::Facet;
    use glam::{DVec3, Vec3};

    /// Pixels along a side of the film, and of a draft.
    const FILM: u32 = 64;
    const SIDE: u32 = 16;

    fn camera(x: f64) -> Camera {
        let camera = scene::Camera {
            position: DVec3::new(x, 0.0, 4.0),
            target: DVec3::new(0.3, 0.2, 0.0),
            ..Default::default()
        };
        Camera::new(&camera, FILM, FILM)
    }

    /// A draft of what stands in a plane z = `z(x)` for rays that meet it at x.
    fn draft(camera: &Camera, z: impl Fn(f64) -> f64) -> Draft {
        let camera = camera.resized(SIDE, SIDE);
        let mut draft = Draft::of_pixels(SIDE, vec![Rgb::ONE; (SIDE * SIDE) as usize], 1.0, 1.0);
        for (index, hit) in (0..).zip(&mut draft.g_buffer.first_hits) {
            let ray = camera.ray(DVec2::new(f64::from(index % SIDE), f64::from(index / SIDE)) + 0.5);
            let depth = |z: f64| (z - ray.origin.z) / ray.direction.z;
            *hit = FirstHit { depth: depth(z(ray.at(depth(0.0)).x)) as f32, is_matte: true, object: None, facet: None };
        }
        draft
    }

    #[test]
    fn points_of_a_wall_are_found_where_they_were() {
        let (before, after) = (camera(0.0), camera(0.4));
        let drafts = [&before, &after].map(|camera| draft(camera, |_| 0.0));
        let reprojection = Reprojection::new([before, after], drafts.each_ref());
        for point in [DVec3::ZERO, DVec3::new(0.7, -0.3, 0.0), DVec3::new(-0.6, 0.5, 0.0)] {
            let [now, then] = [after, before].map(|camera| camera.film_position(point).unwrap().as_vec2());
            let found = reprojection.before(now.x, now.y).expect("the wall was seen");
            assert!(then.distance(found.into()) < 0.05, "{found:?} {then}");
        }
        let [x, y] = reprojection.before(63.9, 32.0).unwrap_or([f32::NAN; 2]);
        assert!(x.is_nan() || (x < 64.0 && y < 64.0), "a point that was out of view is not found");
    }

    #[test]
    fn nothing_is_found_behind_what_stood_in_front_nor_at_an_edge_nor_in_a_mirror() {
        let (before, after) = (camera(0.0), camera(0.4));
        let wall = |camera| draft(camera, |_| 0.0);
        let found = |drafts: [&Draft; 2]| Reprojection::new([before, after], drafts).before(32.0, 32.0).is_some();
        assert!(found([&wall(&before), &wall(&after)]));
        assert!(!found([&draft(&before, |_| 2.0), &wall(&after)]), "a screen hid the wall");
        let edge = draft(&after, |x| if x < 0.3 { 0.0 } else { -1.0 });
        assert!(!found([&wall(&before), &edge]));
        let other_side = Facet { normal: Vec3::Z, albedo: Rgb::ONE, tag: 8, position: Vec3::ZERO };
        let mut from_behind = wall(&after);
        from_behind.g_buffer.first_hits.iter_mut().for_each(|hit| hit.facet = Some(other_side));
        assert!(!found([&wall(&before), &from_behind]), "the other side has other light");
        let mut mirror = wall(&after);
        mirror.g_buffer.first_hits.iter_mut().for_each(|hit| hit.is_matte = false);
        assert!(!found([&wall(&before), &mirror]));
    }
}
