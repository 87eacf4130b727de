//! The side panels. Each panel reads the document or the rendering state and pushes commands.
//!
//! | file | holds |
//! |---|---|
//! | `numbers` | numbers as text: short, grouped, as a duration, in percent |
//! | `expression` | arithmetic in number fields |
//! | `glossary` | the explanations of names, for tooltips |
//! | `icons` | icons of the kinds of items |
//! | `presets` | the menu of ready-made materials |
//! | `typing` | typed numbers: relative numbers, and messages on texts that are no numbers |
//! | `fields` | fields for names, numbers, vectors and colours |
//! | `lengths` | number fields of lengths |
//! | `control_points` | the 4 x 4 control points of a patch, and the coordinates of the selected ones |
//! | `coupling` | which control points move together |
//! | `lights` | the properties of a light |
//! | `materials` | the properties of a material |
//! | `revolution` | the angle, the caps and the profile of a surface of revolution |
//! | `objects` | the properties of an object, with its control points and its material |
//! | `settings` | the camera, the picture, the limits of light transport |
//! | `textures` | the properties of a texture |
//! | `properties` | the properties of the selected item |
//! | `outline` | the list of all items in the scene |
//! | `plan` | the rendered and the skipped items of the plan, with reasons |
//! | `error_plot` | the plot of the error estimate over time |
//! | `progress` | display settings, counts, error, time of each pass |

mod control_points;
mod coupling;
mod error_plot;
mod expression;
mod fields;
mod glossary;
mod icons;
mod lengths;
mod lights;
mod materials;
mod numbers;
mod objects;
mod outline;
mod plan;
mod presets;
mod progress;
mod properties;
mod revolution;
mod settings;
mod textures;
mod typing;

pub(crate) use fields::count;
pub(crate) use numbers::{duration, grouped};
pub(crate) use outline::outline_ui;
pub(crate) use progress::progress_ui;
pub(crate) use properties::properties_ui;
pub(crate) use typing::refusals;
