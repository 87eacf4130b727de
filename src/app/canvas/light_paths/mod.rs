//! What light does at the selected surface of mirror or glass, drawn over the picture. Restarts no rendering.
//!
//! | file | holds |
//! |---|---|
//! | `request` | what to trace, or why there is nothing to trace |
//! | `paint` | painting of curves in the room |
//! | `legend` | the colours of the curves; or why there are none |
//! | `layer` | [`LightPathLayer`]: the curves over the picture, traced off the UI thread |

mod layer;
mod legend;
mod paint;
mod request;

pub(crate) use layer::LightPathLayer;
