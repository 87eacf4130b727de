//! The user's folders for state and settings.

use etcetera::{AppStrategy, AppStrategyArgs, choose_app_strategy};
use std::path::PathBuf;

/// The folders of this program below the user's home folder. They may not exist yet.
#[derive(Clone, Debug)]
pub(crate) struct Folders {
    /// For what the program may forget without harm to the user's files, such as recent files, and for unsaved changes.
    pub(crate) state: PathBuf,
    /// For preferences.
    pub(crate) config: PathBuf,
}

impl Folders {
    /// The folders by the conventions of the system, on Linux the XDG base directories; `None` for a user without a home folder.
    pub(crate) fn of_user() -> Option<Self> {
        let name = || "patchlight".to_owned();
        let names = AppStrategyArgs { top_level_domain: "org".to_owned(), author: name(), app_name: name() };
        let folders = choose_app_strategy(names).ok()?;
        // Only XDG has a folder of its own for state.
        let state = folders.state_dir().unwrap_or_else(|| folders.data_dir());
        Some(Self { state, config: folders.config_dir() })
    }

    /// The folder for unsaved changes.
    pub(crate) fn unsaved(&self) -> PathBuf {
        self.state.join("unsaved")
    }

    /// The file with the list of recent files.
    pub(crate) fn recent(&self) -> PathBuf {
        self.state.join("recent.toml")
    }

    /// The file with the preferences.
    pub(crate) fn preferences(&self) -> PathBuf {
        self.config.join("preferences.toml")
    }
}
