//! The file of the preferences.

use super::background::Background;
use super::preferences::Preferences;
use crate::file::{folder, read_text_limited, write_whole};
use egui::Context;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use std::{fs, io};
use toml::Table;

/// Time without a further change after which changes are written.
const REST: Duration = Duration::from_secs(2);
/// Most bytes of the file that are read.
const MAX_BYTES: u64 = 1 << 20;

/// The preferences at the start of a window.
#[derive(Clone, Debug, Default)]
pub(crate) struct LoadedPreferences {
    pub(crate) preferences: Preferences,
    /// Why the file was ignored; `None` for a file in order, and without a file.
    pub(crate) damage: Option<String>,
}

impl LoadedPreferences {
    /// Reads the preferences. A damaged file is ignored and renamed, so that it is not lost at the next write.
    pub(crate) fn read(path: &Path) -> Self {
        let text = match read_text_limited(path, MAX_BYTES) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Self::default(),
            Err(error) => return Self::damaged(path, &error.to_string()),
        };
        match toml::from_str::<Preferences>(&text) {
            Ok(preferences) => Self { preferences: preferences.within_limits(), damage: None },
            Err(error) => Self::damaged(path, error.message()),
        }
    }

    fn damaged(path: &Path, error: &str) -> Self {
        let aside = path.with_extension("damaged.toml");
        let place = if fs::rename(path, &aside).is_ok() { aside } else { path.to_owned() };
        let damage = format!("The preferences in {} are ignored: {error}", place.display());
        Self { damage: Some(damage), ..Self::default() }
    }
}

/// The file of the preferences, which follows their changes.
#[derive(Default)]
pub(crate) struct PreferencesFile {
    /// The file's path, and the thread that writes it; `None` to keep nothing.
    kept: Option<(PathBuf, Background<()>)>,
    written: Preferences,
    present: Preferences,
    changed: Option<Instant>,
}

impl PreferencesFile {
    /// Keeps changes of `preferences` in this file from now on.
    pub(crate) fn keep_in(&mut self, path: PathBuf, preferences: &Preferences) {
        self.written = preferences.clone();
        self.present = preferences.clone();
        self.kept = Some((path, Background::new("preferences", ())));
    }

    /// Writes changed preferences if it is time. Call it once a frame.
    pub(crate) fn update(&mut self, ctx: &Context, present: Preferences, now: Instant) {
        if self.kept.is_none() {
            return;
        }
        if present != self.present {
            self.present = present;
            self.changed = Some(now);
        }
        let Some(changed) = self.changed else { return };
        let wait = (changed + REST).saturating_duration_since(now);
        if wait.is_zero() {
            self.write();
        } else {
            ctx.request_repaint_after(wait);
        }
    }

    fn write(&mut self) {
        self.changed = None;
        if let Some((path, thread)) = self.kept.as_ref().filter(|_| self.written != self.present) {
            let (path, before, after) = (path.clone(), self.written.clone(), self.present.clone());
            // A failure costs the user nothing but the looks of the next window.
            thread.run(move |()| drop(merge(&path, &before, &after)));
            self.written = self.present.clone();
        }
    }
}

impl Drop for PreferencesFile {
    fn drop(&mut self) {
        self.write();
    }
}

/// Writes the keys that differ. Other keys stay as the file has them: another window or another version of the program may have written
/// them.
fn merge(path: &Path, before: &Preferences, after: &Preferences) -> io::Result<()> {
    let text = read_text_limited(path, MAX_BYTES).unwrap_or_default();
    let mut table: Table = toml::from_str(&text).unwrap_or_default();
    let before = Table::try_from(before).map_err(io::Error::other)?;
    for (key, value) in Table::try_from(after).map_err(io::Error::other)? {
        if before.get(&key) != Some(&value) {
            table.insert(key, value);
        }
    }
    fs::create_dir_all(folder(path))?;
    write_whole(path, toml::to_string_pretty(&table).map_err(io::Error::other)?.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::super::preferences::WindowPlace;
    use super::*;
    use egui::ThemePreference;

    #[test]
    fn preferences_are_read_as_they_were_written_and_unknown_keys_stay() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/preferences.toml");
        let usual = Preferences::default();
        let window = WindowPlace { width: 900.0, height: 700.0, corner: Some([-8.0, 30.5]), maximized: true };
        let theme = ThemePreference::Light.into();
        let changed = Preferences { show_panels: false, theme, window: Some(window), ..usual.clone() };
        merge(&path, &usual, &changed).unwrap();
        assert_eq!(LoadedPreferences::read(&path).preferences, changed);
        fs::write(&path, "from_a_later_version = 3\n".to_owned() + &fs::read_to_string(&path).unwrap()).unwrap();
        let again = Preferences { show_handles: false, ..changed.clone() };
        merge(&path, &changed, &again).unwrap();
        let loaded = LoadedPreferences::read(&path);
        assert_eq!((loaded.preferences, loaded.damage), (again, None));
        assert!(fs::read_to_string(&path).unwrap().contains("from_a_later_version = 3"));
    }

    #[test]
    fn a_damaged_file_is_told_and_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("preferences.toml");
        assert_eq!(LoadedPreferences::read(&path).damage, None, "no file");
        fs::write(&path, "theme = \"pink\"").unwrap();
        let loaded = LoadedPreferences::read(&path);
        assert_eq!(loaded.preferences, Preferences::default());
        assert!(loaded.damage.is_some_and(|damage| damage.contains("preferences.damaged.toml are ignored: ")));
        assert!(!path.exists());
        assert_eq!(fs::read_to_string(path.with_extension("damaged.toml")).unwrap(), "theme = \"pink\"");
    }
}
