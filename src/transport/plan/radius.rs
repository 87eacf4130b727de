//! The radius of the density estimate at a point in an iteration.
//!
//! `r_i(x) = min(min(R(x) max(s_i, 1), r_max(x)) min(s_i, 1), r_near(x))`: the radius `R(x)` after one full iteration, the factor `s_i` of
//! the schedule or, once measured, of the bandwidth at the pixel, and the greatest radius `r_max(x)` that the surface and the film allow.
//! `r_max(x)` applies before the radius shrinks, so that it shrinks everywhere: otherwise bias would stay. `r_near(x)` limits wide discs of
//! caustics near other objects, to no less than the radius of sharp caustics; a radius that has shrunk below it goes on shrinking.

use super::radii::Radii;
use super::render_plan::Plan;
use crate::geometry::Primitive;
use crate::transport::density::bandwidth::{self, WIDER};
use crate::transport::density::schedule;
use crate::transport::photons::MapKind;
use crate::transport::points::glossy_mis::lobe_width;
use crate::transport::points::{Clearance, VisiblePoint};
use crate::world::World;

/// Greatest radius, except for the least ones of [`Radii`], over the distance to the next object: its light changes
/// within a fraction of the distance \[Ward88\].
const MAX_CLEARANCE_FRACTION: f64 = 0.5;
/// Least radius in a Phong lobe over the radius without one: the lobe averages over several discs, so each disc may be noisier. Measured:
/// it takes a tenth off the error at equal time of a glossy floor, a fifth in a room of gloss.
const LEAST_LOBE_FRACTION: f64 = 0.3;
/// Greatest radius on a sphere over the sphere's radius: the disc must stay nearly flat.
pub(super) const MAX_SPHERE_FRACTION: f64 = 0.32;

/// The radii of an iteration.
#[derive(Clone, Copy)]
pub(in crate::transport) struct IterationRadii<'a> {
    plan: &'a Plan,
    world: &'a World,
    /// The factor `s_i` of the schedule.
    shrink: f64,
    /// The greatest radius, pixel footprints.
    largest: f64,
}

impl IterationRadii<'_> {
    /// The radius of a point's disc for photons of a map, scene units.
    #[inline]
    pub(in crate::transport) fn at(&self, kind: MapKind, point: &VisiblePoint) -> f64 {
        let radii = &self.plan.radii;
        let primitive = &self.world.aggregate.primitives()[point.primitive as usize];
        let footprint = f64::from(point.footprint);
        let factor = match &self.plan.bandwidth {
            None => self.shrink,
            Some(bandwidth) => {
                let measured = bandwidth.at(kind, point.pixel);
                // A patch curves away from a wide disc, which would reach over other patches of the object.
                if matches!(primitive, Primitive::Patch(_)) { measured.min(1.0) } else { measured }
            }
        };
        let limit = match primitive {
            Primitive::Sphere(sphere) => MAX_SPHERE_FRACTION * sphere.radius,
            _ => f64::MAX,
        };
        let unshrunk = radii.unshrunk(kind, point) * factor.max(1.0);
        let radius = unshrunk.min(self.largest * footprint).min(limit) * factor.min(1.0);
        if kind == MapKind::Caustic { radii.limited_caustic(radius, footprint, point.clearance) } else { radius }
    }
}

impl Radii {
    /// The radius after one full iteration, scene units.
    #[inline]
    fn unshrunk(&self, kind: MapKind, point: &VisiblePoint) -> f64 {
        let footprint = f64::from(point.footprint);
        match kind {
            MapKind::Caustic => self.caustic * footprint,
            MapKind::Global => in_lobe(self.unshrunk_global(footprint, point.clearance), point.blur),
            MapKind::IndirectCaustic => self.indirect_caustic * footprint,
            MapKind::Glossy => in_lobe(self.glossy * footprint, point.blur),
        }
    }

    /// The radius for interreflection after one full iteration, scene units, for this footprint and these distances to other objects.
    #[inline]
    fn unshrunk_global(&self, footprint: f64, clearance: Clearance) -> f64 {
        let (least, most) = (self.least_global * footprint, self.global * footprint);
        let by_any = (MAX_CLEARANCE_FRACTION * clearance.any).clamp(least, most);
        by_any.min((MAX_CLEARANCE_FRACTION * clearance.standing).max(self.least_standing * footprint))
    }

    /// A radius for caustics, limited near other objects: a wider disc could reach over several objects and their shadows, and a
    /// bandwidth difference would not show the bias.
    #[inline]
    fn limited_caustic(&self, radius: f64, footprint: f64, clearance: Clearance) -> f64 {
        radius.min((MAX_CLEARANCE_FRACTION * clearance.any).max(self.least_caustic * footprint))
    }
}

impl Plan {
    /// The radii of an iteration in this world.
    pub(in crate::transport) fn radii_of<'a>(&'a self, world: &'a World, iteration: u64) -> IterationRadii<'a> {
        let largest = self.radii.largest * world.view.region / self.camera.footprint(1.0);
        IterationRadii { plan: self, world, shrink: self.shrink(iteration), largest }
    }

    /// The factor of radii in an iteration before the first refinement.
    pub(in crate::transport) fn shrink(&self, iteration: u64) -> f64 {
        if self.is_draft { 1.0 } else { schedule::shrink(iteration) }
    }

    /// Whether density estimates at edges are unbiased for irradiance that changes linearly. They are not before the first refinement:
    /// with few photons the noise would outweigh the bias.
    pub(in crate::transport) fn corrects_edges(&self) -> bool {
        self.bandwidth.is_some()
    }

    /// The distances from which on other objects matter neither for radii nor for visibility polygons, for this footprint; `None` where
    /// no object ever matters.
    pub(in crate::transport) fn wanted_clearance(&self, footprint: f64) -> Option<Clearance> {
        let radii = &self.radii;
        let grown = |kind, radius: f64| bandwidth::most_growth(kind) * radius;
        let caustic = grown(MapKind::Caustic, radii.caustic);
        let indirect_caustic = grown(MapKind::IndirectCaustic, radii.indirect_caustic);
        let widest = WIDER * caustic.max(indirect_caustic).max(radii.least_standing);
        let global = |radius: f64| if self.global_paths.is_empty() { 0.0 } else { radius };
        let limit = |radius: f64| footprint * widest.max(global(radius).max(caustic) / MAX_CLEARANCE_FRACTION);
        let limits = Clearance { any: limit(radii.global), standing: limit(radii.least_global) };
        (self.gathers() && !self.is_draft).then_some(limits)
    }

    /// The distance up to which neighbours reuse samples of a Phong lobe with this exponent, scene units: the lobe blurs even the
    /// nearest object at least as far.
    pub(in crate::transport) fn reuse_distance(
        &self,
        footprint: f64,
        clearance: Clearance,
        exponent: f64,
        iteration: u64,
    ) -> f64 {
        (self.radii.reuse_distance * footprint).min(lobe_width(exponent) * clearance.any) * self.shrink(iteration)
    }

    /// The mean radius over the film in an iteration, scene units, at this distance from the camera and far from other objects: for
    /// caustics where there are any, else for interreflection; 0 where no photons are gathered.
    pub fn mean_radius(&self, distance: f64, iteration: u64) -> f64 {
        if !self.gathers() {
            return 0.0;
        }
        let (kind, pixels) = match &self.caustics {
            Some(_) => (MapKind::Caustic, self.radii.caustic),
            None => (MapKind::Global, self.radii.global),
        };
        let factor = self.bandwidth.as_ref().map_or_else(|| self.shrink(iteration), |bandwidth| bandwidth.mean(kind));
        pixels * factor * self.camera.footprint(distance)
    }
}

/// The radius at a point that a Phong lobe blurs over the distance `blur`, for the radius without a lobe; all in scene units.
#[inline]
fn in_lobe(radius: f64, blur: f32) -> f64 {
    radius * (radius / (radius + f64::from(blur))).max(LEAST_LOBE_FRACTION)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::testing::{self, lamp, quad, sphere, visible_point};

    #[test]
    fn discs_for_caustics_are_small_near_objects() {
        let plan = Plan::new(&testing::world(
            "[[light]]\nname = \"l\"\ntype = \"sphere\"\ncenter = [0, 3, 0]\nradius = 1\nradiance = [1, 1, 1]\n",
        ));
        let radius = |wanted: f64, any: f64| {
            plan.radii.limited_caustic(wanted, 0.01, Clearance { any, standing: f64::INFINITY })
        };
        let half = 0.5 * plan.radii.caustic * 0.01;
        assert_eq!(radius(0.04, f64::INFINITY), 0.04);
        assert_eq!(radius(0.04, 0.06), 0.03);
        assert_eq!(radius(0.04, 0.0), half, "the radius of sharp caustics is the least");
        assert_eq!(radius(0.5 * half, 0.0), 0.5 * half, "a shrunk radius stays");
    }

    /// A film so coarse that the greatest radius limits the discs.
    #[test]
    fn the_greatest_radius_does_not_depend_on_far_objects() {
        let radius = |far: &str| {
            let wall = quad("wall", [[-5.0, -5.0, 0.0], [10.0, 0.0, 0.0], [0.0, 10.0, 0.0]], "grey");
            let film = "[film]\nwidth = 16\nheight = 16\n".to_owned();
            let world = testing::world(&[film, lamp([0.0, 0.0, 3.0]), wall, far.to_owned()].concat());
            let plan = Plan::new(&world);
            plan.radii_of(&world, 1).at(MapKind::Global, &visible_point()) / plan.radii.global
        };
        let alone = radius("");
        assert!(alone < 0.9 * f64::from(visible_point().footprint), "{alone}");
        assert_eq!(radius(&sphere("far", [0.0, 1e9, 0.0], 1.0, "grey")), alone);
    }
}
