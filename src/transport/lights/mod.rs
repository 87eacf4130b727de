//! Lights: how paths leave them, and how points sample them.
//!
//! | file | holds |
//! |---|---|
//! | `emission` | the first ray of a light path |
//! | `light_sampler` | sampling of many lights by expected contribution |
//! | `small_targets` | a quadtree over a chart for objects that appear small from a light |
//! | `cone` | cones of places in a chart |
//! | `chart` | how the unit square of a projection map covers the first rays of paths |
//! | `pencil` | the rays of a light through one of its points |
//! | `bundle` | the rays from a wide light to a small ball |
//! | `rays_to_ball` | the first rays of paths that may meet a ball, in the chart or as a bundle |
//! | `probe_rays` | probe rays into the cells of a chart, and to small objects |
//! | `projection_map` | paths on which a light meets mirrors and glass |
//! | `photon_emission` | how photons of interreflection leave a light |
//! | `spherical_quad` | the solid angle of a quad, and directions drawn evenly in it |
//! | `direct` | direct light at a vertex: next event estimation |

mod bundle;
mod chart;
mod cone;
pub(in crate::transport) mod direct;
pub(in crate::transport) mod emission;
pub(in crate::transport) mod light_sampler;
mod pencil;
mod photon_emission;
mod probe_rays;
mod projection_map;
mod rays_to_ball;
mod small_targets;
mod spherical_quad;

pub(in crate::transport) use direct::{DirectLight, SeenBy};
pub use light_sampler::LightSampler;
pub(in crate::transport) use pencil::Pencil;
pub use photon_emission::PhotonEmission;
pub(in crate::transport) use probe_rays::SIDE as PROJECTION_SIDE;
pub use projection_map::ProjectionMap;
