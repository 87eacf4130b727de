//! Whether there are caustics, which paths look for them, and whether photons are gathered or added to the film.

use super::Plan;
use super::notes::Notes;
use super::paths::{of_pixels, power, share};
use super::radii::{CAUSTIC_RADIUS, MAX_PART_OF_SPHERE};
use super::surfaces::shows_at;
use crate::geometry::Primitive;
use crate::transport::guide::Guide;
use crate::transport::schedule;
use crate::world::World;
use std::sync::Arc;

/// How caustics are rendered.
#[derive(Clone, Debug)]
pub struct CausticPlan {
    /// Paths in a full iteration, by light.
    pub paths: Vec<u64>,
    /// Where each light meets mirrors or glass.
    pub guides: Arc<Vec<Guide>>,
    /// Whether the camera may see caustics in mirrors, through glass or in glossy surfaces.
    pub seen_indirectly: bool,
    /// Until radii are measured, so many full iterations' directly seen caustics are gathered from the map, which is smoother
    /// while photons are few.
    pub gathered: f64,
}

/// Paths for caustics in a full iteration, for each pixel.
const CAUSTIC_PATHS_PER_PIXEL: f64 = 2.0;
/// Photons a pixel from which on adding them to the film is better than a density estimate, where caustics may be sharp.
const PHOTONS_PER_PIXEL_TO_SPLAT: f64 = 1.0;
/// Directly seen caustics are gathered where discs of more than this radius, pixels, are best. A disc of 0.65 pixels is as noisy
/// as the pixel by itself, and has bias as well.
const LARGE_CAUSTIC_RADIUS: f64 = 1.3;
pub(super) const SEEN_INDIRECTLY: &str = "caustics in mirrors and glass";

/// How caustics are rendered; `None` where there are none.
pub(super) fn plan(world: &World, notes: &mut Notes) -> Option<CausticPlan> {
    const WHAT: &str = "caustics";
    let needless = if world.max_bounces < 2 {
        Some("max_bounces leaves only direct light")
    } else if !(0..world.surfaces.len()).any(|p| world.is_specular(p as u32)) {
        Some("no surface mirrors or refracts")
    } else {
        None
    };
    if let Some(reason) = needless {
        notes.skip(WHAT, reason);
        return None;
    }
    let guides: Vec<Guide> =
        world.lights.iter().enumerate().map(|(i, light)| Guide::build(world, light, i as u64)).collect();
    let weights = world.lights.iter().zip(&guides).map(|(light, guide)| power(light) * guide.covered()).collect();
    let total = of_pixels(world.camera.pixel_count(), CAUSTIC_PATHS_PER_PIXEL);
    let paths = share(weights, total);
    let covered = guides.iter().map(Guide::covered).fold(0.0, f64::max);
    notes.render(
        WHAT,
        format!("mirrors and glass fill up to {:.1} % of a light's directions; photons aim there", 100.0 * covered),
    );
    let seen_indirectly = plan_seen_indirectly(world, notes);
    let photons_per_pixel = paths.iter().sum::<u64>() as f64 / world.camera.pixel_count() as f64;
    let gathered = if may_be_sharp(world) { PHOTONS_PER_PIXEL_TO_SPLAT / photons_per_pixel } else { f64::INFINITY };
    Some(CausticPlan { paths, guides: Arc::new(guides), seen_indirectly, gathered })
}

/// Whether caustics may be as sharp as can be: lights blur them if they are larger than the discs.
fn may_be_sharp(world: &World) -> bool {
    let distance = world.camera.position.distance(world.center).max(world.radius);
    world.lights.iter().any(|light| light.reach() < CAUSTIC_RADIUS * world.camera.footprint(distance))
}

fn plan_seen_indirectly(world: &World, notes: &mut Notes) -> bool {
    let sends_on = |p: u32| shows_at(world, p) && (world.is_specular(p) || world.is_glossy(p));
    let (all, seen) = (0..world.surfaces.len() as u32)
        .filter(|&p| sends_on(p))
        .fold((0, 0), |(all, seen), p| (all + 1, seen + usize::from(world.may_be_in_view(p))));
    let needless = if world.max_bounces < 3 {
        Some("max_bounces leaves no path to a caustic that way")
    } else if seen == 0 {
        Some("nothing in view mirrors or refracts: photons go straight to the film")
    } else {
        None
    };
    match needless {
        Some(reason) => notes.skip(SEEN_INDIRECTLY, reason),
        None => notes
            .render(SEEN_INDIRECTLY, format!("{seen} of {all} mirrors, glasses and glossy surfaces may be in view")),
    }
    needless.is_none()
}

impl Plan {
    /// Whether caustics that the camera sees directly in a pixel come from the map in this iteration; else each photon is
    /// added to the film by itself, as it always is on balls so small that only small discs lie flat on them.
    pub(in crate::transport) fn gathers_visible_caustics(
        &self,
        primitive: &Primitive,
        pixel: u32,
        iteration: u64,
    ) -> bool {
        let is_large = match &self.bandwidth {
            None => self.begins_with_gathering(iteration),
            Some(bandwidth) => self.caustic_radius * bandwidth.least_caustic_near(pixel) > LARGE_CAUSTIC_RADIUS,
        };
        is_large && (self.is_draft || self.holds_large_disc(primitive))
    }

    fn holds_large_disc(&self, primitive: &Primitive) -> bool {
        let Primitive::Sphere(sphere) = primitive else { return true };
        let footprint = self.camera.footprint(self.camera.position.distance(sphere.center));
        MAX_PART_OF_SPHERE * sphere.radius > LARGE_CAUSTIC_RADIUS * footprint
    }

    /// Whether the bias of iterations 1 to `i` is known: not that of the first ones where they gather sharp caustics.
    pub fn knows_bias(&self, i: u64) -> bool {
        schedule::knows_bias(i) || self.caustics.as_ref().is_none_or(|caustics| caustics.gathered.is_infinite())
    }

    /// Whether the map of caustics serves anything in this iteration. Where measured radii say that it does not, it never will:
    /// nothing is measured any more, and the best radii get smaller as iterations get more.
    pub fn needs_caustic_map(&self, iteration: u64) -> bool {
        let Some(caustics) = &self.caustics else { return false };
        caustics.seen_indirectly
            || match &self.bandwidth {
                None => self.begins_with_gathering(iteration) || schedule::measures(iteration),
                Some(bandwidth) => self.caustic_radius * bandwidth.greatest_least_caustic() > LARGE_CAUSTIC_RADIUS,
            }
    }

    fn begins_with_gathering(&self, iteration: u64) -> bool {
        self.caustics.as_ref().is_some_and(|caustics| schedule::size_before(iteration) < caustics.gathered)
    }
}
