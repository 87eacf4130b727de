//! How photons of interreflection leave a light: in all directions, or from a far light towards the scene.

use super::ProjectionMap;
use super::cone::{Cone, cones_of_objects};
use super::emission::{self, Emission};
use crate::geometry::Primitive;
use crate::math::Sampler;
use crate::world::{Light, World};
use glam::{DVec2, DVec3};

/// Fraction of a light's sphere of directions that the scene fills, below which photons aim at the scene.
const FAR: f64 = 1.0 / 16.0;
/// Where the ground is unbounded, photons also aim at a ball around the point that the camera looks at: its radius over the distance of
/// the camera. The ground that the camera sees, and what lights it, is mostly in it.
const VIEW: f64 = 2.0;

/// The first rays of a light's photon paths.
#[derive(Clone, Debug)]
pub enum PhotonEmission {
    /// In proportion to the light's emission.
    Everywhere,
    /// Towards the surfaces of the scene.
    Aimed(Box<ProjectionMap>),
}

impl PhotonEmission {
    /// The emission of each light of a world.
    pub(in crate::transport) fn of_lights(world: &World) -> Vec<Self> {
        (0..).zip(&world.lights).map(|(index, light)| Self::new(world, light, index)).collect()
    }

    fn new(world: &World, light: &Light, light_index: u64) -> Self {
        let has_plane = world.aggregate.primitives().iter().any(|p| matches!(p, Primitive::Plane(_)));
        let is_bounded = |p: u32| !matches!(world.aggregate.primitives()[p as usize], Primitive::Plane(_));
        let cones: Option<Vec<Cone>> = cones_of_objects(world, light, &is_bounded).into_values().collect();
        let view = if has_plane { view_cone(world, light) } else { Some(None) };
        let (Some(cones), Some(view)) = (cones, view) else { return Self::Everywhere };
        let filled: f64 = cones.iter().chain(&view).map(Cone::fraction_of_sphere).sum();
        if filled == 0.0 || filled > FAR {
            return Self::Everywhere;
        }
        Self::Aimed(Box::new(ProjectionMap::build(world, light, light_index, view, &is_bounded)))
    }

    /// The first ray of a path; `None` where the light does not shine in the sampled direction.
    #[inline]
    pub(in crate::transport) fn emit(&self, light: &Light, sampler: &mut Sampler) -> Option<Emission> {
        match self {
            Self::Everywhere => Some(emission::emit(light, sampler)),
            Self::Aimed(map) => map.emit(light, sampler),
        }
    }

    /// Fraction of the sphere of directions that the paths share.
    pub(in crate::transport) fn aimed_fraction(&self) -> f64 {
        match self {
            Self::Everywhere => 1.0,
            Self::Aimed(map) => map.aimed_fraction(),
        }
    }

    /// Density of the paths that leave this point of a light, per area across them at `point`, scene units.
    #[inline]
    pub(in crate::transport) fn density(&self, light: &Light, light_point: DVec3, point: DVec3) -> f64 {
        match self {
            Self::Everywhere => emission::density(light, light_point, point),
            Self::Aimed(map) => {
                let offset = point - light_point;
                map.pdf(offset.normalize_or(DVec3::Z)) / offset.length_squared()
            }
        }
    }
}

/// The cone in which the light sees what the camera looks at; `None` if that surrounds the light.
fn view_cone(world: &World, light: &Light) -> Option<Option<Cone>> {
    let ray = world.camera.ray(0.5 * DVec2::new(world.camera.width.into(), world.camera.height.into()));
    let distance = world.aggregate.closest_hit(&ray).map_or(world.view.distance, |hit| hit.t);
    Cone::around(ray.at(distance) - light.center(), VIEW * distance + light.bounding_radius()).map(Some)
}
