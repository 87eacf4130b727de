//! What outlives the window.
//!
//! | file | holds |
//! |---|---|
//! | `folders` | [`Folders`]: the user's folders for state and settings |
//! | `background` | [`Background`]: a thread that does jobs in their order |
//! | `slot` | [`Slot`]: a file for unsaved changes, locked by its window |
//! | `unsaved_copy` | [`UnsavedCopy`]: unsaved changes as the text of a file |
//! | `autosave` | [`Autosave`]: writes unsaved changes soon after an edit |
//! | `left_over` | [`LeftOvers`]: unsaved changes of windows that ended without saving |

mod autosave;
mod background;
mod folders;
mod left_over;
mod slot;
mod unsaved_copy;

pub(crate) use autosave::Autosave;
#[cfg(test)]
pub(crate) use autosave::Pace;
pub(crate) use folders::Folders;
pub(crate) use left_over::{LeftOverRow, LeftOvers};
