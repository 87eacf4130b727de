//! The side panels. Each reads the document and pushes commands; none changes anything itself.

mod control_points;
mod fields;
mod lights;
mod materials;
mod objects;
mod outline;
mod plan;
mod progress;
mod properties;
mod settings;
mod textures;

pub(crate) use outline::outline_ui;
pub(crate) use progress::{ErrorCurve, duration, grouped, progress_ui};
pub(crate) use properties::properties_ui;
