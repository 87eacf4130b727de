//! Which parts of a pixel show a surface.

use super::input::PassInput;
use crate::geometry::Hit;
use crate::math::{LANES, Ray, Stream};
use crate::transport::photons::photon;
use crate::transport::points::VisiblePoint;
use crate::world::Surface;
use arrayvec::ArrayVec;
use glam::{UVec2, Vec2};

/// Most parts along a pixel's side.
const MOST_EACH_WAY: u32 = 8;
/// Most parts of a pixel.
pub(super) const MOST: usize = (MOST_EACH_WAY * MOST_EACH_WAY) as usize;

/// The parts of a pixel, a grid of `count` along each side, that show the side of a surface on which a directly seen point lies.
pub(super) struct VisibleParts {
    pub(super) count: u32,
    /// The middle of each part that does, from 0 to 1 each way.
    pub(super) middles: ArrayVec<Vec2, MOST>,
}

impl VisibleParts {
    /// One ray through each part tells, through a random place of it: where an edge divides a part, the rays of many iterations show the
    /// surface as often as the part does.
    pub(super) fn of_point(input: &PassInput, point: &VisiblePoint, count: u32) -> Self {
        let camera = &input.plan.camera;
        let count = count.clamp(1, MOST_EACH_WAY);
        let corner = UVec2::new(point.pixel % camera.width, point.pixel / camera.width).as_dvec2();
        let within = input.sampler(Stream::VisibleParts, u64::from(point.pixel), input.iteration).next_2d();
        let part = |k: u32| UVec2::new(k % count, k / count);
        let ray = |k: u32| camera.ray(corner + (part(k).as_dvec2() + within) / f64::from(count));
        let middle = |k: u32| (part(k).as_vec2() + 0.5) / count as f32;
        let mut middles = ArrayVec::new();
        for first in (0..count * count).step_by(LANES) {
            let rays = std::array::from_fn(|k| ray((first + k as u32).min(count * count - 1)));
            let hits = input.world.aggregate.closest_hits(&rays);
            let shows = |ray: &Ray, hit: Hit| tag_at(input, ray, hit) == Some(point.tag);
            let found = (first..count * count).zip(rays.iter().zip(hits));
            middles
                .extend(found.filter(|(_, (ray, hit))| hit.is_some_and(|hit| shows(ray, hit))).map(|(k, _)| middle(k)));
        }
        if middles.is_empty() {
            // The point itself is seen, on a part of which too little shows for these rays.
            middles.push(((point.in_pixel * count as f32).floor() + 0.5) / count as f32);
        }
        Self { count, middles }
    }

    /// Whether all of the pixel shows the surface.
    pub(super) fn is_whole(&self) -> bool {
        self.middles.len() == (self.count * self.count) as usize
    }
}

/// The side of an object's surface that a ray met, as the tag of light there has it; `None` at a lamp.
fn tag_at(input: &PassInput, ray: &Ray, hit: Hit) -> Option<u32> {
    let hit = input.world.on_opaque(ray, hit);
    let Surface::Object { front_side, .. } = input.world.surfaces[hit.primitive as usize] else { return None };
    let is_back = !input.world.surface_point(ray, hit).front;
    Some(photon::tag(front_side ^ u32::from(is_back), 0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::plan::Plan;
    use crate::transport::testing::{self, quad, visible_point};
    use crate::world::World;
    use glam::DVec3;

    /// A wall that ends at this fraction of a film of a single pixel, before another one.
    fn walls(end: f64) -> World {
        // The camera at distance 4 sees 40 degrees of it.
        let end = (2.0 * end - 1.0) * 4.0 * 20f64.to_radians().tan();
        let near = quad("near", [[-9.0, -9.0, 0.0], [9.0 + end, 0.0, 0.0], [0.0, 18.0, 0.0]], "grey");
        let far = quad("far", [[-9.0, -9.0, -1.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0]], "grey");
        testing::world(&["[film]\nwidth = 1\nheight = 1\n", &near, &far].concat())
    }

    /// A point of the near wall.
    fn point(world: &World) -> VisiblePoint {
        let vertex = testing::vertex(world, &Ray::new(DVec3::new(-5.0, 0.0, 1.0), DVec3::NEG_Z));
        VisiblePoint { pixel: 0, in_pixel: Vec2::new(0.15, 0.35), tag: photon::tag(vertex.side, 0), ..visible_point() }
    }

    fn parts(end: f64, iteration: u64) -> VisibleParts {
        let world = walls(end);
        let plan = Plan::new(&world);
        VisibleParts::of_point(&PassInput::uncancelled(&world, &plan, 1, iteration), &point(&world), 4)
    }

    #[test]
    fn parts_before_the_edge_show_the_surface() {
        assert!(parts(1.2, 1).is_whole());
        let half = parts(0.5, 1);
        assert!(!half.is_whole() && half.middles.len() == 8 && half.middles.iter().all(|middle| middle.x < 0.5));
        // No ray meets the near wall; the point that asks lies on it.
        assert_eq!(parts(-0.2, 1).middles.as_slice(), [Vec2::new(0.125, 0.375)]);
    }

    /// The edge lies at 0.55 of the pixel: it leaves a fifth of the third column of parts.
    #[test]
    fn a_divided_part_shows_the_surface_as_often_as_it_is_covered() {
        let counts = (0..256).map(|iteration| parts(0.55, iteration).middles.len());
        let mean = counts.sum::<usize>() as f64 / 256.0;
        assert!((mean / 16.0 - 0.55).abs() < 0.005, "{mean}");
    }
}
