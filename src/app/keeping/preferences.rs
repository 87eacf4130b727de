//! What the window remembers of its looks.

use crate::app::commands::{LengthUnit, Purpose};
use crate::scene::{MAX_LENGTH, MIN_LENGTH};
use egui::{Rect, ThemePreference, Vec2, vec2};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What the window remembers of its looks, and the folders that the user chose last.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Preferences {
    pub(crate) show_panels: bool,
    pub(crate) show_handles: bool,
    /// Whether handles are shown as if no object hid them.
    pub(crate) x_ray: bool,
    pub(crate) soft_selection: bool,
    /// Whether the picture has the size of the canvas.
    pub(crate) match_window: bool,
    /// Whether the screen shows less noise in the interreflection than the picture has.
    pub(crate) smooth: bool,
    /// The step of the snapping grid, scene units; `None` for the automatic step.
    pub(crate) grid: Option<f64>,
    /// Whether lines of constant u and v are drawn over the selected surface.
    pub(crate) isolines: bool,
    pub(crate) shading: ShadingName,
    /// Whether the paths of light at the selected surface are drawn.
    pub(crate) light_paths: bool,
    pub(crate) show_history: bool,
    /// Whether to show the hint for a first start.
    pub(crate) show_hint: bool,
    /// The relative error at which rendering stops; 0 for never.
    pub(crate) target_error: f64,
    pub(crate) theme: ThemeName,
    pub(crate) panels: PanelSizes,
    /// `None` before the first window.
    pub(crate) window: Option<WindowPlace>,
    pub(crate) length_unit: LengthUnit,
    pub(crate) folders: LastFolders,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            show_panels: true,
            show_handles: true,
            x_ray: false,
            soft_selection: false,
            match_window: false,
            smooth: true,
            grid: None,
            isolines: false,
            shading: ShadingName::default(),
            light_paths: false,
            show_history: false,
            show_hint: true,
            target_error: 0.001,
            theme: ThemeName::default(),
            panels: PanelSizes::default(),
            window: None,
            length_unit: LengthUnit::default(),
            folders: LastFolders::default(),
        }
    }
}

impl Preferences {
    /// The preferences with the numbers that no window can have replaced by usual ones.
    pub(super) fn within_limits(mut self) -> Self {
        let usual = Self::default();
        if !(0.0..=1.0).contains(&self.target_error) {
            self.target_error = usual.target_error;
        }
        self.grid = self.grid.filter(|step| (MIN_LENGTH..=MAX_LENGTH).contains(step));
        let PanelSizes { progress, scene, outline } = &mut self.panels;
        for (size, usual) in
            [(progress, usual.panels.progress), (scene, usual.panels.scene), (outline, usual.panels.outline)]
        {
            if !(1.0..=10_000.0).contains(size) {
                *size = usual;
            }
        }
        self.window = self.window.filter(WindowPlace::is_possible);
        self
    }
}

/// The dark or the light theme, or the system's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ThemeName {
    #[default]
    System,
    Dark,
    Light,
}

impl From<ThemePreference> for ThemeName {
    fn from(theme: ThemePreference) -> Self {
        match theme {
            ThemePreference::System => Self::System,
            ThemePreference::Dark => Self::Dark,
            ThemePreference::Light => Self::Light,
        }
    }
}

impl From<ThemeName> for ThemePreference {
    fn from(theme: ThemeName) -> Self {
        match theme {
            ThemeName::System => Self::System,
            ThemeName::Dark => Self::Dark,
            ThemeName::Light => Self::Light,
        }
    }
}

/// The colours over the selected surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ShadingName {
    #[default]
    None,
    MeanCurvature,
    GaussianCurvature,
    Zebra,
}

/// The sizes that the user gave the panels, screen points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct PanelSizes {
    /// Width of the progress panel.
    pub(crate) progress: f32,
    /// Width of the scene panel.
    pub(crate) scene: f32,
    /// Height of the outline. The default fits every section of a scene with ten objects.
    pub(crate) outline: f32,
}

impl Default for PanelSizes {
    fn default() -> Self {
        Self { progress: 240.0, scene: 372.0, outline: 390.0 }
    }
}

/// The part of a title bar that is enough to grasp it, screen points.
const TITLE_BAR: Vec2 = vec2(80.0, 30.0);

/// The place of the window on the desktop while it is not maximized, screen points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct WindowPlace {
    pub(crate) width: f32,
    pub(crate) height: f32,
    /// The top left corner with the title bar; `None` where the desktop does not tell.
    pub(crate) corner: Option<[f32; 2]>,
    pub(crate) maximized: bool,
}

impl WindowPlace {
    /// Whether the user can grasp the title bar on one of the monitors, which may be others than before; screen points. Without known
    /// monitors any place will do.
    pub(crate) fn is_reachable(&self, monitors: &[Rect]) -> bool {
        let Some(corner) = self.corner else { return true };
        let title_bar = Rect::from_min_size(corner.into(), vec2(self.width, TITLE_BAR.y));
        let can_grasp = |monitor: &Rect| {
            let seen = monitor.intersect(title_bar);
            seen.width() >= TITLE_BAR.x && seen.height() >= 0.5 * TITLE_BAR.y
        };
        monitors.is_empty() || monitors.iter().any(can_grasp)
    }

    fn is_possible(&self) -> bool {
        let sizes = 100.0..=30_000.0;
        let corners = -100_000.0..=100_000.0;
        sizes.contains(&self.width)
            && sizes.contains(&self.height)
            && self.corner.iter().flatten().all(|x| corners.contains(x))
    }
}

/// The folders that the user chose last, by the purpose of the file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct LastFolders(BTreeMap<String, String>);

impl LastFolders {
    /// Remembers the folder of a chosen path. A folder whose path is no Unicode text is not remembered.
    pub(crate) fn remember(&mut self, purpose: Purpose, path: &Path) {
        let folder = std::path::absolute(path).ok().and_then(|path| path.parent().map(Path::to_path_buf));
        if let Some(folder) = folder.as_deref().and_then(Path::to_str) {
            self.0.insert(purpose.key().to_owned(), folder.to_owned());
        }
    }

    /// The folder that the user chose last for this purpose; `None` where it is gone.
    pub(crate) fn of(&self, purpose: Purpose) -> Option<PathBuf> {
        self.0.get(purpose.key()).map(PathBuf::from).filter(|folder| folder.is_dir())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_beside_all_monitors_is_out_of_reach() {
        let monitor = |x: f32| Rect::from_min_size([x, 0.0].into(), vec2(1000.0, 800.0));
        let is_reachable = |x, y, monitors: &[Rect]| {
            let place = WindowPlace { width: 600.0, height: 400.0, corner: Some([x, y]), maximized: false };
            place.is_reachable(monitors)
        };
        let both = [monitor(0.0), monitor(1000.0)];
        assert!(is_reachable(1500.0, 100.0, &both));
        assert!(!is_reachable(1500.0, 100.0, &both[..1]), "its monitor is gone");
        assert!(is_reachable(-500.0, -10.0, &both) && !is_reachable(-550.0, 0.0, &both), "a part is enough");
        assert!(!is_reachable(100.0, -40.0, &both), "the title bar is above the monitor");
        assert!(is_reachable(9000.0, 0.0, &[]), "without known monitors");
    }

    #[test]
    fn impossible_numbers_become_usual_ones() {
        let window = |width, x| Some(WindowPlace { width, height: 500.0, corner: Some([x, 0.0]), maximized: false });
        let panels = PanelSizes { progress: f32::NAN, scene: 400.0, outline: -3.0 };
        let odd = Preferences {
            target_error: -1.0,
            grid: Some(f64::NAN),
            panels,
            window: window(f32::INFINITY, 0.0),
            ..Default::default()
        };
        let usual = PanelSizes { scene: 400.0, ..PanelSizes::default() };
        assert_eq!(odd.within_limits(), Preferences { panels: usual, ..Default::default() });
        let far = Preferences { window: window(800.0, 1e30), ..Default::default() };
        assert_eq!(far.within_limits().window, None);
        let fine = Preferences { window: window(800.0, -50.0), ..Default::default() };
        assert_eq!(fine.clone().within_limits(), fine);
        for (grid, expected) in [(0.25, Some(0.25)), (0.0, None), (-1.0, None), (1e300, None)] {
            assert_eq!(Preferences { grid: Some(grid), ..Default::default() }.within_limits().grid, expected);
        }
    }
}
