//! How photons of interreflection leave a light: in all directions, or from a far light towards the scene.

use super::ProjectionMap;
use super::chart::Chart;
use super::emission::{self, Emission};
use super::rays_to_ball::{RaysToBall, fraction_of_objects, rays_to_view};
use crate::geometry::{Primitive, Sphere};
use crate::math::Sampler;
use crate::world::{Light, World};
use glam::DVec3;

/// Fraction of a light's chart that the scene fills, below which photons aim at the scene. With a larger fraction more lights would trace
/// probe rays after an edit, for less than sixteen times the photons; with a smaller one some lights would waste more than fifteen of
/// sixteen paths.
const FAR: f64 = 1.0 / 16.0;
/// Half the diagonal of a primitive's box over the distance from the light to the view, from which on photons do not aim at the primitive
/// as a whole: if it is all around, an even share of the paths brings back 1e-4 of the light that the view has straight from the lamp.
const WIDE: f64 = 100.0;
/// Where a primitive is that wide, photons also aim at a ball around the middle of the view: its radius over the distance of the camera.
/// The visible ground and its illumination lie mostly in it.
const VIEW: f64 = 2.0;

/// Rays to the objects over rays to the view of a far light from which on most photons that aim at the objects miss the view.
const SPREAD: f64 = 4.0;

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

    /// Everywhere, unless that would waste most photons: a light that is far from the view aims at the view where objects spread far beyond
    /// it; a light in whose chart the scene appears small aims at the scene.
    fn new(world: &World, light: &Light, light_index: u64) -> Self {
        let are_wide: Vec<bool> = world.aggregate.primitives().iter().map(|p| is_wide(world, light, p)).collect();
        let is_aim = |p: u32| !are_wide[p as usize];
        let has_wide = are_wide.contains(&true);
        let chart = Chart::new(light);
        let around_view = Sphere { center: world.view.center, radius: VIEW * world.view.distance };
        let by_objects = fraction_of_objects(world, light, &chart, &is_aim);
        let beyond_view = if has_wide { None } else { by_objects };
        let rays_to_view = rays_to_view(light, &chart, around_view, beyond_view, SPREAD);
        if let Some(view) = rays_to_view.filter(|rays| rays.are_few()) {
            return Self::Aimed(Box::new(ProjectionMap::build(world, light, light_index, &[view], &is_aim)));
        }
        let view = RaysToBall::new(light, &chart, around_view);
        let is_around = by_objects.is_none() || (view.is_none() && has_wide);
        let views: Vec<RaysToBall> = view.into_iter().filter(|_| has_wide).collect();
        let filled = by_objects.unwrap_or(1.0) + views.iter().map(|rays| rays.fraction_of(light)).sum::<f64>();
        if is_around || filled == 0.0 || filled > FAR {
            return Self::Everywhere;
        }
        Self::Aimed(Box::new(ProjectionMap::build(world, light, light_index, &views, &is_aim)))
    }

    /// The first ray of a path; `None` where the light does not shine in the sampled direction.
    #[inline]
    pub(in crate::transport) fn emit(&self, light: &Light, sampler: &mut Sampler) -> Option<Emission> {
        match self {
            Self::Everywhere => Some(emission::emit(light, sampler)),
            Self::Aimed(map) => map.emit(light, sampler),
        }
    }

    /// Fraction of the light's chart that the paths cover.
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
            Self::Aimed(map) => map.path_density(light, light_point, point),
        }
    }
}

/// Whether a primitive is so wide that photons do not aim at it as a whole.
fn is_wide(world: &World, light: &Light, primitive: &Primitive) -> bool {
    let distance = match light {
        // From a sun a small part of a wide object is in view, wherever the object is.
        Light::Parallel(_) => world.view.distance,
        _ => light.center().distance(world.view.center).max(world.view.distance),
    };
    matches!(primitive, Primitive::Plane(_)) || 0.5 * primitive.bounds().diagonal() >= WIDE * distance
}
