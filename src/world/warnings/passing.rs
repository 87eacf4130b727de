//! Rays that pass some primitives.

use crate::math::Ray;
use crate::world::World;

/// The nearest primitive that a ray hits and that is not passed, and whether the ray comes from its front; `None` for a miss. The ray goes
/// straight on through primitives that are passed, but not through primitives that coincide with them.
pub(super) fn nearest_except(world: &World, ray: &Ray, is_passed: impl Fn(u32) -> bool) -> Option<(u32, bool)> {
    let mut rest = *ray;
    loop {
        let hit = world.aggregate.closest_hit(&rest)?;
        let point = world.surface_point(&rest, hit);
        if !is_passed(hit.primitive) {
            return Some((hit.primitive, point.front));
        }
        let mut coincident = world.contacts.of(hit.primitive).iter().filter(|&&other| !is_passed(other));
        if let Some((touched, normal)) = coincident.find_map(|&other| world.touching(other, &point)) {
            return Some((touched.primitive, normal.dot(ray.direction) < 0.0));
        }
        rest.t_min = hit.t;
    }
}
