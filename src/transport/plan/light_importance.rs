//! Importance of lights: the fraction of a light's photon paths that reach a surface in view, low for a lamp in a closed room next
//! door. A few probe paths estimate it. The picture stays unbiased, because a light of low importance still emits some paths.

use crate::geometry::Primitive;
use crate::math::{Ray, Sampler, Stream};
use crate::transport::lights::PhotonEmission;
use crate::transport::photons::global_tracer::arrivals_of_path;
use crate::world::World;
use glam::{DVec3, dvec3};
use rayon::prelude::*;

/// Most probe paths of a light: its importance has a standard error of 0.03 at most, and its number of paths follows the root of the
/// importance. More paths delay the first picture after each edit.
const PATHS: u64 = 256;
/// Least probe paths of a light: fewer would often miss that a light is in view, more would take long for thousands of lights.
const LEAST_PATHS: u64 = 16;
/// Most probe paths of all lights together, a few milliseconds of the time after an edit. With fewer, already tens of lights have to share
/// the probe paths.
const PATHS_OF_ALL: u64 = 16_384;
/// Added to the number of paths that matter, so that the importance is never 0 by chance: a light of which no probe path was seen emits a
/// few hundredths of the paths of a light in view. A larger value wastes paths; with a smaller one, each of the few paths brings so much
/// flux that it shows as a speckle.
const UNSEEN_PATHS: f64 = 0.0625;
/// Most mirrors, glasses and glossy surfaces in which a probe path may be seen. Each takes a ray at each vertex of a probe path; with fewer,
/// a light that is seen only in a mirror between the chosen ones counts as out of view.
const MOST_MIRRORS: usize = 8;

/// The fraction of each light's paths that arrive where the camera may see them, directly or in mirrors; above 0. Always 1 for a single
/// light.
pub(super) fn of_lights(world: &World, emissions: &[PhotonEmission]) -> Vec<f64> {
    let count = world.lights.len();
    if count < 2 {
        return vec![1.0; count];
    }
    let mirrors = mirrors_in_view(world);
    let paths = (PATHS_OF_ALL / count as u64).clamp(LEAST_PATHS, PATHS);
    (0..count).into_par_iter().map(|light| of_light(world, emissions, light, paths, &mirrors)).collect()
}

fn of_light(world: &World, emissions: &[PhotonEmission], light: usize, paths: u64, mirrors: &[u32]) -> f64 {
    let matters = |index: &u64| {
        let sampler = |sequence| Sampler::new(0, Stream::Probe, sequence, *index);
        let light_sequence = 2 * (world.lights.len() + light) as u64;
        let mut targets = sampler(light_sequence + 1);
        let arrivals = arrivals_of_path(world, emissions, light, sampler(light_sequence));
        arrivals.into_iter().any(|position| may_be_seen(world, position, mirrors, &mut targets))
    };
    let seen = (0..paths).filter(matters).count();
    (seen as f64 + UNSEEN_PATHS) / (paths as f64 + UNSEEN_PATHS)
}

/// Up to [`MOST_MIRRORS`] primitives in view that mirror, refract or have a Phong lobe.
fn mirrors_in_view(world: &World) -> Vec<u32> {
    let all = (0..world.surfaces.len() as u32).filter(|&p| is_mirror_like(world, p) && world.may_be_in_view(p));
    let all: Vec<u32> = all.collect();
    let step = all.len().div_ceil(MOST_MIRRORS).max(1);
    all.into_iter().step_by(step).collect()
}

fn is_mirror_like(world: &World, primitive: u32) -> bool {
    world.is_specular(primitive) || world.is_glossy(primitive)
}

/// Whether the camera sees a point, or a ray from the point to a random position on one of the mirrors meets a mirror.
fn may_be_seen(world: &World, position: DVec3, mirrors: &[u32], targets: &mut Sampler) -> bool {
    let camera = world.camera.position;
    let directly =
        || world.camera.project(position).is_some() && !world.aggregate.occluded(&Ray::between(position, camera));
    let mut in_mirror = |mirror: &u32| {
        let primitive = &world.aggregate.primitives()[*mirror as usize];
        let bounds = primitive.bounds();
        let within = dvec3(targets.next_1d(), targets.next_1d(), targets.next_1d());
        let target = bounds.min + within * bounds.size();
        let towards = Ray { t_max: f64::INFINITY, ..Ray::between(position, target) };
        matches!(primitive, Primitive::Plane(_))
            || world.aggregate.closest_hit(&towards).is_some_and(|hit| is_mirror_like(world, hit.primitive))
    };
    directly() || mirrors.iter().any(&mut in_mirror)
}
