//! The engine as the window sees it: scenes and commands go out, frames come in and become a texture.
//!
//! | file | holds |
//! |---|---|
//! | `same_picture` | whether two scenes have the same picture |
//! | `submission` | the scene that the engine renders, and the problems that keep a scene from it |
//! | `renames` | [`Renames`]: new names in the engine's texts |
//! | `error_curve` | [`ErrorCurve`]: the error estimate over time |
//! | `state` | [`Rendering`]: the newest frame, the engine's status, the commands for the engine |
//! | `sampling` | [`Sampling`]: how the screen samples the picture |
//! | `background_image` | an image that another thread makes |
//! | `display` | [`Display`]: the texture of the newest picture, tone-mapped off the UI thread |

mod background_image;
mod display;
mod error_curve;
mod renames;
mod same_picture;
mod sampling;
mod state;
mod submission;

pub(crate) use background_image::BackgroundImage;
pub(crate) use display::Display;
pub(crate) use error_curve::ErrorCurve;
pub(crate) use renames::Renames;
pub(crate) use sampling::Sampling;
pub(crate) use state::Rendering;
