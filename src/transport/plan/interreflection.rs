//! Whether there is interreflection, and which photon paths find it.

use super::light_importance;
use super::notes::{Notes, PlanItem};
use super::paths::{allocate, of_pixels, power};
use crate::geometry::Primitive;
use crate::transport::lights::PhotonEmission;
use crate::world::World;

/// Photon paths for interreflection in a full iteration, for each pixel: about as much work as the pixel's camera paths.
const GLOBAL_PATHS_PER_PIXEL: f64 = 4.0;
/// Importance of a light below which a note calls it out of view; no picture depends on it. It stands for two or three of 256 probe paths: a
/// smaller value would leave out lights of which chance let one path be seen, a larger one would name lights in view.
const LOW_IMPORTANCE: f64 = 0.01;

/// Photon paths for interreflection in a full iteration, by light; empty without interreflection.
pub(super) fn plan(world: &World, emissions: &[PhotonEmission], notes: &mut Notes) -> Vec<u64> {
    const ITEM: PlanItem = PlanItem::Interreflection;
    let scattering: Vec<u32> = (0..world.surfaces.len() as u32).filter(|&p| world.scattered_bound(p) > 0.0).collect();
    let needless = if world.max_bounces < 2 {
        Some("max_bounces leaves only direct light")
    } else if let [only] = scattering[..]
        && !may_light_itself(world, only)
    {
        Some("the only surface that scatters light cannot light itself")
    } else {
        None
    };
    if let Some(reason) = needless {
        notes.skip(ITEM, reason);
        return Vec::new();
    }
    notes.render(
        ITEM,
        match scattering.len() {
            1 => "1 surface scatters light that may return to it".to_owned(),
            surfaces => format!("{surfaces} surfaces scatter light to each other"),
        },
    );
    let total = of_pixels(world.camera.pixel_count(), GLOBAL_PATHS_PER_PIXEL);
    allocate(weights(world, emissions, notes), total)
}

/// Photon paths that may bring light to Phong lobes, by light: the paths of interreflection; empty without a lobe that gathers photons.
pub(super) fn plan_gloss(world: &World, global_paths: &[u64], notes: &mut Notes) -> Vec<u64> {
    const ITEM: PlanItem = PlanItem::GlossyPhotons;
    let glossy = (0..world.surfaces.len() as u32).filter(|&p| world.gathers_in_lobes(p)).count();
    if glossy == 0 || global_paths.is_empty() {
        let reason = if glossy == 0 {
            "no surface has a wide Phong lobe without textures"
        } else {
            "there is no interreflection"
        };
        notes.skip(ITEM, reason);
        return Vec::new();
    }
    notes
        .render(ITEM, format!("{glossy} surfaces have wide Phong lobes; photons bring them the light of bright spots"));
    global_paths.to_vec()
}

/// Whether light that a surface scatters may return to it: over a mirror or glass within the bounces, or because the surface is not
/// convex towards the lights.
fn may_light_itself(world: &World, primitive: u32) -> bool {
    let sent_back = world.max_bounces >= 3 && (0..world.surfaces.len() as u32).any(|p| world.is_specular(p));
    let is_convex = match &world.aggregate.primitives()[primitive as usize] {
        Primitive::Quad(_) | Primitive::Plane(_) => true,
        Primitive::Sphere(sphere) => world
            .lights
            .iter()
            .all(|light| light.center().distance(sphere.center) > sphere.radius + light.bounding_radius()),
        Primitive::Patch(_) => false,
    };
    sent_back || !is_convex
}

/// Weights of the lights' path counts. A light's contribution, of whose paths the fraction `p` matters, has a variance in proportion to
/// `power^2 p`; the sum over all lights is least for counts in proportion to the root.
fn weights(world: &World, emissions: &[PhotonEmission], notes: &mut Notes) -> Vec<f64> {
    let importances = light_importance::of_lights(world, emissions);
    let all = importances.len();
    let low = importances.iter().filter(|&&importance| importance < LOW_IMPORTANCE).count();
    if 0 < low && low < all {
        let reason = format!("hardly any paths of {low} of {all} lights reach the view");
        notes.skip(PlanItem::PathsOutOfView, &reason);
    }
    let weight = |(light, importance): (_, f64)| power(light) * importance.sqrt();
    world.lights.iter().zip(importances).map(weight).collect()
}
