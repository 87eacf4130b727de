//! The window's content, without the window and without the engine.
//!
//! | file | holds |
//! |---|---|
//! | `state` | [`Editor`]: all that the window shows and remembers |
//! | `files` | opening, saving and exporting |
//! | `apply` | the one place that carries out commands |
//! | `tests` | the editor as a user meets it |

mod apply;
mod files;
mod state;

#[cfg(test)]
mod tests;

pub(crate) use state::Editor;
