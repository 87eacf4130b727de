//! What the user describes: plain data that can be cloned, compared, loaded and saved. It knows nothing of rendering.
//!
//! The file format is one TOML file; every type here mirrors one table of it. [`SceneFile`] opens and saves;
//! [`validate`] checks a scene that a file or a window has made; [`Location`] finds the files that a scene names.

mod bezier;
mod built_in;
mod camera;
mod error;
mod file;
mod film;
mod light;
mod load;
mod location;
mod material;
mod object;
mod problem;
mod render;
mod save;
mod surface_export;
mod texture;
mod validate;

pub use bezier::{Bezier, Transform};
pub use built_in::{BuiltInScene, built_in_scenes};
pub use camera::Camera;
pub use error::{LocatedProblem, SceneError};
pub use file::SceneFile;
pub use film::{Film, ToneCurve};
pub use light::{Emitter, Light};
pub use location::Location;
pub use material::{Color, Material, MaterialModel, Relief};
pub use object::{Object, Shape};
pub use problem::Problem;
pub use render::Render;
pub use surface_export::{SurfaceExport, SurfaceFormat};
pub use texture::{Encoding, Texture, TextureUse};
pub use validate::validate;

/// Everything there is to see, by whom, and how it is shown.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Scene {
    /// For the window's title and for people; may be empty.
    pub name: String,
    /// The eye.
    pub camera: Camera,
    /// The picture.
    pub film: Film,
    /// What light transport is computed.
    pub render: Render,
    /// Images that materials refer to by name.
    pub textures: Vec<Texture>,
    /// Surfaces' looks, that objects refer to by name.
    pub materials: Vec<Material>,
    /// Where light comes from.
    pub lights: Vec<Light>,
    /// The surfaces.
    pub objects: Vec<Object>,
}
