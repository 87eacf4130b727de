//! How much of a light matters for what the camera sees: nothing of a lamp in a closed room next door, say. Told by a few
//! paths from the light; what they missed is found later all the same, by the fewer paths and shadow rays that such a light
//! still gets.

use super::emission;
use super::photon_pass;
use crate::geometry::Primitive;
use crate::math::{Ray, Sampler, Stream};
use crate::world::World;
use glam::DVec3;
use rayon::prelude::*;

/// Paths from a light; fewer where there are many lights.
const PATHS: u64 = 256;
const LEAST_PATHS: u64 = 16;
const PATHS_OF_ALL: u64 = 16_384;
/// Of shadow rays that would go to a light, this part goes where no light from it was seen.
const UNSEEN_PART: f64 = 0.125;
/// None seen that matters does not mean none there: as if so many were.
const UNSEEN_PATHS: f64 = 0.0625;
/// Mirrors and the like that are looked into at most.
const MOST_MIRRORS: usize = 8;

/// What a light does for a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relevance {
    /// Part of the points that ask for its direct light.
    pub asked: f64,
    /// Part of its paths that leave light where the camera may see it, directly or in mirrors; not 0.
    pub of_paths: f64,
}

impl Relevance {
    /// All of it matters.
    const FULL: Self = Self { asked: 1.0, of_paths: 1.0 };

    /// That of each light. There is nothing to choose from where there is only one.
    pub(super) fn of_lights(world: &World) -> Vec<Self> {
        if world.lights.len() < 2 {
            return vec![Self::FULL; world.lights.len()];
        }
        let mirrors = mirrors_in_view(world);
        let paths = (PATHS_OF_ALL / world.lights.len() as u64).clamp(LEAST_PATHS, PATHS);
        (0..world.lights.len()).into_par_iter().map(|light| Self::of(world, light, paths, &mirrors)).collect()
    }

    fn of(world: &World, light: usize, paths: u64, mirrors: &[u32]) -> Self {
        let (mut lights_directly, mut matters) = (0, 0);
        for index in 0..paths {
            let sampler = Sampler::new(0, Stream::Probe, !(light as u64), index);
            let is_seen = |position| may_be_seen(world, position, mirrors);
            let is_lit = emission::first_hit(world, light, &mut sampler.clone()).is_some_and(is_seen);
            let photons = photon_pass::one_path(world, light, sampler);
            lights_directly += u64::from(is_lit);
            matters += u64::from(is_lit || photons.into_iter().any(is_seen));
        }
        let of_paths = (matters as f64 + UNSEEN_PATHS) / (paths as f64 + UNSEEN_PATHS);
        Self { asked: if lights_directly > 0 { 1.0 } else { UNSEEN_PART }, of_paths }
    }
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

/// Whether the camera sees a point, or one of the mirrors does.
fn may_be_seen(world: &World, position: DVec3, mirrors: &[u32]) -> bool {
    let eye = world.camera.position;
    let directly =
        || world.camera.project(position).is_some() && !world.aggregate.occluded(&Ray::between(position, eye));
    let in_mirror = |mirror: &u32| {
        let primitive = &world.aggregate.primitives()[*mirror as usize];
        let middle = primitive.bounds().center();
        let towards = Ray { t_max: f64::INFINITY, ..Ray::between(position, middle) };
        matches!(primitive, Primitive::Plane(_))
            || world.aggregate.closest_hit(&towards).is_some_and(|hit| shows_others(world, hit.primitive))
    };
    directly() || mirrors.iter().any(in_mirror)
}
