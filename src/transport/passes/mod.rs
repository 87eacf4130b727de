//! The passes of an iteration, in the order in which they run.
//!
//! | file | holds |
//! |---|---|
//! | `input` | the input that all passes have in common |
//! | `light_sheets` | the pass that traces light sheets |
//! | `caustic_photons` | the caustic photon pass: light to mirrors and glass, to the film or the caustic map |
//! | `global_photons` | the photon pass of interreflection |
//! | `camera/` | the camera pass: direct light and visible points |
//! | `interleaving` | points that gather irradiance for their neighbours |
//! | `pixel_footprint` | what part of a surface a pixel shows |
//! | `visible_parts` | which parts of a pixel show a surface |
//! | `gathered` | the result of the gather pass |
//! | `gather` | the gather pass: density estimates at visible points |
//! | `lobe_sample` | the light that a pixel sees in its Phong lobe |
//! | `lobe_reuse` | spatial reuse of Phong lobe samples |
//! | `guides` | what pixels show |
//! | `band` | one band's result, and the iteration's contribution to the film |

mod band;
mod camera;
mod caustic_photons;
mod gather;
mod gathered;
mod global_photons;
mod guides;
mod input;
mod interleaving;
mod light_sheets;
mod lobe_reuse;
mod lobe_sample;
mod pixel_footprint;
mod visible_parts;

#[cfg(test)]
mod tests;

pub use band::{Band, Contribution};
pub use camera::{CameraBatch, FirstHit, camera_pass, g_buffer};
pub use caustic_photons::{CausticPhotons, caustic_photon_pass};
pub use gather::gather;
pub use gathered::{Gathered, GatheredBatch};
pub use global_photons::global_photon_pass;
pub use guides::{Guides, SeenSurface};
pub use input::PassInput;
pub use lobe_reuse::lobe_samples;
pub use lobe_sample::LobeSample;
