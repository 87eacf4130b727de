//! How large the discs of density estimates are.

use super::Plan;
use crate::transport::bandwidth::{self, WIDER};
use crate::transport::camera_pass::Clearance;
use crate::transport::lobe_light::lobe_width;
use crate::transport::maps::MapKind;
use crate::transport::schedule;
use crate::world::World;

/// Radius of the density estimate of caustics that may be sharp, after one full iteration, pixels' footprints.
pub(super) const CAUSTIC_RADIUS: f64 = 2.0;
/// Radius for interreflection in Phong lobes after one full iteration, pixels' footprints.
pub(super) const GLOSSY_RADIUS: f64 = 6.0;
/// How far from each other neighbours are at most that share what they see in lobes, after one full iteration, pixels'
/// footprints. Measured: with 3 and 6 the error is 1.09 and 0.96 times as great in a room of gloss.
pub(super) const LOBE_REACH: f64 = 4.0;
/// Radii, but for the least ones, are at most this part of the distance to the next object.
const PART_OF_CLEARANCE: f64 = 0.5;
/// A lobe blurs what is seen in it, so that discs there may be noisier: the least part of their radius. Measured: a tenth off the
/// error for time of a glossy floor, a fifth in a room of gloss.
const LEAST_PART_IN_LOBE: f64 = 0.3;
/// A disc may cover this part of a sphere's radius, so that it stays nearly flat.
pub(in crate::transport) const MAX_PART_OF_SPHERE: f64 = 0.32;
/// A light with at least this part of the world's radius blurs caustics well.
const LARGE_LIGHT: f64 = 0.1;

/// Whether all lights are so large that hardly any caustic of theirs is sharp.
pub(super) fn are_large(world: &World) -> bool {
    world.lights.iter().all(|light| light.reach() >= LARGE_LIGHT * world.radius)
}

impl Plan {
    /// The radius for interreflection after one full iteration at a point with this footprint and this far from other
    /// objects: light from near objects changes within a part of their distance \[Ward88\].
    pub(in crate::transport) fn global_radius_at(&self, footprint: f64, clearance: Clearance) -> f64 {
        let (least, most) = (self.least_global_radius * footprint, self.global_radius * footprint);
        let by_any = (PART_OF_CLEARANCE * clearance.any).clamp(least, most);
        by_any.min((PART_OF_CLEARANCE * clearance.standing).max(self.least_standing_radius * footprint))
    }

    /// A radius where what is seen is blurred this far, scene units.
    pub(in crate::transport) fn radius_in_lobe(&self, radius: f64, blur: f32) -> f64 {
        radius * (radius / (radius + f64::from(blur))).max(LEAST_PART_IN_LOBE)
    }

    /// How far from each other neighbours with this footprint and this far from other objects are at most that share what they
    /// see in a lobe with this exponent, scene units: no farther than it blurs those.
    pub(in crate::transport) fn lobe_reach(
        &self,
        footprint: f64,
        clearance: Clearance,
        exponent: f64,
        iteration: u64,
    ) -> f64 {
        (self.lobe_reach * footprint).min(lobe_width(exponent) * clearance.any) * self.shrink(iteration)
    }

    /// A radius for caustics, limited at a point with this footprint and this far from other objects: discs that
    /// reach over several of them and their shadows would not tell that it differs between these.
    pub(in crate::transport) fn limited_caustic_radius(
        &self,
        radius: f64,
        footprint: f64,
        clearance: Clearance,
    ) -> f64 {
        radius.min((PART_OF_CLEARANCE * clearance.any).max(self.least_caustic_radius * footprint))
    }

    /// The distances from which on other objects matter neither for radii nor for what is seen within them; `None`
    /// where none ever does.
    pub(in crate::transport) fn wanted_clearance(&self, footprint: f64) -> Option<Clearance> {
        let grown = |kind, radius: f64| bandwidth::most_growth(kind) * radius;
        let (caustic, focused) =
            (grown(MapKind::Caustic, self.caustic_radius), grown(MapKind::Focused, self.focused_radius));
        let widest = WIDER * caustic.max(focused).max(self.least_standing_radius);
        let global = |radius: f64| if self.global_paths.is_empty() { 0.0 } else { radius };
        let limit = |radius: f64| footprint * widest.max(global(radius).max(caustic) / PART_OF_CLEARANCE);
        let limits = Clearance { any: limit(self.global_radius), standing: limit(self.least_global_radius) };
        (self.gathers() && !self.is_draft).then_some(limits)
    }

    /// The factor by which radii have shrunk in an iteration as long as nothing was measured.
    pub(in crate::transport) fn shrink(&self, iteration: u64) -> f64 {
        if self.is_draft { 1.0 } else { schedule::shrink(iteration) }
    }

    /// The radius in an iteration at a distance from the camera, scene units: that for caustics, where there are any,
    /// else that for interreflection far from other objects, in the mean over the film; 0 where nothing is gathered.
    pub fn radius_at(&self, distance: f64, iteration: u64) -> f64 {
        if !self.gathers() {
            return 0.0;
        }
        let (kind, pixels) = match &self.caustics {
            Some(_) => (MapKind::Caustic, self.caustic_radius),
            None => (MapKind::Global, self.global_radius),
        };
        let shrink = self.bandwidth.as_ref().map_or_else(|| self.shrink(iteration), |bandwidth| bandwidth.mean(kind));
        pixels * shrink * self.camera.footprint(distance)
    }

    /// The factor by which a map's radius has shrunk in a pixel, if it was measured; else it is [`Plan::shrink`].
    pub(in crate::transport) fn measured_shrink(&self, kind: MapKind, pixel: u32) -> Option<f64> {
        self.bandwidth.as_ref().map(|bandwidth| bandwidth.at(kind, pixel))
    }

    /// Whether density estimates at edges are right for light that changes linearly. Not before radii were measured: with
    /// few photons the noise of it outweighs the bias.
    pub(in crate::transport) fn corrects_edges(&self) -> bool {
        self.bandwidth.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Location, SceneFile};
    use crate::world::prepare;

    #[test]
    fn discs_for_caustics_are_small_where_objects_are_near() {
        let text = "version = 1\n[camera]\nposition = [0, 0, 9]\ntarget = [0, 0, 0]\nfov_y = 40
            [[light]]\nname = \"l\"\ntype = \"sphere\"\ncenter = [0, 3, 0]\nradius = 1\nradiance = [1, 1, 1]\n";
        let file = SceneFile::parse(text, Location::Unsaved).expect("the scene is valid");
        let plan = Plan::new(&prepare(&file.scene, &Location::Unsaved, None).expect("it can be prepared"));
        let radius = |wanted: f64, any: f64| {
            plan.limited_caustic_radius(wanted, 0.01, Clearance { any, standing: f64::INFINITY })
        };
        let half = 0.5 * plan.caustic_radius * 0.01;
        assert_eq!(radius(0.04, f64::INFINITY), 0.04);
        assert_eq!(radius(0.04, 0.06), 0.03);
        assert_eq!(radius(0.04, 0.0), half, "no less than where caustics may be sharp");
        assert_eq!(radius(0.5 * half, 0.0), 0.5 * half, "but for shrinking");
    }
}
