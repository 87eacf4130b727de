//! Cones of directions in which a light sees objects.

use super::small_targets::Target;
use crate::geometry::Primitive;
use crate::math::Aabb;
use crate::world::{Light, World};
use glam::DVec3;
use std::collections::BTreeMap;

/// A function that tells whether photons are to reach a primitive.
pub(super) trait Aim: Fn(u32) -> bool + Sync {}
impl<F: Fn(u32) -> bool + Sync> Aim for F {}

/// A cone of directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    /// The unit axis.
    pub(super) direction: DVec3,
    /// Half the angle, radians.
    pub(super) radius: f64,
}

impl Cone {
    /// The cone in which a ball appears at this offset; `None` from inside of it.
    pub(super) fn around(offset: DVec3, radius: f64) -> Option<Self> {
        let sine = radius / offset.length();
        (sine < 1.0).then(|| Self { direction: offset.normalize(), radius: sine.asin() })
    }

    /// The solid angle over that of the sphere.
    pub(super) fn fraction_of_sphere(&self) -> f64 {
        (0.5 * self.radius).sin().powi(2)
    }

    /// The cone as a target without a share of the paths yet.
    pub(super) fn target(&self) -> Target {
        Target { direction: self.direction, radius: self.radius, share: 0.0 }
    }
}

/// The cones in which objects with surfaces to reach appear from all points of the light; `None` for an object around the light.
pub(super) fn cones_of_objects(world: &World, light: &Light, aim: &impl Aim) -> BTreeMap<u32, Option<Cone>> {
    let mut bounds = BTreeMap::<u32, Aabb>::new();
    for (p, primitive) in (0..).zip(world.aggregate.primitives()) {
        if let Some(object) = world.object_of(p).filter(|_| aim(p)) {
            let unbounded = Aabb { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
            let of_primitive = if matches!(primitive, Primitive::Plane(_)) { unbounded } else { primitive.bounds() };
            let of_object = bounds.entry(object).or_insert(Aabb::EMPTY);
            *of_object = of_object.union(&of_primitive);
        }
    }
    let cone = |bounds: &Aabb| {
        Cone::around(bounds.center() - light.center(), 0.5 * bounds.diagonal() + light.bounding_radius())
    };
    bounds.iter().map(|(&object, bounds)| (object, cone(bounds))).collect()
}
