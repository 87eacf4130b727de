//! Photons: how they travel, and the maps that store them.
//!
//! | file | holds |
//! |---|---|
//! | `photon` | a stored photon and its tag |
//! | `signature` | the sequence of surfaces on the way of light |
//! | `caustic_branch` | the state of light that only mirrors and glass have touched |
//! | `stored` | the photons that the photon passes store |
//! | `cosine_correction` | photons that arrived where the surface has another normal |
//! | `photon_map/` | the kd-tree |
//! | `maps` | the four maps of an iteration |
//! | `path_blocks` | photon paths in blocks for threads |
//! | `photon_path` | the state of a photon path of interreflection, and how surfaces scatter it |
//! | `global_tracer` | photon paths of interreflection |

mod caustic_branch;
mod cosine_correction;
pub(in crate::transport) mod global_tracer;
mod maps;
pub(in crate::transport) mod path_blocks;
pub(in crate::transport) mod photon;
pub(in crate::transport) mod photon_map;
mod photon_path;
mod signature;
mod stored;

pub(in crate::transport) use caustic_branch::CausticBranch;
pub(in crate::transport) use cosine_correction::CosineCorrection;
pub use maps::{MapKind, Maps, PerMap};
pub use photon::Photon;
pub use photon_map::{PhotonMap, Query};
pub(in crate::transport) use signature::Signature;
pub use stored::{GlobalPhotons, Splat};
