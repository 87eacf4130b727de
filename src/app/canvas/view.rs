//! Zoom and pan: the map between film pixels and screen points. Knows no widget.

use egui::{Pos2, Rect, Vec2, pos2, vec2};
use glam::DVec2;

/// The range of scales, screen points per film pixel.
const SCALE_RANGE: std::ops::RangeInclusive<f32> = 0.02..=256.0;
/// Margin around a fitted picture, screen points.
const MARGIN: f32 = 12.0;

/// The user's zoom and pan.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(crate) enum View {
    /// The whole picture, as large as fits, centred.
    #[default]
    Fit,
    /// A fixed scale and position.
    Free {
        /// Screen points per film pixel.
        scale: f32,
        /// The film point at the canvas centre, film pixels.
        center: Vec2,
    },
}

/// The map between film pixels and screen points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ScreenTransform {
    /// The rectangle of the canvas, screen points.
    pub(crate) canvas: Rect,
    /// The film size, pixels.
    pub(crate) film: Vec2,
    /// Screen points per film pixel.
    pub(crate) scale: f32,
    center: Vec2,
}

impl View {
    /// The transform of a film of `film` pixels on a canvas.
    pub(crate) fn transform(&self, canvas: Rect, film: Vec2) -> ScreenTransform {
        match *self {
            Self::Fit => ScreenTransform::fitting(canvas, film, MARGIN),
            Self::Free { scale, center } => ScreenTransform { canvas, film, scale, center },
        }
    }
}

impl ScreenTransform {
    /// The whole film, as large as fits with a margin in screen points, centred.
    fn fitting(canvas: Rect, film: Vec2, margin: f32) -> Self {
        let largest = (canvas.size() - Vec2::splat(2.0 * margin)).max(Vec2::splat(1.0)) / film;
        let scale = largest.min_elem().clamp(*SCALE_RANGE.start(), *SCALE_RANGE.end());
        Self { canvas, film, scale, center: 0.5 * film }
    }

    /// The whole film without a margin; one film pixel per screen pixel where the canvas has as many whole pixels as the film.
    pub(crate) fn filling(canvas: Rect, film: Vec2, pixels_per_point: f32) -> Self {
        let fitting = Self::fitting(canvas, film, 0.0);
        let surplus = canvas.size() * pixels_per_point - film;
        // The film was made from a size that may differ by rounding.
        let agrees = surplus.min_elem() > -0.1 && surplus.max_elem() < 1.1;
        if agrees { fitting.one_to_one(pixels_per_point).transform(canvas, film) } else { fitting }
    }

    /// The rectangle of the picture, screen points; it may extend beyond the canvas.
    pub(crate) fn picture(&self) -> Rect {
        Rect::from_min_max(self.to_screen(DVec2::ZERO), self.to_screen_vec(self.film))
    }

    /// The screen point of a film point.
    pub(crate) fn to_screen(self, film: DVec2) -> Pos2 {
        self.to_screen_vec(vec2(film.x as f32, film.y as f32))
    }

    fn to_screen_vec(self, film: Vec2) -> Pos2 {
        self.canvas.center() + (film - self.center) * self.scale
    }

    /// The film point of a screen point.
    pub(crate) fn to_film(self, screen: Pos2) -> DVec2 {
        let film = (screen - self.canvas.center()) / self.scale + self.center;
        DVec2::new(f64::from(film.x), f64::from(film.y))
    }

    /// Column and row of the pixel under a screen point; `None` outside the picture.
    pub(crate) fn pixel(&self, screen: Pos2) -> Option<(u32, u32)> {
        let film = self.to_film(screen);
        let inside =
            film.cmpge(DVec2::ZERO).all() && film.x < f64::from(self.film.x) && film.y < f64::from(self.film.y);
        inside.then_some((film.x as u32, film.y as u32))
    }

    /// The view after zooming by `factor` about the film point under `cursor`.
    pub(crate) fn zoomed(&self, factor: f32, cursor: Pos2) -> View {
        let scale = (self.scale * factor).clamp(*SCALE_RANGE.start(), *SCALE_RANGE.end());
        let fixed = (cursor - self.canvas.center()) / self.scale + self.center;
        View::Free { scale, center: fixed - (cursor - self.canvas.center()) / scale }
    }

    /// The view after the picture moved by `delta` screen points. The canvas centre stays on the film, so part of the picture
    /// stays visible.
    pub(crate) fn panned(&self, delta: Vec2) -> View {
        View::Free { scale: self.scale, center: (self.center - delta / self.scale).clamp(Vec2::ZERO, self.film) }
    }

    /// The view with one film pixel per screen pixel, aligned to screen pixels, around the same centre.
    pub(crate) fn one_to_one(&self, pixels_per_point: f32) -> View {
        let scale = 1.0 / pixels_per_point;
        let corner = self.canvas.center() - self.center * scale;
        let snapped = pos2((corner.x / scale).round(), (corner.y / scale).round()) * scale;
        View::Free { scale, center: (self.canvas.center() - snapped) / scale }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Screen coordinates are f32 of size 1000 with a rounding error of 6e-5; a few operations stay far below 1e-2 points.
    const TOLERANCE: f32 = 1e-2;

    fn canvas() -> Rect {
        Rect::from_min_size(pos2(100.0, 50.0), vec2(800.0, 600.0))
    }

    #[test]
    fn fit_shows_the_whole_picture_centred() {
        let transform = View::Fit.transform(canvas(), vec2(512.0, 512.0));
        assert!(canvas().contains_rect(transform.picture()), "{:?}", transform.picture());
        assert!((transform.picture().height() - (600.0 - 2.0 * MARGIN)).abs() < TOLERANCE, "as large as fits");
        assert!(transform.picture().center().distance(canvas().center()) < TOLERANCE, "centred");
    }

    #[test]
    fn zooming_keeps_the_pixel_under_the_cursor() {
        let cursor = pos2(321.0, 234.0);
        let before = View::Fit.transform(canvas(), vec2(512.0, 384.0));
        for factor in [0.5, 1.1, 7.0] {
            let after = before.zoomed(factor, cursor).transform(canvas(), vec2(512.0, 384.0));
            let moved = after.to_screen(before.to_film(cursor)).distance(cursor);
            assert!(moved < TOLERANCE, "moved by {moved} at factor {factor}");
        }
    }

    #[test]
    fn zoom_stays_in_its_range() {
        let mut view = View::Fit;
        for _ in 0..200 {
            view = view.transform(canvas(), vec2(512.0, 512.0)).zoomed(1.5, canvas().center());
        }
        assert!(view.transform(canvas(), vec2(512.0, 512.0)).scale <= *SCALE_RANGE.end(), "{view:?}");
    }

    #[test]
    fn film_and_screen_are_inverse_and_pixels_end_at_the_border() {
        let transform = View::Free { scale: 3.0, center: vec2(10.0, 20.0) }.transform(canvas(), vec2(64.0, 32.0));
        let film = DVec2::new(12.25, 31.5);
        assert!(transform.to_film(transform.to_screen(film)).distance(film) < f64::from(TOLERANCE), "round trip");
        assert_eq!(transform.pixel(transform.to_screen(film)), Some((12, 31)));
        assert_eq!(transform.pixel(transform.to_screen(DVec2::new(64.5, 3.0))), None);
        assert_eq!(transform.pixel(transform.to_screen(DVec2::new(-0.5, 3.0))), None);
    }

    #[test]
    fn panning_moves_the_picture_with_the_pointer_and_keeps_it_visible() {
        let transform = View::Fit.transform(canvas(), vec2(512.0, 512.0));
        let after = transform.panned(vec2(30.0, -20.0)).transform(canvas(), vec2(512.0, 512.0));
        assert!((after.picture().min - transform.picture().min - vec2(30.0, -20.0)).length() < TOLERANCE, "follows");
        let far = transform.panned(vec2(1e6, 1e6)).transform(canvas(), vec2(512.0, 512.0));
        assert!(far.picture().intersects(canvas()), "still on the canvas");
    }

    #[test]
    fn a_film_of_the_size_of_the_canvas_fills_it_pixel_by_pixel() {
        for ppp in [1.0, 1.25, 2.0] {
            let canvas = Rect::from_min_size(pos2(100.3, 50.0), vec2(800.3, 600.7));
            let film = (canvas.size() * ppp).floor();
            let filling = ScreenTransform::filling(canvas, film, ppp);
            assert!((filling.scale * ppp - 1.0).abs() < 1e-6, "{} at {ppp}", filling.scale);
            let corner = filling.picture().min.to_vec2() * ppp;
            assert!((corner - corner.round()).length() < TOLERANCE, "{corner:?} at {ppp}");
            assert!(filling.picture().expand(1.0 / ppp).contains_rect(canvas), "{:?}", filling.picture());
            let other = ScreenTransform::filling(canvas, vec2(512.0, 384.0), ppp);
            assert!((other.picture().height() - 600.225).abs() < 0.1, "as large as fits: {:?}", other.picture());
        }
    }

    #[test]
    fn one_to_one_puts_pixels_on_pixels() {
        for ppp in [1.0, 1.25, 2.0] {
            let transform = View::Fit.transform(canvas(), vec2(511.0, 333.0));
            let aligned = transform.one_to_one(ppp).transform(canvas(), vec2(511.0, 333.0));
            let corner = aligned.picture().min.to_vec2() * ppp;
            assert!((corner - corner.round()).length() < TOLERANCE, "{corner:?} at {ppp}");
            assert!((aligned.picture().width() * ppp - 511.0).abs() < TOLERANCE, "one pixel on one pixel");
        }
    }
}
