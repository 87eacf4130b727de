//! What the picture measures: irradiance, error, distance; albedo and normals.
//!
//! | file | holds |
//! |---|---|
//! | `field` | a number for each pixel |
//! | `colors` | false colours and isolines |
//! | `statistics` | least, mean and greatest number over an object |
//! | `profile` | numbers along a line |
//! | `state` | [`Inspection`]: the view of the canvas, made by another thread |
//! | `legend` | the colours with their numbers, and the number at the pointer |
//! | `profile_window` | the plot of a profile, and the line on the picture |

mod colors;
mod field;
mod legend;
mod profile;
mod profile_window;
mod state;
mod statistics;

pub(crate) use legend::legend_ui;
pub(crate) use profile_window::{line_ui, profile_ui};
pub(crate) use state::Inspection;
