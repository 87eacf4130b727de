//! The scene as the user describes it: plain data that can be cloned, compared, loaded and saved. Independent of
//! rendering.
//!
//! A scene file is one TOML file; each type mirrors a table of it.
//!
//! | file | holds |
//! |---|---|
//! | `uv_rect` | [`UvRect`]: the part of texture space that a patch shows |
//! | `camera`, `film`, `render`, `texture`, `material`, `light`, `object`, `bezier`, `revolution` | the tables of a scene |
//! | `data` | [`Scene`], all tables |
//! | `problem` | [`Problem`]: one error in a scene, by the path of the value |
//! | `error` | [`SceneError`], [`LocatedProblem`]: errors with line and column |
//! | `built_in` | the scenes inside the program |
//! | `location` | [`Location`]: finds the files that a scene names |
//! | `validate/` | [`validate()`]: the errors of a scene, from a file or from the window |
//! | `load/`, `save/` | from text to a scene, and back |
//! | `surface_scene` | the scene that shows the patches of a file |
//! | `file/` | [`SceneFile`]: opens and saves scenes with the files that they name |
//! | `fingerprint` | a number that tells scenes apart |
//! | `snapshot` | the state of a scene as text, valid or not |
//! | `surface_export` | [`SurfaceExport`]: patches for other programs |

mod bezier;
mod built_in;
mod camera;
mod data;
mod error;
mod file;
mod film;
mod fingerprint;
mod light;
mod load;
mod location;
mod material;
mod object;
mod problem;
mod render;
mod revolution;
mod save;
mod snapshot;
mod surface_export;
mod surface_scene;
mod texture;
mod uv_rect;
mod validate;

pub use bezier::{Bezier, Transform};
pub use built_in::{BuiltInScene, built_in_scenes};
pub use camera::Camera;
pub use data::Scene;
pub use error::{LocatedProblem, SceneError};
pub use file::SceneFile;
pub use film::{Film, ToneCurve};
pub use light::{Emitter, Light};
pub use location::Location;
pub use material::{Color, Material, MaterialModel, Relief};
pub use object::{BodyKey, Object, Shape};
pub use problem::Problem;
pub use render::Render;
pub use revolution::Revolution;
pub use surface_export::{SurfaceExport, SurfaceFormat, SurfaceOptions};
pub use texture::{Encoding, Texture, TextureUse};
pub use uv_rect::UvRect;
pub use validate::{MAX_LENGTH, MAX_RADIANCE, MIN_LENGTH, validate};
