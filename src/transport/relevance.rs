//! How much of a light's paths matters for what the camera sees: little of those of a lamp in a closed room next door. Told
//! by a few of them; what they missed is found later all the same, by the fewer paths that such a light still gets.

use super::photon_pass;
use crate::geometry::Primitive;
use crate::math::{Ray, Sampler, Stream};
use crate::world::World;
use glam::{DVec3, dvec3};
use rayon::prelude::*;

/// Paths from a light; fewer where there are many lights.
const PATHS: u64 = 256;
const LEAST_PATHS: u64 = 16;
const PATHS_OF_ALL: u64 = 16_384;
/// None seen that matters does not mean none there: as if so many were.
const UNSEEN_PATHS: f64 = 0.0625;
/// Mirrors and the like that are looked into at most.
const MOST_MIRRORS: usize = 8;

/// For each light the part of its paths that leave light where the camera may see it, directly or in mirrors; not 0. There is
/// nothing to choose from where there is only one light.
pub(super) fn of_lights(world: &World) -> Vec<f64> {
    let count = world.lights.len();
    if count < 2 {
        return vec![1.0; count];
    }
    let mirrors = mirrors_in_view(world);
    let paths = (PATHS_OF_ALL / count as u64).clamp(LEAST_PATHS, PATHS);
    (0..count).into_par_iter().map(|light| of_light(world, light, paths, &mirrors)).collect()
}

fn of_light(world: &World, light: usize, paths: u64, mirrors: &[u32]) -> f64 {
    let matters = |index: &u64| {
        let sampler = |sequence| Sampler::new(0, Stream::Probe, sequence, *index);
        let light_sequence = 2 * (world.lights.len() + light) as u64;
        let mut targets = sampler(light_sequence + 1);
        let photons = photon_pass::one_path(world, light, sampler(light_sequence));
        photons.into_iter().any(|position| may_be_seen(world, position, mirrors, &mut targets))
    };
    let seen = (0..paths).filter(matters).count();
    (seen as f64 + UNSEEN_PATHS) / (paths as f64 + UNSEEN_PATHS)
}

/// Some of the primitives in view that show what is elsewhere.
fn mirrors_in_view(world: &World) -> Vec<u32> {
    let all = (0..world.surfaces.len() as u32).filter(|&p| shows_others(world, p) && world.may_be_in_view(p));
    let all: Vec<u32> = all.collect();
    let step = all.len().div_ceil(MOST_MIRRORS).max(1);
    all.into_iter().step_by(step).collect()
}

fn shows_others(world: &World, primitive: u32) -> bool {
    world.is_specular(primitive) || world.is_glossy(primitive)
}

/// Whether the camera sees a point, or a mirror does, as far as a ray to some point of it tells.
fn may_be_seen(world: &World, position: DVec3, mirrors: &[u32], targets: &mut Sampler) -> bool {
    let eye = world.camera.position;
    let directly =
        || world.camera.project(position).is_some() && !world.aggregate.occluded(&Ray::between(position, eye));
    let mut in_mirror = |mirror: &u32| {
        let primitive = &world.aggregate.primitives()[*mirror as usize];
        let bounds = primitive.bounds();
        let within = dvec3(targets.next_1d(), targets.next_1d(), targets.next_1d());
        let target = bounds.min + within * bounds.size();
        let towards = Ray { t_max: f64::INFINITY, ..Ray::between(position, target) };
        matches!(primitive, Primitive::Plane(_))
            || world.aggregate.closest_hit(&towards).is_some_and(|hit| shows_others(world, hit.primitive))
    };
    directly() || mirrors.iter().any(&mut in_mirror)
}
