//! Every colour of the window.

use egui::style::ScrollStyle;
use egui::{Color32, Context, CornerRadius, Stroke, Theme, Visuals};

/// The colours that egui's style lacks, of one theme.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Palette {
    /// The background of the canvas.
    pub(crate) canvas: Color32,
    /// The border of the picture.
    pub(crate) frame: Color32,
    /// Errors and failures.
    pub(crate) error: Color32,
    /// Warnings, and states that wait.
    pub(crate) warning: Color32,
    /// Progress and success.
    pub(crate) success: Color32,
    /// The line of a plot.
    pub(crate) plot: Color32,
    /// The axes x, y and z, and the channels red, green and blue.
    pub(crate) axes: [Color32; 3],
}

const DARK: Palette = Palette {
    canvas: Color32::from_rgb(24, 25, 28),
    frame: Color32::from_rgb(70, 72, 78),
    error: Color32::from_rgb(255, 122, 112),
    warning: Color32::from_rgb(242, 190, 84),
    success: Color32::from_rgb(120, 205, 130),
    plot: Color32::from_rgb(110, 178, 255),
    axes: [Color32::from_rgb(240, 110, 115), Color32::from_rgb(130, 205, 100), Color32::from_rgb(105, 160, 255)],
};

const LIGHT: Palette = Palette {
    canvas: Color32::from_rgb(212, 213, 216),
    frame: Color32::from_rgb(150, 152, 158),
    error: Color32::from_rgb(178, 28, 22),
    warning: Color32::from_rgb(138, 88, 0),
    success: Color32::from_rgb(24, 112, 44),
    plot: Color32::from_rgb(20, 92, 190),
    axes: [Color32::from_rgb(190, 35, 45), Color32::from_rgb(50, 120, 20), Color32::from_rgb(25, 80, 200)],
};

/// The colours drawn over the picture. Both themes share them, because the picture does not depend on the theme.
pub(crate) mod overlay {
    use egui::Color32;

    /// The outline of lines and handles, which keeps them visible on white and on black.
    pub(crate) const OUTLINE: Color32 = Color32::from_rgba_premultiplied(0, 0, 0, 170);
    /// The control net in the side panel.
    pub(crate) const NET: Color32 = Color32::from_rgb(150, 196, 255);
    /// The control nets of all other patches, and what an object hides.
    pub(crate) const NET_FAINT: Color32 = Color32::from_rgba_premultiplied(60, 78, 102, 102);
    /// A handle.
    pub(crate) const HANDLE: Color32 = Color32::from_rgb(235, 242, 255);
    /// The handle under the pointer.
    pub(crate) const HOVERED: Color32 = Color32::from_rgb(255, 226, 120);
    /// A selected handle.
    pub(crate) const SELECTED: Color32 = Color32::from_rgb(255, 150, 40);
    /// The tint of a picture that does not show the present scene.
    pub(crate) const OUTDATED: Color32 = Color32::from_gray(90);
    /// The lines between magnified pixels, visible on white and on black.
    pub(crate) const GRID: Color32 = Color32::from_rgba_premultiplied(56, 56, 56, 112);
    /// A handle that an object hides.
    pub(crate) const HIDDEN: Color32 = Color32::from_rgba_premultiplied(70, 73, 77, 90);
    /// A control point of a patch that is not current.
    pub(crate) const FAINT: Color32 = Color32::from_rgba_premultiplied(110, 136, 170, 190);
    /// The arrow along the surface normal.
    pub(crate) const NORMAL: Color32 = Color32::from_rgb(225, 150, 255);
    /// Isolines.
    pub(crate) const ISOLINE: Color32 = Color32::from_rgb(240, 244, 255);
    /// Negative, no and positive curvature.
    pub(crate) const CURVATURE: [Color32; 3] =
        [Color32::from_rgb(20, 70, 200), Color32::from_rgb(236, 236, 228), Color32::from_rgb(205, 40, 20)];
    /// The stripes of reflection lines.
    pub(crate) const ZEBRA: [Color32; 2] = [Color32::from_rgb(14, 14, 18), Color32::from_rgb(246, 246, 246)];
    /// The opacity of curvature and reflection lines: some of the picture shows through.
    pub(crate) const ANALYSIS_OPACITY: f32 = 0.9;
    /// The images of lines of equal u, and of lines of equal v.
    pub(crate) const LIGHT_IMAGE: [Color32; 2] = [Color32::from_rgb(110, 215, 255), Color32::from_rgb(150, 236, 130)];
    /// The edges of caustics.
    pub(crate) const CAUSTIC_EDGE: Color32 = Color32::from_rgb(255, 80, 170);
    /// The ways of light in the room.
    pub(crate) const LIGHT_WAY: Color32 = Color32::from_rgba_premultiplied(36, 33, 14, 36);
    /// A pixel without a number.
    pub(crate) const NO_VALUE: Color32 = Color32::from_gray(58);
    /// The background and the text of a legend over the picture.
    pub(crate) const LEGEND: Color32 = Color32::from_rgba_premultiplied(16, 17, 20, 225);
    pub(crate) const LEGEND_TEXT: Color32 = Color32::from_rgb(230, 232, 238);
    /// A light.
    pub(crate) const LIGHT: Color32 = Color32::from_rgb(255, 236, 130);
}

/// The palette of the dark or the light theme.
pub(crate) fn palette(dark_mode: bool) -> &'static Palette {
    if dark_mode { &DARK } else { &LIGHT }
}

/// Installs both themes and the spacing.
pub(crate) fn install(ctx: &Context) {
    ctx.set_visuals_of(
        Theme::Dark,
        visuals(Visuals::dark(), Color32::from_rgb(40, 92, 160), Color32::from_rgb(236, 243, 255)),
    );
    ctx.set_visuals_of(
        Theme::Light,
        visuals(Visuals::light(), Color32::from_rgb(160, 200, 250), Color32::from_rgb(0, 40, 90)),
    );
    ctx.all_styles_mut(|style| {
        style.spacing.item_spacing = egui::vec2(6.0, 5.0);
        style.spacing.interact_size.y = 20.0;
        style.spacing.slider_width = 130.0;
        // A hidden scroll bar would not show that more content follows.
        style.spacing.scroll = ScrollStyle::solid();
    });
}

fn visuals(mut visuals: Visuals, selected: Color32, on_selected: Color32) -> Visuals {
    visuals.selection.bg_fill = selected;
    visuals.selection.stroke = Stroke::new(1.0, on_selected);
    visuals.window_corner_radius = CornerRadius::same(6);
    let palette = palette(visuals.dark_mode);
    visuals.error_fg_color = palette.error;
    visuals.warn_fg_color = palette.warning;
    if visuals.dark_mode {
        // The default greys of egui have too little contrast for small text on dark panels.
        visuals.widgets.noninteractive.fg_stroke.color = Color32::from_gray(190);
        visuals.widgets.inactive.fg_stroke.color = Color32::from_gray(210);
        visuals.weak_text_color = Some(Color32::from_gray(150));
    } else {
        visuals.widgets.noninteractive.fg_stroke.color = Color32::from_gray(50);
        visuals.weak_text_color = Some(Color32::from_gray(95));
    }
    visuals
}
