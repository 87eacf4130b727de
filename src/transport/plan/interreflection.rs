//! Whether there is interreflection, and which paths look for it.

use super::notes::Notes;
use super::paths::{of_pixels, power, share};
use crate::geometry::Primitive;
use crate::transport::relevance;
use crate::world::World;

/// Paths for interreflection in a full iteration, for each pixel: about as much work as the pixel's own paths.
const GLOBAL_PATHS_PER_PIXEL: f64 = 4.0;
/// If no more of a light's paths reach the view, it is said to be out of it.
const FEW: f64 = 0.01;

/// Paths that look for interreflection in a full iteration, by light; empty where there is none.
pub(super) fn plan(world: &World, notes: &mut Notes) -> Vec<u64> {
    const WHAT: &str = "interreflection";
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
        notes.skip(WHAT, reason);
        return Vec::new();
    }
    notes.render(
        WHAT,
        match scattering.len() {
            1 => "1 surface scatters light, and some of it comes back".to_owned(),
            surfaces => format!("{surfaces} surfaces scatter light to each other"),
        },
    );
    let total = of_pixels(world.camera.pixel_count(), GLOBAL_PATHS_PER_PIXEL);
    share(weights(world, notes), total)
}

/// Paths of photons that bring light to Phong lobes: those for interreflection, where there are lobes that may be divided.
pub(super) fn plan_gloss(world: &World, global_paths: &[u64], notes: &mut Notes) -> Vec<u64> {
    const WHAT: &str = "photons for gloss";
    let glossy = (0..world.surfaces.len() as u32).filter(|&p| world.may_divide_lobes(p)).count();
    if glossy == 0 || global_paths.is_empty() {
        let reason = if glossy == 0 {
            "no surface has a wide Phong lobe without textures"
        } else {
            "there is no interreflection"
        };
        notes.skip(WHAT, reason);
        return Vec::new();
    }
    notes.render(WHAT, format!("{glossy} surfaces have wide Phong lobes; photons bring them light of bright spots"));
    global_paths.to_vec()
}

/// Whether light that a surface scatters may come back to it: it is not convex towards the lights, or a mirror or glass
/// sends light back within the bounces.
fn may_light_itself(world: &World, primitive: u32) -> bool {
    let sent_back = world.max_bounces >= 3 && (0..world.surfaces.len() as u32).any(|p| world.is_specular(p));
    let is_convex = match &world.aggregate.primitives()[primitive as usize] {
        Primitive::Quad(_) | Primitive::Plane(_) => true,
        Primitive::Sphere(sphere) => {
            world.lights.iter().all(|light| light.center().distance(sphere.center) > sphere.radius + light.reach())
        }
        Primitive::Patch(_) => false,
    };
    sent_back || !is_convex
}

/// What paths of each light are worth that are not aimed: where a part `p` of them matters, the variance of what they find goes
/// with `power^2 p`, and is least for all together with paths in proportion to its root.
fn weights(world: &World, notes: &mut Notes) -> Vec<f64> {
    let relevances = relevance::of_lights(world);
    let (all, few) = (relevances.len(), relevances.iter().filter(|&&part| part < FEW).count());
    if 0 < few && few < all {
        let reason = format!("of {few} of {all} lights hardly any reach the view");
        notes.skip("most paths of lights out of view", &reason);
    }
    world.lights.iter().zip(relevances).map(|(light, part)| power(light) * part.sqrt()).collect()
}
