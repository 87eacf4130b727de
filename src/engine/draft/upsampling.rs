//! Joint bilateral upsampling \[Kopf07\]: the light of a draft at more pixels than it has, of which the first ray alone is known.
//!
//! Silhouettes and textures are cheap and sharp, light is dear and mostly smooth: a pixel takes the light of the pixels around it that show the
//! same surface under about the same normal, times its own albedo over theirs. Where it is known what pixels show in mirrors and through glass,
//! that counts, too.

use super::grid::{Between, around, filled, middle};
use super::image::Draft;
use crate::engine::g_buffer::{GBuffer, Reflected};
use crate::film::LinearImage;
use crate::math::Rgb;
use crate::transport::FirstHit;
use glam::Vec3;
use std::f32::consts::PI;

/// Most pixels of a detail along the side of a pixel of its draft. More would show finer edges, and make the picture later.
const FINER: u32 = 3;
/// Weight of a pixel of the draft, beside its bilinear one: the only one of a surface may have hardly any.
const LEAST_WEIGHT: f32 = 1e-3;
/// Albedo that is added to both before one is divided by the other: the light of a dark surface may come from a Phong lobe.
const FLOOR: f32 = 0.05;

/// The coarseness of the detail for a draft of this coarseness; `None` if the draft has all pixels.
pub(in crate::engine) fn detail_coarseness(of_draft: u32) -> Option<u32> {
    (of_draft > 1).then(|| of_draft.div_ceil(FINER))
}

/// The pixels of a film that a draft and its detail show.
pub(in crate::engine) struct Upsampling<'a> {
    draft: &'a GBuffer,
    /// A finer grid than the draft's.
    detail: Option<&'a GBuffer>,
    image: &'a LinearImage,
    film: [u32; 2],
}

/// What a pixel shows.
struct Seen {
    first_hit: FirstHit,
    /// In a mirror or through glass; `None` if that is not known.
    reflected: Option<Option<Reflected>>,
}

impl<'a> Upsampling<'a> {
    /// The pixels of a film of this width and height for `image`, a picture with the pixels of the draft; bilinear means without a detail.
    pub(in crate::engine) fn new(
        draft: &'a Draft,
        detail: Option<&'a GBuffer>,
        image: &'a LinearImage,
        film: [u32; 2],
    ) -> Self {
        Self { draft: &draft.g_buffer, detail, image, film }
    }

    /// The whole picture.
    pub(in crate::engine) fn picture(&self) -> LinearImage {
        let [width, height] = self.film;
        LinearImage { width, height, pixels: filled(self.film, |y| (0..width).map(move |x| self.at(x, y))) }
    }

    /// The radiance of a pixel of the film.
    pub(super) fn at(&self, x: u32, y: u32) -> Rgb {
        let on = |[width, height]: [u32; 2]| [middle(x, self.film[0], width), middle(y, self.film[1], height)];
        let size = self.draft.size;
        let [column, row] = on(size);
        let between = Between::new(size, column, row);
        let Some(detail) = self.detail else { return between.color(|index| self.image.pixels[index]) };
        let nearest = |[column, row]: [f32; 2], [width, height]: [u32; 2]| {
            ((row as u32).min(height - 1) * width + (column as u32).min(width - 1)) as usize
        };
        let seen = &Seen::at(detail, on(detail.size), nearest(on(detail.size), detail.size));
        self.light(seen, between.weights()).unwrap_or_else(|| {
            // The middles of the nearest pixels may all lie on other surfaces.
            let near = around(size, nearest([column, row], size)).map(|index| (index, LEAST_WEIGHT));
            let known = seen.first_hit.facet.and_then(|_| self.light(seen, near));
            known.unwrap_or_else(|| between.color(|index| self.image.pixels[index]))
        })
    }

    /// The light at a pixel that shows this, given pixels of the draft with their weights; `None` if these show nothing like it.
    fn light(&self, seen: &Seen, pixels: impl IntoIterator<Item = (usize, f32)>) -> Option<Rgb> {
        let (mut sum, mut weights) = (Rgb::ZERO, 0.0);
        for (index, weight) in pixels {
            let other = &Seen::by(self.draft, index);
            let weight = (weight + LEAST_WEIGHT) * seen.likeness(other);
            if weight > 0.0 {
                sum += weight * self.image.pixels[index] * seen.brightness_over(other);
                weights += weight;
            }
        }
        (weights > 0.0).then(|| sum / weights)
    }
}

impl Seen {
    /// What a pixel shows.
    fn by(pixels: &GBuffer, index: usize) -> Self {
        let reflected = pixels.knows_reflections().then(|| pixels.reflected(index));
        Self { first_hit: pixels.first_hits[index], reflected }
    }

    /// What is seen at a position, given the pixel there: the albedo is the mean between the pixels of the same surface, because a texture of
    /// blocks is harder to recognise than a blurred one.
    fn at(pixels: &GBuffer, [x, y]: [f32; 2], index: usize) -> Self {
        let mut seen = Self::by(pixels, index);
        if let Some(own) = &mut seen.first_hit.facet {
            let (mut sum, mut weights) = (LEAST_WEIGHT * own.albedo, LEAST_WEIGHT);
            for (index, weight) in Between::new(pixels.size, x, y).weights() {
                if let Some(facet) = pixels.first_hits[index].facet.filter(|facet| facet.tag == own.tag) {
                    (sum, weights) = (sum + weight * facet.albedo, weights + weight);
                }
            }
            own.albedo = sum / weights;
        }
        seen
    }

    /// How alike the light can be expected to be, from 0 to 1: 0 on different surfaces, less for different normals.
    fn likeness(&self, other: &Self) -> f32 {
        let directly = match (self.first_hit.facet, other.first_hit.facet) {
            (Some(a), Some(b)) if a.tag == b.tag => by_normals(a.normal, b.normal),
            // Lamps, and the background.
            (None, None) if self.first_hit.depth.is_finite() == other.first_hit.depth.is_finite() => 1.0,
            _ => 0.0,
        };
        let reflected = match (self.reflected, other.reflected) {
            (Some(Some(a)), Some(Some(b))) if a.surface.tag == b.surface.tag => {
                by_normals(a.surface.normal, b.surface.normal)
            }
            (Some(Some(_)), Some(_)) | (Some(_), Some(Some(_))) => 0.0,
            _ => 1.0,
        };
        directly * reflected
    }

    /// How bright this looks over the other in the same light.
    fn brightness_over(&self, other: &Self) -> Rgb {
        let [own, others] = match (self.reflected, other.reflected) {
            (Some(Some(a)), Some(Some(b))) => [a, b].map(|seen| PI * seen.reflectance),
            _ => [self, other].map(|seen| seen.first_hit.facet.map_or(Rgb::ZERO, |facet| facet.albedo)),
        };
        (own + FLOOR) / (others + FLOOR)
    }
}

/// How alike the light on two sides of a surface of these normals can be expected to be, from 0 to 1.
fn by_normals(a: Vec3, b: Vec3) -> f32 {
    (0.5 + 0.5 * a.dot(b)).max(0.0).powi(8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::{Facet, Guides, SeenSurface};

    /// Pixels of the film along a side; each of the draft is four wide.
    const SIDE: u32 = 16;

    fn hit(tag: u32, normal: Vec3, albedo: f32) -> FirstHit {
        let facet = Facet { normal, albedo: Rgb::splat(albedo), tag, position: Vec3::ZERO };
        FirstHit { depth: 1.0, is_matte: true, object: None, facet: Some(facet) }
    }

    /// The film's picture of a draft of this radiance and these first hits, given by the column of the film.
    fn upsampled(radiance: impl Fn(u32) -> f32, hits: impl Fn(u32) -> FirstHit) -> Vec<f32> {
        let columns = || (0..4 * 4).map(|index| index % 4 * 4 + 2);
        let mut draft = Draft::of_pixels(4, columns().map(|x| Rgb::splat(radiance(x))).collect(), 1.0, 1.0);
        draft.g_buffer.first_hits = columns().map(&hits).collect();
        let first_hits = (0..SIDE * SIDE).map(|index| hits(index % SIDE)).collect();
        let detail = GBuffer::of_first_hits([SIDE; 2], first_hits);
        let picture = Upsampling::new(&draft, Some(&detail), &draft.image, [SIDE; 2]).picture();
        picture.pixels[5 * SIDE as usize..][..SIDE as usize].iter().map(|pixel| pixel.x).collect()
    }

    #[test]
    fn a_silhouette_is_as_sharp_as_the_detail() {
        let ball = |x: u32| (5..11).contains(&x);
        let light = |x| if ball(x) { 3.0 } else { 1.0 };
        let row = upsampled(light, |x| hit(if ball(x) { 8 } else { 0 }, Vec3::Z, 0.5));
        for (x, value) in (0..).zip(row) {
            assert!((value - light(x)).abs() < 1e-5, "{value} in column {x}");
        }
    }

    #[test]
    fn a_texture_is_as_sharp_as_the_detail() {
        let albedo = |x: u32| if x.is_multiple_of(2) { 0.8 } else { 0.4 };
        let row = upsampled(|x| 2.0 * albedo(x), |x| hit(0, Vec3::Z, albedo(x)));
        assert!(row.iter().zip(0..).all(|(value, x)| (value / (2.0 * albedo(x)) - 1.0).abs() < 0.06), "{row:?}");
    }

    #[test]
    fn light_is_smooth_on_a_surface_and_follows_its_normal() {
        let row = upsampled(|x| x as f32, |_| hit(0, Vec3::Z, 0.5));
        assert!((2..14).all(|x| (row[x] - x as f32).abs() < 0.6), "{row:?}");
        let folded = |x: u32| if x < 8 { Vec3::X } else { Vec3::Z };
        let row = upsampled(|x| if x < 8 { 1.0 } else { 2.0 }, |x| hit(0, folded(x), 0.5));
        assert!(row[7] < 1.05 && row[8] > 1.95, "{row:?}");
    }

    #[test]
    fn a_surface_that_the_draft_lacks_has_the_light_around_it() {
        let thin = |x: u32| hit(if x == 4 { 8 } else { 0 }, Vec3::Z, 0.5);
        assert_eq!(upsampled(|_| 1.0, thin)[4], 1.0);
        let lamp = FirstHit { facet: None, ..hit(0, Vec3::Z, 0.5) };
        let row = upsampled(|x| if x < 7 { 5.0 } else { 1.0 }, |x| if x < 7 { lamp } else { hit(0, Vec3::Z, 0.5) });
        assert_eq!([row[6], row[7]], [5.0, 1.0], "the edge of a lamp");
    }

    /// A mirror that shows a red surface in its left half and a textured white one in its right half.
    #[test]
    fn what_a_mirror_shows_is_as_sharp_as_the_detail() {
        let albedo = |x: u32| if x < 7 { 0.3 } else { [0.4, 0.8][x as usize % 2] };
        let seen = |x: u32| SeenSurface {
            position: Vec3::ZERO,
            normal: Vec3::Z,
            footprint: 1.0,
            tag: if x < 7 { 16 } else { 24 },
            seen_directly: false,
        };
        let g_buffer = |side: u32, columns: &dyn Fn(u32) -> u32| {
            let columns = || (0..side * side).map(|index| columns(index % side));
            GBuffer {
                guides: Guides {
                    reflectances: columns().map(|x| Rgb::splat(albedo(x) / PI)).collect(),
                    surfaces: columns().map(|x| Some(seen(x))).collect(),
                },
                ..GBuffer::of_first_hits([side; 2], columns().map(|_| hit(0, Vec3::Z, 0.0)).collect())
            }
        };
        let light = |x: u32| albedo(x) * if x < 7 { 1.0 } else { 5.0 };
        let columns = |x: u32| x * 4 + 2;
        let mut draft = Draft::of_pixels(4, (0..16).map(|k| Rgb::splat(light(columns(k % 4)))).collect(), 1.0, 1.0);
        draft.g_buffer = g_buffer(4, &columns);
        let known = g_buffer(SIDE, &|x| x);
        let row = |detail: &GBuffer| {
            let picture = Upsampling::new(&draft, Some(detail), &draft.image, [SIDE; 2]).picture();
            picture.pixels[..SIDE as usize].iter().map(|pixel| pixel.x).collect::<Vec<f32>>()
        };
        for (x, value) in (0..).zip(row(&known)) {
            assert!((value / light(x) - 1.0).abs() < 0.1, "{value} instead of {} in column {x}", light(x));
        }
        let first_hits = GBuffer { guides: Guides::default(), ..known };
        assert!((row(&first_hits)[7] - light(7)).abs() > 0.5 * light(7), "blurred where that is not known");
    }
}
