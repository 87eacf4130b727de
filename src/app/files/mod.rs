//! Files: asking for paths, and writing pictures and surfaces.
//!
//! | file | holds |
//! |---|---|
//! | `paths` | proposed paths, and the extensions of chosen paths |
//! | `chooser` | [`Chooser`]: the desktop's file dialogs, on a thread of their own |
//! | `path_field` | [`PathField`]: a typed path, where no file dialog is available |
//! | `export` | [`Export`]: writing of pictures and surfaces off the UI thread |

mod chooser;
mod export;
mod path_field;
mod paths;

pub(crate) use chooser::{Chooser, Outcome, Request};
pub(crate) use export::{Export, surface_of};
pub(crate) use path_field::PathField;
pub(crate) use paths::{complete, proposed};
