//! Opaque surfaces that enclose a point, as a ball or a closed box of quads around a lamp.

use super::passing::nearest_except;
use crate::math::{Ray, Rgb, warp};
use crate::world::World;
use crate::world::bodies::{Body, spread};
use glam::DVec3;

/// Rays from a point that find what is around it. With fewer, an opening of a few percent of the view would pass; more would take time
/// after each edit.
const VIEWS: usize = 64;

/// What encloses a point.
pub(super) struct Enclosure {
    /// The opaque objects around the point.
    pub(super) objects: Vec<u32>,
    surfaces: Body,
}

impl Enclosure {
    /// The objects that are seen from the point, if they close it in; `None` if it has a view into the open or they have gaps.
    pub(super) fn around(world: &World, point: DVec3) -> Option<Self> {
        let is_clear = |p: u32| world.object_of(p).is_none() || world.body_of(p).is_some();
        let seen = |k: usize| {
            let ray = Ray::new(point, warp::uniform_sphere(spread(k)));
            nearest_except(world, &ray, is_clear).and_then(|(primitive, _)| world.object_of(primitive))
        };
        let mut objects = (0..VIEWS).map(seen).collect::<Option<Vec<u32>>>()?;
        objects.sort_unstable();
        objects.dedup();
        let mut surfaces = Body::new(String::new(), 1.0, Rgb::ZERO);
        let primitives = world.aggregate.primitives();
        for p in 0..primitives.len() as u32 {
            if world.object_of(p).is_some_and(|object| objects.binary_search(&object).is_ok()) {
                surfaces.add(p, &primitives[p as usize]);
            }
        }
        let is_closed = surfaces.bounds.min.is_finite() && !surfaces.has_gaps(primitives);
        is_closed.then_some(Self { objects, surfaces })
    }

    /// Whether the enclosure holds this point, too.
    pub(super) fn contains(&self, world: &World, point: DVec3) -> bool {
        self.surfaces.contains(point, world.aggregate.primitives())
    }
}
