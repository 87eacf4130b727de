//! Light transport: scattering at surfaces, the plan of what a scene needs, and the passes of an iteration.
//!
//! The vertices of a path of light tell its [`Component`], from the light to the camera: L light, S mirror or glass, D the last diffuse
//! or glossy surface, G a Phong lobe through which the camera sees, E eye.
//!
//! | paths | vertices | component | found by |
//! |---|---|---|---|
//! | emission | `L S* E` | direct | [`camera_pass`] |
//! | direct light | `L D S* E` | direct | [`camera_pass`], next event estimation |
//! | visible caustics | `L S+ D E` | caustics | [`caustic_photon_pass`]: light sheets; for the rest splats where the caustic is sharp, else density estimate |
//! | caustics in mirrors and glass | `L S+ D S+ E` | caustics | [`caustic_photon_pass`]: light sheets; for the rest density estimate |
//! | interreflection | `L .. D .. D S* E` | interreflection | [`global_photon_pass`], density estimate |
//! | light in gloss | `L .. D S* G S* E` | as without the lobe | [`camera_pass`], and photons with the MIS weights of [`GlossyMis`] |
//!
//! Photons in a Phong lobe belong to interreflection, with the share of light that their MIS weights give them.
//!
//! A pass is a function of the world, the plan, the seed and the number of the iteration ([`PassInput`]), and returns owned data.
//! `docs/method.md` holds the equations. The folders are in the order in which light meets them; each uses only folders above it:
//!
//! | file | holds |
//! |---|---|
//! | `pass`, `counters`, `energy` | rows, cancellation and work counters of all passes; the energy balance of photon paths |
//! | `points/` | scattering at a point of a surface |
//! | `lights/` | emission and sampling of lights |
//! | `photons/` | photons and their maps |
//! | `light_sheets/` | sheets of light: caustics without photons |
//! | `light_paths/` | what a designer reads from a surface: images of its lines, edges of caustics |
//! | `density/` | density estimation, and the measurements that improve it |
//! | `plan/` | which work a scene needs, and how it is rendered |
//! | `passes/` | the passes of an iteration |

mod counters;
mod density;
mod energy;
mod light_paths;
mod light_sheets;
mod lights;
mod pass;
mod passes;
mod photons;
mod plan;
mod points;
#[cfg(test)]
mod testing;

pub use counters::{Counted, Counters};
pub use density::{Bandwidth, BandwidthDifference, FilmStatistics, PixelSamples};
pub use energy::{Energy, PathEnergy, WorstBalance};
pub use light_paths::{LightPaths, Polyline, light_paths};
pub use light_sheets::LightSheets;
pub use lights::{LightSampler, PhotonEmission, ProjectionMap};
pub use pass::{Cancel, Rows};
pub use passes::{
    Band, CameraBatch, CausticPhotons, Contribution, FirstHit, Gathered, GatheredBatch, Guides, LobeSample, PassInput,
    SeenSurface, camera_pass, caustic_photon_pass, g_buffer, gather, global_photon_pass, lobe_samples,
};
pub use photons::{GlobalPhotons, MapKind, Maps, PerMap, Photon, PhotonMap, Query, Splat};
pub use plan::{
    CausticPlan, Component, DraftSize, MeasuredPlan, Plan, PlanItem, PlanNote, Radii, SheetLattice, UnseenLight,
};
pub use points::{Clearance, Facet, Fresnel, GlossyMis, VisiblePoint, fresnel};
