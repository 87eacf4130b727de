//! Files: asking for paths, and writing pictures and surfaces.
//!
//! | file | holds |
//! |---|---|
//! | `chooser` | the desktop's file dialogs, on a thread of their own |
//! | `path_field` | a typed path, where no file dialog is available |
//! | `export` | writing of pictures and surfaces off the UI thread |

mod chooser;
mod export;
mod path_field;

pub(crate) use chooser::{Chooser, Outcome, Purpose, Request};
pub(crate) use export::Export;
pub(crate) use path_field::{PathField, complete};
