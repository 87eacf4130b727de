//! The scene as the renderer reads it: prepared from a scene, immutable, shared by all threads.
//!
//! | file | holds |
//! |---|---|
//! | `camera` | [`Camera`]: rays of pixels, pixels of points |
//! | `parallel_rays` | [`ParallelRays`] of a sun or a beam |
//! | `precision` | [`Precision`]: how well the points of a surface are known |
//! | `light` | [`Light`]: points, spheres, quads, suns and beams that emit |
//! | `texture` | [`Image`]: decoded textures |
//! | `texture_place` | where patches show their textures |
//! | `material` | [`Material`] with its textures; [`Scattering`] at a point |
//! | `sheets/` | the smooth surfaces that the patches of an object make |
//! | `surface` | [`Surface`], the object or light of a primitive; [`SurfacePoint`], a hit as light transport reads it |
//! | `bodies/` | bodies of glass: which of them contain a point, and which body's medium applies |
//! | `view` | [`View`]: where the surfaces are that the camera sees |
//! | `prepared` | [`World`] |
//! | `probes` | rays that find the view of a world |
//! | `error` | [`PrepareError`] |
//! | `prepare` | [`prepare()`]: from a scene to a world, reusing a previous world |
//! | `warnings` | [`warnings()`]: faults of scenes that can be rendered |

mod bodies;
mod camera;
mod error;
mod light;
mod material;
mod parallel_rays;
mod precision;
mod prepare;
mod prepared;
mod probes;
mod sheets;
mod surface;
mod texture;
mod texture_place;
mod view;
mod warnings;

pub use bodies::{Body, Contacts, LightMedia, Media};
pub use camera::{Camera, Projected};
pub use error::PrepareError;
pub use light::Light;
pub use material::{Lobe, Material, Scattering};
pub use parallel_rays::ParallelRays;
pub use precision::Precision;
pub use prepare::prepare;
pub use prepared::World;
pub use sheets::SharedEdges;
pub use surface::{Surface, SurfacePoint};
pub use texture::Image;
pub use view::View;
pub use warnings::{Warning, warnings};
