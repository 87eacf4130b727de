//! Points where light meets a surface.
//!
//! | file | holds |
//! |---|---|
//! | `bsdf` | scattering functions: Lambert, Phong, Fresnel |
//! | `surfaces` | how a primitive's surface scatters light |
//! | `vertex` | a vertex of a light or camera path |
//! | `interface` | directions at an interface with a shading normal |
//! | `specular` | the scattering event at mirrors and glass; Russian roulette |
//! | `glossy_mis` | MIS weights between camera paths and photons in Phong lobes |
//! | `visible_point` | where the camera gathers photons |

pub(in crate::transport) mod bsdf;
pub(in crate::transport) mod glossy_mis;
mod interface;
mod specular;
mod surfaces;
mod vertex;
mod visible_point;

pub use bsdf::{Fresnel, fresnel};
pub use glossy_mis::GlossyMis;
pub(in crate::transport) use glossy_mis::{MisVertex, ViewingLobe};
pub(in crate::transport) use specular::{Continuation, SpecularEvent, roulette};
pub(in crate::transport) use vertex::Vertex;
pub(in crate::transport) use visible_point::LEAST_COS_OF_NEIGHBOURS;
pub use visible_point::{Clearance, Facet, VisiblePoint};
