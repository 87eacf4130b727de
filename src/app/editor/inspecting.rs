//! Shows what the picture measures, and writes profiles.

use super::state::Editor;
use crate::app::commands::{Action, PictureView, Purpose};
use egui::Context;
use std::path::PathBuf;

impl Editor {
    /// Shows this of the scene.
    pub(super) fn show_of_scene(&mut self, view: PictureView) {
        let (before, wanted) = [self.inspection.view(), view].map(|view| view == PictureView::Error).into();
        if before != wanted {
            self.rendering.tell_noise(wanted);
        }
        self.inspection.set_view(view);
    }

    /// Shows all light, without a profile: a scene that was opened is shown as it is.
    pub(super) fn show_all_light(&mut self) {
        self.show_of_scene(PictureView::Light);
        self.inspection.set_line(None);
        self.rendering.set_only(None);
    }

    /// Shows the irradiance, or light again.
    pub(super) fn toggle_irradiance(&mut self) {
        let is_on = self.inspection.view() == PictureView::Irradiance;
        self.show_of_scene(if is_on { PictureView::Light } else { PictureView::Irradiance });
    }

    /// Lets the next drag draw the line of a profile; shows the irradiance where the view has no numbers.
    pub(super) fn draw_profile(&mut self) {
        if !self.inspection.has_numbers() {
            self.show_of_scene(PictureView::Irradiance);
        }
        self.inspection.draws_line = !self.inspection.draws_line;
        if self.inspection.draws_line {
            self.toasts.info(format!("Drag a line over the picture. {} ends this.", Action::DrawProfile.label()));
        }
    }

    /// Makes the image of the view of the newest frame.
    pub(super) fn poll_inspection(&mut self, ctx: &Context) {
        self.inspection.update(ctx, self.rendering.frame());
    }

    /// Writes the numbers of the profile as a table.
    pub(super) fn write_profile(&mut self, ctx: &Context, path: PathBuf) {
        let name = match self.inspection.view() {
            PictureView::Irradiance => "irradiance_w_per_m2",
            PictureView::Error => "relative_error",
            _ => "distance",
        };
        if let Some(profile) = self.inspection.profile() {
            self.export.write_text(ctx, Purpose::ExportProfile, profile.csv(name), path);
        }
    }

    /// Asks for a file for the numbers of the profile; says where there is none.
    pub(super) fn export_profile(&mut self, ctx: &Context) {
        if self.inspection.profile().is_some() {
            self.ask_for_path(ctx, Purpose::ExportProfile);
        } else {
            self.toasts.info("Draw the line of a profile first (P)");
        }
    }
}
