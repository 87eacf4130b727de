//! How the light has changed between two drafts.

use super::grid::{Enlarged, around, filled};
use super::image::Draft;
use crate::film::LinearImage;
use crate::math::Rgb;

/// Radiance that is added to both drafts before they are compared, over the mean radiance: in nearly black pixels a ratio means nothing.
const FLOOR: f32 = 0.02;
/// Relative difference between two depths up to which they are the same: the rays are the same, but the numbers on the way may be rounded
/// in another way.
const SAME_DEPTH: f32 = 1e-4;
/// Spread, around a pixel, of the change of light that has sharp edges, over all light: up to the first value the change counts as smooth,
/// from the second on an edge has moved there. Interreflection changes smoothly everywhere.
const SPREADS: [f32; 2] = [0.05, 0.3];
/// Trust from which on it counts as 1, so that a pixel of the picture before needs no pixel of a draft.
const FULL_TRUST: f32 = 0.95;
/// Changes outside of these limits count as edges: the picture before lacks the details of what was dark or far too bright.
const CHANGES: [f32; 2] = [0.25, 4.0];

/// The change of the light between two drafts of cameras at the same place, with the same number of pixels.
pub(super) struct Change {
    size: [u32; 2],
    cells: Vec<Cell>,
    floor: f32,
}

/// The change of the light around a pixel of a draft.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    /// Radiance after over radiance before.
    ratio: Rgb,
    /// How far the change is smooth, from 0 to 1.
    trust: f32,
}

/// A pixel of a picture before an edit, as it would be after it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Substitute {
    /// Linear radiance, at least 0.
    pub(super) radiance: Rgb,
    /// How far the change is smooth, from 0 to 1.
    pub(super) trust: f32,
    /// The squared relative change, mean over the channels.
    pub(super) squared_change: f32,
}

impl Substitute {
    /// A pixel that the edit does not change.
    pub(super) fn unchanged(radiance: Rgb) -> Self {
        Self { radiance, trust: 1.0, squared_change: 0.0 }
    }

    /// Whether the picture before the edit does not suffice for the pixel.
    pub(super) fn is_doubtful(&self) -> bool {
        self.trust < 1.0
    }
}

impl Change {
    /// The change from one draft to the other.
    pub(super) fn between(before: &Draft, after: &Draft) -> Self {
        let size = after.g_buffer.size;
        let floor = FLOOR * mean(&before.image).max(f32::MIN_POSITIVE);
        let cells =
            (0..after.image.pixels.len()).map(|index| cell(before, after, floor, around(size, index))).collect();
        Self { size, cells, floor }
    }

    /// The pixels of an image before the change as they are after it.
    pub(super) fn applied(&self, image: &LinearImage) -> Vec<Substitute> {
        let size = [image.width, image.height];
        let cells = Enlarged::new(&self.cells, self.size, size, |a: Cell, b: Cell, t| Cell {
            ratio: a.ratio.lerp(b.ratio, t),
            trust: a.trust + t * (b.trust - a.trust),
        });
        filled(size, |y| {
            let pixels = &image.pixels[y as usize * image.width as usize..];
            cells.row(y).zip(pixels).map(|(Cell { ratio, trust }, radiance)| Substitute {
                radiance: ((*radiance + self.floor) * ratio - self.floor).max(Rgb::ZERO),
                trust: if trust >= FULL_TRUST { 1.0 } else { trust },
                squared_change: (ratio - 1.0).length_squared() / 3.0,
            })
        })
    }
}

/// The change around a pixel, given the indices of the pixels there.
fn cell(before: &Draft, after: &Draft, floor: f32, around: impl Iterator<Item = usize>) -> Cell {
    let (mut sums, mut least, mut most, mut same) = ([Rgb::ZERO; 2], f32::INFINITY, f32::NEG_INFINITY, true);
    for index in around {
        let radiance = [before, after].map(|draft| draft.image.pixels[index] + floor);
        let sharp = [before, after].map(|draft| draft.sharp[index].element_sum());
        let change = (sharp[1] - sharp[0]) / radiance[0].element_sum();
        (least, most) = (least.min(change), most.max(change));
        sums = [sums[0] + radiance[0], sums[1] + radiance[1]];
        let [a, b] = [before, after].map(|draft| draft.g_buffer.first_hits[index].depth);
        same &= a == b || (a - b).abs() <= SAME_DEPTH * a.min(b);
    }
    let ratio = sums[1] / sums[0];
    let is_moderate = CHANGES[0] <= ratio.min_element() && ratio.max_element() <= CHANGES[1];
    let smooth = ((SPREADS[1] - (most - least)) / (SPREADS[1] - SPREADS[0])).clamp(0.0, 1.0);
    Cell { ratio, trust: if same && is_moderate { smooth } else { 0.0 } }
}

/// The mean radiance over pixels and channels.
fn mean(image: &LinearImage) -> f32 {
    let sum: f64 = image.pixels.iter().map(|pixel| f64::from(pixel.element_sum())).sum();
    (sum / (3.0 * image.pixels.len() as f64)) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::FirstHit;

    const SIDE: u32 = 8;

    fn draft(sharp: f32, radiance: impl Fn(u32) -> f32) -> Draft {
        let pixels = (0..SIDE * SIDE).map(|index| Rgb::splat(radiance(index % SIDE))).collect();
        Draft::of_pixels(SIDE, pixels, sharp, 2.0)
    }

    /// The pattern of a texture.
    fn texture(column: u32) -> f32 {
        if column.is_multiple_of(2) { 1.0 } else { 3.0 }
    }

    /// A pixel of an image of this radiance as large as the drafts, after the change.
    fn applied(change: &Change, radiance: Rgb, [x, y]: [u32; 2]) -> Substitute {
        let image = LinearImage { width: SIDE, height: SIDE, pixels: vec![radiance; (SIDE * SIDE) as usize] };
        change.applied(&image)[(y * SIDE + x) as usize]
    }

    #[test]
    fn no_change_changes_nothing_and_is_trusted() {
        let change = Change::between(&draft(1.0, texture), &draft(1.0, texture));
        for x in [0, 3, 7] {
            let Substitute { radiance, trust, .. } = applied(&change, Rgb::new(0.1, 2.0, 30.0), [x, 4]);
            assert!((radiance - Rgb::new(0.1, 2.0, 30.0)).length() < 1e-5 && trust == 1.0, "{radiance} {trust}");
        }
    }

    #[test]
    fn brighter_light_on_a_texture_is_trusted() {
        let change = Change::between(&draft(1.0, texture), &draft(1.0, |column| 1.5 * texture(column)));
        let Substitute { radiance, trust, squared_change } = applied(&change, Rgb::splat(2.0), [4, 4]);
        assert!((squared_change - 0.25).abs() < 0.02, "{squared_change}");
        assert!((radiance.x - 3.0).abs() < 0.05 && trust > 0.95, "{radiance} {trust}");
    }

    #[test]
    fn a_moved_edge_is_not_trusted_unless_it_is_one_of_interreflection() {
        let edge = |at: u32| move |column: u32| if column < at { 1.0 } else { 2.0 };
        let trust = |sharp: f32, x: u32| {
            let change = Change::between(&draft(sharp, edge(4)), &draft(sharp, edge(5)));
            applied(&change, Rgb::ONE, [x, 4]).trust
        };
        assert_eq!([trust(1.0, 4), trust(1.0, 1), trust(1.0, 7)], [0.0, 1.0, 1.0]);
        assert_eq!(trust(0.0, 4), 1.0);
    }

    #[test]
    fn another_surface_is_not_trusted_nor_light_on_what_was_dark() {
        let farther = vec![FirstHit { depth: 2.02, is_matte: true, object: None, facet: None }; (SIDE * SIDE) as usize];
        let mut moved = draft(1.0, texture);
        moved.g_buffer.first_hits = farther;
        assert_eq!(applied(&Change::between(&draft(1.0, texture), &moved), Rgb::ONE, [4, 4]).trust, 0.0);
        let lit = |column: u32| if column < 4 { 0.0 } else { 1.0 };
        let change = Change::between(&draft(0.0, lit), &draft(0.0, |_| 1.0));
        assert_eq!([1, 7].map(|x| applied(&change, Rgb::ONE, [x, 4]).trust), [0.0, 1.0]);
    }
}
