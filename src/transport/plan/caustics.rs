//! Whether there are caustics, which photon paths find them, and whether photons are gathered or splatted to the film.

use super::notes::{Notes, PlanItem};
use super::paths::{allocate, of_pixels, power};
use super::radii::{CAUSTIC_RADIUS, blur};
use super::radius::MAX_SPHERE_FRACTION;
use super::render_plan::{CausticPlan, Plan};
use super::sheet_lattice::SheetLattice;
use crate::geometry::Primitive;
use crate::transport::density::schedule;
use crate::transport::lights::ProjectionMap;
use crate::world::{Light, World};
use std::sync::Arc;

/// Photon paths for caustics in a full iteration, for each pixel: half as many as for interreflection, because projection maps aim all of
/// them at mirrors and glass. More paths delay each iteration; with fewer, the camera paths take most of its time.
const CAUSTIC_PATHS_PER_PIXEL: f64 = 2.0;
/// Photon paths per pixel from which on splats are better than density estimates, where caustics may be sharp.
const PHOTONS_PER_PIXEL_TO_SPLAT: f64 = 1.0;
/// Least radius, pixels, of discs that gather directly seen caustics; where smaller discs would be best, photons are splatted. A disc
/// of 0.65 pixels is as noisy as the pixel itself, and has bias as well.
const LARGE_CAUSTIC_RADIUS: f64 = 1.3;
/// Greatest sine of half the angle under which mirrors and glass see a lamp that has sheets. Measured with a lens, a bent mirror and two balls:
/// at 0.03 sheets of four points an iteration have a third to two thirds of the squared error of photons after 2 s, at 0.1 with the lens three
/// times as much, with the balls a third. With the teapot at 0.06 they have a twelfth, but their time is missing to interreflection.
const WIDEST_WITH_SHEETS: f64 = 0.04;
pub(super) const SEEN_INDIRECTLY: PlanItem = PlanItem::IndirectlySeenCaustics;

/// How caustics are rendered; `None` where there are none.
pub(super) fn plan(world: &World, notes: &mut Notes) -> Option<CausticPlan> {
    const ITEM: PlanItem = PlanItem::Caustics;
    let needless = if world.max_bounces < 2 {
        Some("max_bounces leaves only direct light")
    } else if !(0..world.surfaces.len()).any(|p| world.is_specular(p as u32)) {
        Some("no surface mirrors or refracts")
    } else {
        None
    };
    if let Some(reason) = needless {
        notes.skip(ITEM, reason);
        return None;
    }
    let lights = world.lights.iter().enumerate();
    let maps: Vec<ProjectionMap> =
        lights.map(|(i, light)| ProjectionMap::of_specular(world, light, i as u64)).collect();
    let weights = world.lights.iter().zip(&maps).map(|(light, map)| power(light) * map.covered()).collect();
    let total = of_pixels(world.camera.pixel_count(), CAUSTIC_PATHS_PER_PIXEL);
    let paths = allocate(weights, total);
    let sheets: Vec<bool> = world.lights.iter().zip(&maps).map(|(light, map)| has_sheets(world, light, map)).collect();
    let covered = maps.iter().map(ProjectionMap::covered).fold(0.0, f64::max);
    notes.render(
        ITEM,
        format!(
            "mirrors and glass cover up to {:.1} % of a light's directions; {} there",
            100.0 * covered,
            if sheets.contains(&true) {
                "light sheets, and photons where they are not smooth, go"
            } else {
                "photons aim"
            }
        ),
    );
    let seen_indirectly = plan_seen_indirectly(world, notes);
    let photons_per_pixel = paths.iter().sum::<u64>() as f64 / world.camera.pixel_count() as f64;
    let gathered_iterations =
        if may_be_sharp(world) { PHOTONS_PER_PIXEL_TO_SPLAT / photons_per_pixel } else { f64::INFINITY };
    Some(CausticPlan {
        paths,
        projection_maps: Arc::new(maps),
        sheets,
        lattice: SheetLattice::ITERATION,
        seen_indirectly,
        gathered_iterations,
    })
}

/// Whether sheets of light bring a light's caustics: not of wide lamps, each of whose points has sheets of its own, nor where photons aim at
/// small objects, which a lattice would miss.
fn has_sheets(world: &World, light: &Light, map: &ProjectionMap) -> bool {
    sine_of_extent(world, light) <= WIDEST_WITH_SHEETS && map.covered() > 0.0 && map.is_by_cells()
}

/// The sine of half the angle under which mirrors and glass see a light.
fn sine_of_extent(world: &World, light: &Light) -> f64 {
    match (light, world.view.specular) {
        (Light::Point { .. }, _) => 0.0,
        (Light::Parallel(rays), _) => rays.half_angle.sin(),
        (Light::Sphere { .. } | Light::Quad { .. }, None) => 1.0,
        (Light::Sphere { .. } | Light::Quad { .. }, Some(mirrors)) => {
            light.bounding_radius() / light.center().distance(mirrors.center).max(mirrors.radius)
        }
    }
}

/// Whether any light is so small that its caustics may be sharper than the discs.
fn may_be_sharp(world: &World) -> bool {
    let footprint = world.camera.footprint(world.view.distance);
    world.lights.iter().any(|light| blur(world, light) < CAUSTIC_RADIUS * footprint)
}

fn plan_seen_indirectly(world: &World, notes: &mut Notes) -> bool {
    let (all, seen) = world
        .object_primitives()
        .filter(|&p| world.is_specular(p) || world.is_glossy(p))
        .fold((0, 0), |(all, seen), p| (all + 1, seen + usize::from(world.may_be_in_view(p))));
    let needless = if world.max_bounces < 3 {
        Some("max_bounces is too small to see a caustic that way")
    } else if seen == 0 {
        Some("no mirror, glass or gloss is in view: photons are splatted to the film")
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
    /// Whether a pixel gathers directly seen caustics from the map in an iteration; otherwise photons are splatted. On spheres so small
    /// that only small discs lie flat on them, photons are always splatted.
    #[inline]
    pub(in crate::transport) fn gathers_visible_caustics(
        &self,
        primitive: &Primitive,
        pixel: u32,
        iteration: u64,
    ) -> bool {
        let is_large = match &self.bandwidth {
            None => self.begins_with_gathering(iteration),
            Some(bandwidth) => self.radii.caustic * bandwidth.least_caustic_near(pixel) > LARGE_CAUSTIC_RADIUS,
        };
        is_large && (self.is_draft || self.fits_large_disc(primitive))
    }

    fn fits_large_disc(&self, primitive: &Primitive) -> bool {
        let Primitive::Sphere(sphere) = primitive else { return true };
        let footprint = self.camera.footprint(self.camera.position.distance(sphere.center));
        MAX_SPHERE_FRACTION * sphere.radius > LARGE_CAUSTIC_RADIUS * footprint
    }

    /// Whether the bias of iterations 1 to `i` is known. It is not before the first refinement where sharp caustics are gathered.
    pub fn knows_bias(&self, i: u64) -> bool {
        schedule::knows_bias(i)
            || self.caustics.as_ref().is_none_or(|caustics| caustics.gathered_iterations.is_infinite())
    }

    /// Whether any pixel reads the caustic map in an iteration. Once measured radii make all pixels splat, no later refinement gathers
    /// again: without a map nothing is measured, and the best radii shrink with the number of iterations.
    pub fn needs_caustic_map(&self, iteration: u64) -> bool {
        let Some(caustics) = &self.caustics else { return false };
        caustics.seen_indirectly
            || match &self.bandwidth {
                None => self.begins_with_gathering(iteration) || schedule::measures(iteration),
                Some(bandwidth) => self.radii.caustic * bandwidth.greatest_least_caustic() > LARGE_CAUSTIC_RADIUS,
            }
    }

    fn begins_with_gathering(&self, iteration: u64) -> bool {
        self.caustics.as_ref().is_some_and(|caustics| schedule::size_before(iteration) < caustics.gathered_iterations)
    }
}
