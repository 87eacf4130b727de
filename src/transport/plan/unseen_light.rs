//! A bound of the light that no photon path has brought yet: light that was never sampled shows no noise, but may be missing.
//!
//! If none of `n` independent paths brought light to the picture, then with 95 % confidence less than `3 / n` of all paths would (the rule
//! of three, \[HanleyLippman83\]). So a component may lack the light of three of its brightest paths. Where thousands of paths arrive
//! that is far below the noise; where a lamp is so far away that hardly any arrives it is many times the picture.

use super::notes::PlanItem;
use super::paths::power;
use super::render_plan::{Plan, RadianceOfPath};
use crate::world::{Light, Surface, World};
use glam::DVec2;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Number of paths whose light may be missing although none of them was found.
const RULE_OF_THREE: f64 = 3.0;
/// Camera samples of a pixel in a full iteration before the first refinement.
const SAMPLES_PER_PIXEL: f64 = 4.0;
/// Rays along a side of the film that measure the surfaces in view. With fewer, chance would change the bound where objects are near and far;
/// more would take time after each edit.
const RAYS_ALONG_SIDE: u32 = 16;

/// Light of a component that may be missing in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnseenLight {
    /// Direct light of a beam, caustics or interreflection.
    pub item: PlanItem,
    /// Mean over the film of the radiance that may be missing, W per steradian and square scene unit.
    pub radiance: f64,
}

impl Plan {
    /// The plan with the measured [`RadianceOfPath`] of its paths in this world.
    pub(super) fn with_radiance_of_path(self, world: &World) -> Self {
        let per_watt = radiance_per_watt(world);
        let brightest = |paths: &[u64], fraction: &dyn Fn(usize) -> f64| {
            let lights = world.lights.iter().zip(paths).enumerate().filter(|(_, (_, paths))| **paths > 0);
            let flux = lights.map(|(light, (emitter, paths))| power(emitter) * fraction(light) / *paths as f64);
            per_watt * flux.fold(0.0, f64::max)
        };
        let caustics = self.caustics.as_ref().map_or(0.0, |caustics| {
            brightest(&caustics.paths, &|light| caustics.projection_maps[light].aimed_fraction())
        });
        let interreflection = brightest(&self.global_paths, &|light| self.photon_emissions[light].aimed_fraction());
        let direct = per_watt * world.lights.iter().map(|light| flux_of_sample(world, light)).fold(0.0, f64::max);
        Self { radiance_of_path: RadianceOfPath { direct, caustics, interreflection }, ..self }
    }

    /// The greatest light of a planned item that may be missing after iterations of this total size (full iterations, above 0); `None`
    /// for a plan without photons.
    pub fn unseen_light(&self, size: f64) -> Option<UnseenLight> {
        let RadianceOfPath { direct, caustics, interreflection } = self.radiance_of_path;
        let direct = Some(direct).filter(|direct| self.finds_direct_light && *direct > 0.0);
        let unseen = |item, of_path: f64| UnseenLight { item, radiance: RULE_OF_THREE * of_path / size };
        let caustics = self.caustics.is_some().then(|| unseen(PlanItem::Caustics, caustics));
        let interreflection =
            (!self.global_paths.is_empty()).then(|| unseen(PlanItem::Interreflection, interreflection));
        let direct = direct.map(|direct| unseen(PlanItem::DirectLight, direct));
        [direct, caustics, interreflection].into_iter().flatten().max_by(|a, b| a.radiance.total_cmp(&b.radiance))
    }
}

/// Flux that a camera sample in the disc of a beam stands for, W, after one full iteration: samples seldom meet a beam that is narrower than
/// a pixel. 0 for lights that every point samples.
fn flux_of_sample(world: &World, light: &Light) -> f64 {
    match light {
        Light::Parallel(rays) if !rays.from_outside => {
            let samples = SAMPLES_PER_PIXEL * rays.area() / world.camera.footprint(world.view.distance).powi(2);
            power(light) / samples
        }
        _ => 0.0,
    }
}

/// Mean radiance over the film for each watt that arrives at a white surface where the camera sees it: the flux spreads over the footprint
/// of one pixel, so `1 / (pi footprint^2 pixels)`. The footprint is the harmonic mean over the surfaces in view, which neither the horizon
/// of a plane nor a single near object rules; 0 without a surface in view.
fn radiance_per_watt(world: &World) -> f64 {
    let camera = &world.camera;
    let film = DVec2::new(f64::from(camera.width), f64::from(camera.height));
    let reciprocal = |k: u32| {
        let cell = DVec2::new(f64::from(k % RAYS_ALONG_SIDE), f64::from(k / RAYS_ALONG_SIDE)) + 0.5;
        let hit = world.closest_hit(&camera.ray(cell / f64::from(RAYS_ALONG_SIDE) * film))?;
        let is_object = matches!(world.surfaces[hit.primitive as usize], Surface::Object { .. });
        is_object.then(|| 1.0 / camera.footprint(hit.t))
    };
    let reciprocals: Vec<f64> = (0..RAYS_ALONG_SIDE * RAYS_ALONG_SIDE).filter_map(reciprocal).collect();
    let mean = reciprocals.iter().sum::<f64>() / reciprocals.len().max(1) as f64;
    mean * mean / (PI * camera.pixel_count() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::plan::Component;
    use crate::transport::testing::{self, lamp, quad};

    fn plan(lamp_distance: f64, material: &str) -> Plan {
        let floor = quad("floor", [[-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "grey");
        let wall = quad("wall", [[-1.0, 0.0, -1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], material);
        Plan::new(&testing::world(&[floor, wall, lamp([0.0, lamp_distance, 0.0])].concat()))
    }

    /// The flux of three paths, spread over the view: a lamp of 4 pi W over the paths of a full iteration.
    #[test]
    fn three_paths_may_be_missing() {
        let plan = plan(1.0, "grey");
        let unseen = plan.unseen_light(2.0).expect("interreflection");
        let flux = 3.0 * 4.0 * PI / plan.global_paths[0] as f64 / 2.0;
        // The camera stands at (0, 0, 4); the picture shows some 3 units each way.
        let area = flux / PI / unseen.radiance;
        assert_eq!(unseen.item, PlanItem::Interreflection);
        assert!((4.0..16.0).contains(&area), "{area} square units");
        let later = plan.unseen_light(20.0).expect("interreflection");
        assert!((unseen.radiance / later.radiance - 10.0).abs() < 1e-9);
    }

    #[test]
    fn only_planned_components_may_lack_light() {
        let mirror = plan(1.0, "mirror");
        let item = |component| mirror.clone().only(component).unseen_light(1.0).map(|unseen| unseen.item);
        assert_eq!(item(Component::Direct), None);
        assert_eq!(item(Component::Caustics), Some(PlanItem::Caustics));
        assert_eq!(item(Component::Interreflection), Some(PlanItem::Interreflection));
    }
}
