//! What the renderer reads: prepared from a scene, immutable, shared by all threads.

mod camera;
mod light;
mod material;
mod prepare;
mod surface;
mod texture;

pub use camera::{Camera, Projected};
pub use light::Light;
pub use material::{Lobe, Material, Scattering};
pub use prepare::{PrepareError, prepare};
pub use surface::{SharedEdges, Surface, SurfacePoint};
pub use texture::Image;

use crate::geometry::Aggregate;
use crate::math::Rgb;
use glam::DVec3;
use std::sync::Arc;
use texture::TextureKey;

/// A scene as the renderer reads it.
#[derive(Clone, Debug)]
pub struct World {
    /// All surfaces, lights with an area included.
    pub aggregate: Aggregate,
    /// What each primitive of the aggregate is.
    pub surfaces: Vec<Surface>,
    /// In the order of the scene.
    pub materials: Vec<Material>,
    /// In the order of the scene; lights without power are left out.
    pub lights: Vec<Light>,
    /// The eye and the film's grid.
    pub camera: Camera,
    /// Radiance of what a ray sees when it leaves the scene.
    pub background: Rgb,
    /// Scattering events between light and eye on the longest path.
    pub max_bounces: u32,
    /// The middle of everything that has bounds.
    pub center: DVec3,
    /// Half the diagonal of everything that has bounds; above 0.
    pub radius: f64,
    textures: Vec<(TextureKey, Arc<Image>)>,
}
