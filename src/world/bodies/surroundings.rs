use super::crossings::spread;
use super::{Body, Media};
use crate::geometry::Aggregate;
use crate::math::{Ray, warp};
use crate::world::Surface;
use glam::DVec3;

/// Directions in which a closed body is seen from a point: several, because a ray may slip through a seam; an odd number has a
/// middle. More would take time for each path of a light that lies partly in a body.
const VIEWS_OF_CLOSED: usize = 5;
/// Directions in which an open body is seen from a point, because the body may fill a small part of the view. Fewer may all miss it; more
/// would take time for each point.
const VIEWS_OF_OPEN: usize = 64;

/// The surfaces of a world and the bodies that they bound, as paths see them from where they begin.
#[derive(Clone, Copy)]
pub(in crate::world) struct Surroundings<'a> {
    pub(in crate::world) aggregate: &'a Aggregate,
    pub(in crate::world) surfaces: &'a [Surface],
    pub(in crate::world) bodies: &'a [Body],
}

impl Surroundings<'_> {
    /// The bodies whose inside faces the point.
    pub(in crate::world) fn media(&self, point: DVec3) -> Media {
        let mut media = Media::default();
        for (rank, body) in (0..).zip(self.bodies) {
            (0..self.depth(body, point)).for_each(|_| media.enter(rank));
        }
        media
    }

    /// How often a path from outside enters the body without leaving it on its way to the point.
    fn depth(&self, body: &Body, point: DVec3) -> usize {
        if body.is_closed && body.bounds.distance(point) > 0.0 {
            return 0;
        }
        let views = if body.is_closed { VIEWS_OF_CLOSED } else { VIEWS_OF_OPEN };
        let mut depths: Vec<i32> = (0..views).filter_map(|k| self.depth_along(body, point, k)).collect();
        depths.sort_unstable();
        let median = depths.get(depths.len() / 2).copied().unwrap_or(0);
        median.max(0) as usize
    }

    /// The depth by the view in one direction: at least 1 where the view meets an inside, at most 0 where it meets an outside; `None`
    /// where the view does not meet the body.
    fn depth_along(&self, body: &Body, point: DVec3, k: usize) -> Option<i32> {
        let ray = Ray::new(point, warp::uniform_sphere(spread(k)));
        let (mut nearest, mut depth) = ((f64::INFINITY, false), 0);
        for (t, front) in body.crossings(&ray, self.aggregate.primitives()) {
            depth += if front { -1 } else { 1 };
            if t < nearest.0 {
                nearest = (t, front);
            }
        }
        let (t, front) = nearest;
        if t == f64::INFINITY || !body.is_closed && self.is_hidden(&Ray { t_max: t, ..ray }) {
            return None;
        }
        Some(if front { depth.min(0) } else { depth.max(1) })
    }

    /// Whether an opaque surface or a light stands in the way of the ray.
    fn is_hidden(&self, ray: &Ray) -> bool {
        let mut rest = *ray;
        while let Some(hit) = self.aggregate.closest_hit(&rest) {
            if !matches!(self.surfaces[hit.primitive as usize], Surface::Object { body: Some(_), .. }) {
                return true;
            }
            rest.t_min = hit.t;
        }
        false
    }
}
