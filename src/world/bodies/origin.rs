use super::crossings::spread;
use super::{Body, Media};
use crate::geometry::Aggregate;
use crate::math::{Ray, warp};
use crate::world::Surface;
use glam::DVec3;

/// Directions in which a closed body is seen from a point: one would do, were there no seams.
const VIEWS_OF_CLOSED: usize = 5;
/// Directions in which an open body is seen from a point: it may fill a small part of the view.
const VIEWS_OF_OPEN: usize = 64;

/// The surfaces of a world and the bodies that they bound, as paths see them from where they begin.
#[derive(Clone, Copy)]
pub(in crate::world) struct Surroundings<'a> {
    pub(in crate::world) aggregate: &'a Aggregate,
    pub(in crate::world) surfaces: &'a [Surface],
    pub(in crate::world) bodies: &'a [Body],
}

/// The media in which the paths of a light begin.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    /// The same everywhere on the light.
    Uniform(Media),
    /// Not the same: a part of the light is in a body of which another part is not.
    Mixed,
}

impl Surroundings<'_> {
    /// The bodies around a point: those whose surfaces, seen from the point, show their inside.
    pub(in crate::world) fn media(&self, point: DVec3) -> Media {
        let mut media = Media::default();
        for (rank, body) in (0..).zip(self.bodies) {
            (0..self.depth(body, point)).for_each(|_| media.enter(rank));
        }
        media
    }

    /// The media in which paths begin that start at these points of one light.
    pub(in crate::world) fn origin(&self, points: impl IntoIterator<Item = DVec3>) -> Origin {
        let mut points = points.into_iter();
        let first = points.next().map_or(Media::default(), |point| self.media(point));
        if points.all(|point| self.media(point) == first) { Origin::Uniform(first) } else { Origin::Mixed }
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
