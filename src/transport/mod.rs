//! Light transport: scattering at surfaces, the plan of what a scene needs, and the passes of an iteration.
//!
//! Every path of light belongs to exactly one component, by its vertices from the light to the camera (L light,
//! S mirror or glass, D the last surface that scatters in many directions, E eye):
//!
//! | component | paths | found by |
//! |---|---|---|
//! | emission | `L S* E` | [`camera_pass`] |
//! | direct light | `L D S* E` | [`camera_pass`], next event estimation |
//! | visible caustics | `L S+ D E` | [`caustic_photon_pass`], added to the film |
//! | caustics in mirrors and glass | `L S+ D S+ E` | [`caustic_photon_pass`], density estimate |
//! | interreflection | `L .. D .. D S* E` | [`global_photon_pass`], density estimate |
//! | light in gloss | `L .. D S* G S* E` | [`camera_pass`]; as far as [`LobeLight`] says by photons, density estimate |
//!
//! A Phong lobe (G) shows what the camera sees along a path that goes on from it at random; what such a path finds belongs to the
//! component that it would if the camera saw it without the lobe, and what photons bring to interreflection.
//!
//! A pass is a function of the world, the plan, the seed and the number of the iteration; it returns what it found.

mod bandwidth;
mod blocks;
mod bsdf;
mod camera_pass;
mod caustic_pass;
mod component;
mod counters;
mod direct;
mod emission;
mod gather;
mod guide;
mod kernel;
mod light_choice;
mod lobe_light;
mod lobe_sharing;
mod maps;
mod measured;
mod medium;
mod morton;
mod photon;
mod photon_map;
mod photon_pass;
mod pixel_samples;
mod plan;
mod relevance;
mod schedule;
mod sharing;
mod tilt;
mod visibility_polygon;

pub use bandwidth::{Bandwidth, Contrast};
pub(crate) use blocks::join;
pub use bsdf::{Fresnel, fresnel};
pub use camera_pass::{CameraBatch, Facet, VisiblePoint, camera_pass};
pub use caustic_pass::{CausticBatch, Splat, caustic_photon_pass};
pub use component::Component;
pub use counters::Counters;
pub use gather::{Gathered, gather};
pub use guide::Guide;
pub use light_choice::LightChoice;
pub use lobe_light::LobeLight;
pub use lobe_sharing::{SeenLobe, seen_lobes, share_lobes};
pub use maps::{MapKind, Maps, PerMap};
pub use measured::Measured;
pub use photon::Photon;
pub use photon_map::{PhotonMap, Query};
pub use photon_pass::{GlobalBatch, global_photon_pass};
pub use pixel_samples::PixelSamples;
pub use plan::{CausticPlan, Plan, PlanNote};

/// Rows of the film, from the top.
pub type Rows = std::ops::Range<u32>;

/// How a pass learns that nobody wants its result any more.
#[derive(Clone, Copy)]
pub struct Cancel<'a>(&'a (dyn Fn() -> bool + Sync));

impl<'a> Cancel<'a> {
    /// Passes ask this function now and then, from any thread; once it says yes they return nothing.
    pub fn when(cancelled: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self(cancelled)
    }

    /// For passes that always finish.
    pub const NEVER: Cancel<'static> = Cancel(&|| false);

    /// Whether to give up.
    pub fn is_cancelled(&self) -> bool {
        (self.0)()
    }
}
