//! A picture for the screen: the draft of a scene, and the picture before the edit where that stands in for it.

use super::change::{Change, Substitute};
use super::grid::{filled, sample};
use super::image::Draft;
use super::reprojection::Reprojection;
use super::upsampling::Upsampling;
use crate::engine::g_buffer::GBuffer;
use crate::film::LinearImage;
use crate::world::Camera;
use std::sync::Arc;

/// Iterations, as full ones, after which the new picture stands for itself.
const FADING_WEIGHT: f64 = 16.0;
/// Squared relative change from which on a pixel of the picture before is worth at most one full iteration: a draft of few photons knows a
/// change roughly. Without this limit a picture from before a light was moved was still visible after a second.
const CHANGE_NOISE: f32 = 0.02;

/// The picture before an edit, with a draft of its scene.
pub(in crate::engine) struct Before<'a> {
    pub(in crate::engine) image: &'a LinearImage,
    /// The iterations in the picture, as full ones.
    pub(in crate::engine) weight: f64,
    /// The camera with the film's grid.
    pub(in crate::engine) camera: Camera,
    pub(in crate::engine) draft: &'a Draft,
}

/// The picture before an edit, changed as a draft says, which stands in for what the edit has hardly changed.
#[derive(Debug)]
pub(in crate::engine) struct Preview {
    size: [u32; 2],
    pixels: Vec<Substitute>,
    /// The iterations in the picture before the edit.
    weight: f64,
}

impl Before<'_> {
    /// The preview for a camera with the film's grid, of which there is a draft of the same size as that of the picture before.
    pub(in crate::engine) fn preview(&self, camera: Camera, after: &Draft) -> Preview {
        let (own, before, old) = (self.camera, self.draft, self.image);
        let size = [old.width, old.height];
        let pixels = if own == camera {
            Change::between(before, after).applied(old)
        } else {
            let reprojection = Reprojection::new([own, camera], [before, after]);
            let pixel = |x: u32, y: u32| {
                let then = reprojection.before(x as f32 + 0.5, y as f32 + 0.5);
                then.map_or(Substitute::default(), |[x, y]| Substitute::unchanged(sample(old, x, y)))
            };
            let pixel = &pixel;
            filled(size, |y| (0..old.width).map(move |x| pixel(x, y)))
        };
        Preview { size, pixels, weight: self.weight }
    }
}

impl Preview {
    /// The pixels of a draft of this coarseness that the preview lacks.
    pub(in crate::engine) fn doubtful_pixels(&self, coarseness: u32) -> Arc<[bool]> {
        let size = self.size.map(|side| side.div_ceil(coarseness));
        // The pixels of the film that lie between the middles of a pixel of the draft and its neighbours, if the draft is coarse.
        let between = |at: u32, side: u32| {
            let (from, to) = (at * coarseness, (at + 1) * coarseness);
            (from.saturating_sub(coarseness / 2) as usize, (to + coarseness / 2).min(side) as usize)
        };
        let width = self.size[0] as usize;
        let is_doubtful = |column: u32, row: u32| {
            let ((left, right), (top, bottom)) = (between(column, self.size[0]), between(row, self.size[1]));
            (top..bottom).any(|y| self.pixels[y * width + left..y * width + right].iter().any(Substitute::is_doubtful))
        };
        let is_doubtful = &is_doubtful;
        filled(size, |row| (0..size[0]).map(move |column| is_doubtful(column, row))).into()
    }

    /// The number of pixels of the film that the preview lacks.
    pub(in crate::engine) fn doubtful(&self) -> usize {
        self.pixels.iter().filter(|pixel| pixel.is_doubtful()).count()
    }

    /// The picture with the doubtful pixels of a draft of the scene after the edit, given its detail there, if it has any.
    pub(in crate::engine) fn with_draft(&self, draft: &Draft, detail: Option<&GBuffer>) -> LinearImage {
        let drafted = Upsampling::new(draft, detail, draft.shown(), self.size);
        let (drafted, [width, height]) = (&drafted, self.size);
        let pixels = filled(self.size, |y| {
            (0..width).zip(&self.pixels[(y * width) as usize..]).map(move |(x, old)| {
                if old.is_doubtful() { drafted.at(x, y).lerp(old.radiance, old.trust) } else { old.radiance }
            })
        });
        LinearImage { width, height, pixels }
    }

    /// The picture together with that of the scene after the edit after iterations of this weight; `None` once that stands for itself.
    pub(in crate::engine) fn with_iterations(&self, image: &LinearImage, weight: f64) -> Option<LinearImage> {
        let fading = 1.0 - weight / FADING_WEIGHT;
        if fading <= 0.0 {
            return None;
        }
        let (fading, own, weight) = (fading as f32, self.weight as f32, weight as f32);
        let pixels = image.pixels.iter().zip(&self.pixels).map(|(new, old)| {
            // The iterations that the old pixel is worth: the change adds to its error, in proportion to itself.
            let worth = 1.0 / (1.0 / own + old.squared_change / CHANGE_NOISE);
            new.lerp(old.radiance, old.trust * fading * worth / (worth + weight))
        });
        let pixels = pixels.collect();
        Some(LinearImage { pixels, ..*image })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;

    fn image(values: [f32; 3]) -> LinearImage {
        LinearImage { width: 3, height: 1, pixels: values.map(Rgb::splat).into() }
    }

    fn preview() -> Preview {
        let pixel = |(value, trust)| Substitute { trust, ..Substitute::unchanged(Rgb::splat(value)) };
        Preview { size: [3, 1], pixels: [(1.0, 1.0), (2.0, 0.5), (3.0, 0.0)].map(pixel).into(), weight: 30.0 }
    }

    fn values(image: &LinearImage) -> Vec<f32> {
        image.pixels.iter().map(|pixel| pixel.x).collect()
    }

    #[test]
    fn the_new_picture_takes_over_where_the_old_one_is_trusted_and_at_once_elsewhere() {
        let value = |weight| preview().with_iterations(&image([5.0; 3]), weight).map(|image| values(&image));
        let soon = value(0.1).unwrap();
        assert!(soon[0] < 1.1 && (3.4..3.6).contains(&soon[1]) && soon[2] == 5.0, "{soon:?}");
        let later = value(10.0).unwrap();
        assert!(soon[0] < later[0] && later[0] < 5.0, "{later:?}");
        assert_eq!(value(FADING_WEIGHT), None);
    }

    #[test]
    fn a_pixel_that_has_changed_gives_way_sooner() {
        let mut changed = preview();
        changed.pixels.iter_mut().for_each(|pixel| pixel.squared_change = 0.1);
        let first = |preview: &Preview| values(&preview.with_iterations(&image([5.0; 3]), 1.0).unwrap())[0];
        assert!(first(&preview()) < 1.4 && first(&changed) > 4.0, "{} {}", first(&preview()), first(&changed));
    }

    #[test]
    fn a_draft_with_all_pixels_fills_in_the_doubtful_ones() {
        assert_eq!(*preview().doubtful_pixels(1), [false, true, true]);
        assert_eq!(preview().doubtful(), 2);
        let draft = Draft::of_pixels(3, vec![Rgb::splat(9.0); 3], 1.0, 1.0);
        assert_eq!(values(&preview().with_draft(&draft, None)), [1.0, 5.5, 9.0]);
        let smoothed = Draft { smoothed: Some(Arc::new(image([7.0; 3]))), ..draft };
        assert_eq!(values(&preview().with_draft(&smoothed, None)), [1.0, 4.5, 7.0], "as a screen shows it");
    }

    #[test]
    fn a_coarse_draft_has_all_pixels_between_which_a_doubtful_pixel_lies() {
        let trust = |index: u32| if index == 5 * 16 + 7 { 0.0 } else { 1.0 };
        let pixel = |index| Substitute { trust: trust(index), ..Substitute::unchanged(Rgb::ONE) };
        let preview = Preview { size: [16; 2], pixels: (0..16 * 16).map(pixel).collect(), weight: 1.0 };
        let doubtful = preview.doubtful_pixels(4);
        let chosen: Vec<usize> = (0..16).filter(|index| doubtful[*index]).collect();
        assert_eq!(chosen, [1, 2, 5, 6], "around (7, 5)");
    }
}
