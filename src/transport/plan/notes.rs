//! The plan's decisions and their reasons, as text for the user.

use crate::math::Rgb;
use crate::transport::lights::light_sampler::MOST_SAMPLED;
use crate::world::World;
use serde::{Deserialize, Serialize};
use std::fmt;

/// An item of work that a scene may need: a component of light or a piece of one, texture lookups, the background.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum PlanItem {
    /// Direct light.
    DirectLight,
    /// All light, in a scene without any.
    AllLight,
    /// Caustics.
    Caustics,
    /// Caustics that the camera sees in mirrors, through glass or in Phong lobes.
    IndirectlySeenCaustics,
    /// Interreflection.
    Interreflection,
    /// Photons in Phong lobes.
    GlossyPhotons,
    /// Most photon paths of lights out of view.
    PathsOutOfView,
    /// Texture lookups.
    Textures,
    /// The background.
    Background,
}

impl fmt::Display for PlanItem {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::DirectLight => "direct light",
            Self::AllLight => "direct light and photons",
            Self::Caustics => "caustics",
            Self::IndirectlySeenCaustics => "caustics in mirrors and glass",
            Self::Interreflection => "interreflection",
            Self::GlossyPhotons => "photons in Phong lobes",
            Self::PathsOutOfView => "most paths of lights out of view",
            Self::Textures => "textures",
            Self::Background => "background",
        })
    }
}

/// One decision of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanNote {
    /// The item that the decision is about.
    pub item: PlanItem,
    /// Whether the item is rendered; otherwise it is skipped.
    pub rendered: bool,
    /// The reason, in English.
    pub reason: String,
}

/// The decisions so far.
#[derive(Default)]
pub(super) struct Notes(pub(super) Vec<PlanNote>);

impl Notes {
    pub(super) fn render(&mut self, item: PlanItem, reason: String) {
        self.0.push(PlanNote { item, rendered: true, reason });
    }

    pub(super) fn skip(&mut self, item: PlanItem, reason: &str) {
        self.0.push(PlanNote { item, rendered: false, reason: reason.to_owned() });
    }

    /// Decides on direct light; returns whether there is light to transport.
    pub(super) fn lights(&mut self, world: &World) -> bool {
        const ITEM: PlanItem = PlanItem::AllLight;
        if world.lights.is_empty() {
            self.skip(ITEM, "no light has any power");
        } else if world.max_bounces == 0 {
            self.skip(ITEM, "max_bounces is 0: the camera sees only lights");
        } else if world.object_primitives().next().is_none() {
            self.skip(ITEM, "the scene has no surface");
        } else if !world.object_primitives().any(|p| world.scattered_bound(p) > 0.0) {
            self.skip(ITEM, "no surface scatters light in many directions");
        } else {
            let reason = match world.lights.len() {
                1 => "1 light, one shadow ray for each point".to_owned(),
                few if few <= MOST_SAMPLED => format!("{few} lights, one shadow ray to each"),
                many => format!("{many} lights; each point samples {MOST_SAMPLED}, by their expected contribution"),
            };
            self.render(PlanItem::DirectLight, reason);
            return true;
        }
        false
    }

    pub(super) fn textures(&mut self, world: &World) {
        match world.materials.iter().filter(|m| m.lookups() > 0).count() {
            0 => self.skip(PlanItem::Textures, "no visible material has one: surface parameters are never computed"),
            1 => self.render(PlanItem::Textures, "1 material reads them".to_owned()),
            textured => self.render(PlanItem::Textures, format!("{textured} materials read them")),
        }
    }

    pub(super) fn background(&mut self, world: &World) {
        if world.background != Rgb::ZERO {
            self.render(
                PlanItem::Background,
                "the camera sees it, also in mirrors, glass and gloss; it sends no light to diffuse surfaces"
                    .to_owned(),
            );
        }
    }
}
