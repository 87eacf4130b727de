//! What outlives the window, and what happens to its files outside.
//!
//! | file | holds |
//! |---|---|
//! | `folders` | [`Folders`]: the user's folders for state and settings |
//! | `background` | a thread that does jobs in their order |
//! | `recent` | [`RecentFiles`]: the scene files that the user opened or saved last |
//! | `preferences` | [`Preferences`]: what the window remembers of its looks |
//! | `preferences_file` | the file of the preferences |
//! | `watch` | [`Watch`]: notices files that other programs change |
//! | `slot` | a file for unsaved changes, locked by its window |
//! | `unsaved_copy` | unsaved changes as the text of a file |
//! | `autosave` | [`Autosave`]: writes unsaved changes soon after an edit |
//! | `left_over` | [`LeftOvers`]: unsaved changes of windows that ended without saving |

mod autosave;
mod background;
mod folders;
mod left_over;
mod preferences;
mod preferences_file;
mod recent;
mod slot;
mod unsaved_copy;
mod watch;

pub(crate) use autosave::Autosave;
#[cfg(test)]
pub(crate) use autosave::Pace;
pub(crate) use folders::Folders;
pub(crate) use left_over::{LeftOverRow, LeftOvers};
pub(crate) use preferences::{LastFolders, PanelSizes, Preferences, ShadingName, WindowPlace};
pub(crate) use preferences_file::{LoadedPreferences, PreferencesFile};
pub(crate) use recent::RecentFiles;
pub(crate) use watch::{OutsideChange, Watch};
