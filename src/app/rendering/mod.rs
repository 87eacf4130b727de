//! The engine as the window sees it.
//!
//! | file | holds |
//! |---|---|
//! | `state` | [`Rendering`]: the newest frame and the engine's status |
//! | `display` | [`Display`]: the texture of the newest picture, tone-mapped off the UI thread |

mod display;
mod state;

pub(crate) use display::Display;
pub(crate) use state::Rendering;
