//! The plan of a world before anything was measured.

use super::caustics::{self, SEEN_INDIRECTLY};
use super::interreflection;
use super::notes::Notes;
use super::radii::{GLOSSY_RADIUS, Radii};
use super::render_plan::{Plan, RadianceOfPath};
use crate::transport::lights::{LightSampler, PhotonEmission};
use crate::transport::points::GlossyMis;
use crate::world::World;
use std::sync::Arc;

impl Plan {
    /// The plan for a world.
    pub fn new(world: &World) -> Self {
        let mut notes = Notes::default();
        let lit = notes.lights(world);
        let caustics = if lit { caustics::plan(world, &mut notes) } else { None };
        if lit && caustics.is_none() {
            notes.skip(SEEN_INDIRECTLY, "there are no caustics");
        }
        let photon_emissions = PhotonEmission::of_lights(world);
        let global_paths = if lit { interreflection::plan(world, &photon_emissions, &mut notes) } else { Vec::new() };
        let glossy_paths = interreflection::plan_gloss(world, &global_paths, &mut notes);
        notes.textures(world);
        notes.background(world);
        Self {
            camera: world.camera,
            finds_direct_light: true,
            caustics,
            light_sampler: Arc::new(LightSampler::new(world)),
            glossy_mis: GlossyMis::new(world.camera, glossy_paths, GLOSSY_RADIUS),
            photon_emissions: Arc::new(photon_emissions),
            global_paths,
            reuses_lobes: world.object_primitives().any(|p| world.has_uniform_lobe(p)),
            radii: Radii::new(world),
            notes: notes.0,
            radiance_of_path: RadianceOfPath::default(),
            is_draft: false,
            draft_pixels: None,
            bandwidth: None,
            samples: None,
            is_kept: false,
        }
        .with_radiance_of_path(world)
    }
}
