//! Applies and remembers the looks of the window.

use super::state::Editor;
use crate::app::canvas::{Analysis, Shading};
use crate::app::keeping::{Preferences, ShadingName, WindowPlace};
use egui::{Context, ThemePreference, ViewportInfo};
use std::time::Instant;

impl Editor {
    /// Gives the window the looks that the user gave the window before.
    pub(crate) fn apply_preferences(&mut self, ctx: &Context, preferences: Preferences) {
        ctx.set_theme(ThemePreference::from(preferences.theme));
        self.show_panels = preferences.show_panels;
        self.show_history = preferences.show_history;
        self.show_hint = preferences.show_hint;
        self.canvas.show_handles = preferences.show_handles;
        self.canvas.sight.x_ray = preferences.x_ray;
        self.canvas.grasp.falloff.on = preferences.soft_selection;
        self.canvas.grasp.grid = preferences.grid;
        self.canvas.matches_window = preferences.match_window;
        self.canvas.analysis.analysis =
            Analysis { isolines: preferences.isolines, shading: shading(preferences.shading) };
        self.canvas.light_paths.on = preferences.light_paths;
        self.rendering.set_smooth(preferences.smooth);
        self.rendering.set_target(Some(preferences.target_error).filter(|error| *error > 0.0));
        self.panel_sizes = preferences.panels;
        self.window_place = preferences.window;
        self.length_unit = preferences.length_unit;
        self.last_folders = preferences.folders;
    }

    /// Keeps the present looks of the window for the next window.
    pub(crate) fn poll_preferences(&mut self, ctx: &Context) {
        ctx.input(|input| self.notice_place(input.viewport()));
        // An edit shows that the user has found what the hint tells.
        self.show_hint &= self.document.undoable().is_none();
        let preferences = Preferences {
            show_panels: self.show_panels,
            show_handles: self.canvas.show_handles,
            x_ray: self.canvas.sight.x_ray,
            soft_selection: self.canvas.grasp.falloff.on,
            smooth: self.rendering.is_smooth(),
            match_window: self.canvas.matches_window,
            grid: self.canvas.grasp.grid,
            isolines: self.canvas.analysis.analysis.isolines,
            shading: shading_name(self.canvas.analysis.analysis.shading),
            light_paths: self.canvas.light_paths.on,
            show_history: self.show_history,
            show_hint: self.show_hint,
            target_error: self.rendering.target().unwrap_or(0.0),
            panels: self.panel_sizes,
            window: self.window_place,
            theme: ctx.options(|options| options.theme_preference).into(),
            length_unit: self.length_unit,
            folders: self.last_folders.clone(),
        };
        self.preferences_file.update(ctx, preferences, Instant::now());
    }

    /// Notices the place of the window. A maximized window keeps the place that it had before; full screen and minimized are no place.
    fn notice_place(&mut self, window: &ViewportInfo) {
        let Some(inner) = window.inner_rect else { return };
        if window.fullscreen == Some(true) || window.minimized == Some(true) {
            return;
        }
        let maximized = window.maximized == Some(true);
        let before = self.window_place.filter(|_| maximized);
        self.window_place = Some(WindowPlace {
            width: before.map_or(inner.width(), |place| place.width),
            height: before.map_or(inner.height(), |place| place.height),
            corner: before.map_or(window.outer_rect.map(|outer| outer.min.into()), |place| place.corner),
            maximized,
        });
    }
}

fn shading(name: ShadingName) -> Option<Shading> {
    match name {
        ShadingName::None => None,
        ShadingName::MeanCurvature => Some(Shading::MeanCurvature),
        ShadingName::GaussianCurvature => Some(Shading::GaussianCurvature),
        ShadingName::Zebra => Some(Shading::Zebra),
    }
}

fn shading_name(shading: Option<Shading>) -> ShadingName {
    match shading {
        None => ShadingName::None,
        Some(Shading::MeanCurvature) => ShadingName::MeanCurvature,
        Some(Shading::GaussianCurvature) => ShadingName::GaussianCurvature,
        Some(Shading::Zebra) => ShadingName::Zebra,
    }
}
