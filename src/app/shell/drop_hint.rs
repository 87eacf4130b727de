//! What a file that is dragged over the window will do.

use crate::app::commands::Purpose;
use crate::app::theme;
use egui::{Align2, Context, CornerRadius, Id, LayerId, Order, Stroke, StrokeKind, TextStyle};

/// The sentence for a dropped file of this purpose; `None` for a file that the window cannot read.
pub(crate) fn drop_hint(purpose: Option<Purpose>) -> &'static str {
    match purpose {
        Some(Purpose::AddSurface) => "Drop the file to add its patches to the scene.",
        Some(Purpose::AddTexture) => "Drop the file to add it as a texture.",
        Some(Purpose::OpenReference) => "Drop the file to compare the picture with it.",
        Some(_) => "Drop the file to open it as a scene.",
        None => {
            "The window reads .toml scenes, patches (.bpt, .obj, .pov, .rib), .png and .jpg textures, and .exr references."
        }
    }
}

/// Dims the window while files are dragged over it, and tells what will happen to the first file.
pub(crate) fn drop_hint_ui(ctx: &Context) {
    let hovered = ctx.input(|input| input.raw.hovered_files.first().map(|file| file.path.clone()));
    let Some(path) = hovered else { return };
    let purpose = path.map_or(Some(Purpose::OpenScene), |path| Purpose::of_dropped(&path));
    let style = ctx.global_style();
    let palette = theme::palette(style.visuals.dark_mode);
    let color = if purpose.is_some() { palette.plot } else { palette.warning };
    let (painter, window) =
        (ctx.layer_painter(LayerId::new(Order::Foreground, Id::unique("drop hint"))), ctx.content_rect());
    painter.rect_filled(window, CornerRadius::ZERO, style.visuals.panel_fill.gamma_multiply(0.8));
    painter.rect_stroke(window.shrink(6.0), CornerRadius::same(6), Stroke::new(3.0, color), StrokeKind::Inside);
    let font = TextStyle::Heading.resolve(&style);
    painter.text(window.center(), Align2::CENTER_CENTER, drop_hint(purpose), font, style.visuals.strong_text_color());
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn the_hint_follows_the_extension() {
        let hint = |path: &str| drop_hint(Purpose::of_dropped(Path::new(path)));
        assert!(hint("a/b.TOML").contains("scene") && hint("pot.bpt").contains("patches"));
        assert!(hint("wood.jpg").contains("texture"));
        assert!(hint("picture.EXR").contains("compare"));
        assert_eq!(hint("picture.hdr"), drop_hint(None));
        assert_eq!(hint("README"), drop_hint(None));
    }
}
