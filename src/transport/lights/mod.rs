//! Lights: how paths leave them, and how points sample them.
//!
//! | file | holds |
//! |---|---|
//! | `emission` | the first ray of a light path |
//! | `light_sampler` | sampling of many lights by expected contribution |
//! | `projection_map` | directions in which a light meets mirrors and glass |
//! | `direct` | direct light at a vertex: next event estimation |

pub(in crate::transport) mod direct;
pub(in crate::transport) mod emission;
pub(in crate::transport) mod light_sampler;
mod projection_map;

pub(in crate::transport) use direct::DirectLight;
pub use light_sampler::LightSampler;
pub use projection_map::ProjectionMap;
