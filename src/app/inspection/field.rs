//! A number for each pixel.

use crate::app::commands::PictureView;
use crate::engine::{Frame, GBuffer};
use crate::film::LinearImage;
use crate::math::Rgb;
use std::f32::consts::PI;

/// Least albedo by which a radiance is divided: below it, rounding and noise of the radiance would be all that is left.
const LEAST_ALBEDO: f32 = 0.01;
/// Pixels to each side over which the error is a mean: the difference of two means at one pixel is hardly more than a random number.
const AROUND: usize = 2;

/// A number for each pixel of a film.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Field {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Row by row; NaN where a pixel has none.
    pub(crate) values: Vec<f32>,
    /// The object that each pixel shows; `None` for a lamp and for nothing.
    pub(crate) objects: Vec<Option<u32>>,
}

impl Field {
    /// The numbers of a view of a frame; `None` where the frame does not tell them, and for a view without numbers.
    pub(super) fn of(view: PictureView, frame: &Frame) -> Option<Self> {
        let g_buffer = frame.g_buffer.as_deref()?;
        let image = &*frame.image;
        let [width, height] = g_buffer.size.map(|side| side as usize);
        if [image.width as usize, image.height as usize] != [width, height] {
            return None;
        }
        let values = match view {
            PictureView::Irradiance => irradiance(image, g_buffer),
            PictureView::Error => relative_error(image, frame.noise.as_ref()?),
            PictureView::Distance => g_buffer.first_hits.iter().map(|hit| finite(hit.depth)).collect(),
            PictureView::Light | PictureView::Albedo | PictureView::Normals => return None,
        };
        let objects = g_buffer.first_hits.iter().map(|hit| hit.object).collect();
        let field = Self { width, height, values, objects };
        Some(if view == PictureView::Irradiance { field.inside_objects() } else { field })
    }

    /// The field without the numbers at edges: the radiance there is that of two surfaces, the albedo that of one.
    fn inside_objects(self) -> Self {
        let inside = |index: usize| if self.is_inside_object(index) { self.values[index] } else { f32::NAN };
        Self { values: (0..self.values.len()).map(inside).collect(), ..self }
    }

    /// The number at a column and row; `None` outside, and where there is none.
    pub(crate) fn at(&self, x: usize, y: usize) -> Option<f32> {
        let inside = x < self.width && y < self.height;
        inside.then(|| self.values[y * self.width + x]).filter(|value| value.is_finite())
    }

    /// Whether a pixel and its neighbours show one object: at an edge a pixel mixes two.
    pub(super) fn is_inside_object(&self, index: usize) -> bool {
        let (x, y) = (index % self.width, index / self.width);
        let own = self.objects[index];
        let near = |k: usize, count: usize| k.saturating_sub(1)..(k + 2).min(count);
        own.is_some()
            && near(y, self.height)
                .all(|row| near(x, self.width).all(|column| self.objects[row * self.width + column] == own))
    }
}

fn finite(value: f32) -> f32 {
    if value.is_finite() { value } else { f32::NAN }
}

/// The irradiance of the matte surfaces, W/m^2, the mean over the channels: a diffuse surface of albedo a in irradiance E has the radiance
/// a E / pi.
fn irradiance(image: &LinearImage, g_buffer: &GBuffer) -> Vec<f32> {
    let of_pixel = |(radiance, hit): (&Rgb, &crate::transport::FirstHit)| {
        let albedo = hit.facet.filter(|_| hit.is_matte).map(|facet| facet.albedo);
        let albedo = albedo.filter(|albedo| albedo.min_element() >= LEAST_ALBEDO);
        albedo.map_or(f32::NAN, |albedo| PI * (*radiance / albedo).element_sum() / 3.0)
    };
    image.pixels.iter().zip(&g_buffer.first_hits).map(of_pixel).collect()
}

/// The noise over the radiance, each a mean over the pixels around.
fn relative_error(image: &LinearImage, noise: &[f32]) -> Vec<f32> {
    let (width, height) = (image.width as usize, image.height as usize);
    let squares: Vec<f32> = noise.iter().map(|noise| noise * noise).collect();
    let radiance: Vec<f32> = image.pixels.iter().map(|pixel| pixel.element_sum() / 3.0).collect();
    let [squares, radiance] = [squares, radiance].map(|values| blurred(&values, width, height));
    squares
        .iter()
        .zip(&radiance)
        .map(|(square, mean)| if *mean > 0.0 { square.sqrt() / mean } else { f32::NAN })
        .collect()
}

/// The means over squares of pixels, row by row: first along rows, then along columns.
fn blurred(values: &[f32], width: usize, height: usize) -> Vec<f32> {
    let mean = |count: usize, k: usize, at: &dyn Fn(usize) -> f32| {
        let range = k.saturating_sub(AROUND)..(k + AROUND + 1).min(count);
        let (sum, number) = (range.clone().map(at).sum::<f32>(), range.len() as f32);
        sum / number
    };
    let rows: Vec<f32> = (0..width * height)
        .map(|index| {
            let (x, row) = (index % width, index / width * width);
            mean(width, x, &|x| values[row + x])
        })
        .collect();
    (0..width * height)
        .map(|index| {
            let (x, y) = (index % width, index / width);
            mean(height, y, &|y| rows[y * width + x])
        })
        .collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::transport::{Facet, FirstHit};
    use glam::Vec3;

    /// A field of these values, in rows of this width, on one object.
    pub(crate) fn field(width: usize, values: Vec<f32>) -> Field {
        Field { width, height: values.len() / width, objects: vec![Some(0); values.len()], values }
    }

    #[test]
    fn irradiance_is_pi_radiance_over_albedo_on_matte_surfaces() {
        let facet = |albedo: Rgb| Facet { normal: Vec3::Z, albedo, tag: 0, position: Vec3::ZERO };
        let hit = |albedo, is_matte| FirstHit { depth: 1.0, is_matte, facet: Some(facet(albedo)), object: Some(0) };
        let albedo = Rgb::new(0.2, 0.4, 0.8);
        let lamp = FirstHit { facet: None, ..hit(albedo, true) };
        let first_hits = vec![hit(albedo, true), hit(albedo, false), lamp, hit(Rgb::new(0.5, 0.0, 0.5), true)];
        let g_buffer = GBuffer { size: [4, 1], first_hits, guides: Default::default() };
        let image = LinearImage { width: 4, height: 1, pixels: vec![3.0 / PI * albedo; 4] };
        let values = irradiance(&image, &g_buffer);
        assert!((values[0] - 3.0).abs() < 1e-5, "{values:?}");
        assert!(
            values[1..].iter().all(|value| value.is_nan()),
            "a mirror, a lamp, a surface without green: {values:?}"
        );
    }

    #[test]
    fn the_error_is_a_mean_over_the_pixels_around() {
        let image = LinearImage { width: 9, height: 9, pixels: vec![Rgb::splat(2.0); 81] };
        let mut noise = vec![0.0; 81];
        noise[4 * 9 + 4] = 5.0;
        let errors = relative_error(&image, &noise);
        // One of 25 squares is 25.
        assert!((errors[4 * 9 + 4] - 0.5).abs() < 1e-6 && (errors[2 * 9 + 6] - 0.5).abs() < 1e-6, "{errors:?}");
        assert_eq!(errors[9 + 4], 0.0);
    }

    #[test]
    fn pixels_at_an_edge_have_no_number() {
        let mut field = field(5, vec![1.0; 25]);
        field.objects[12] = None;
        let field = field.inside_objects();
        let inside: Vec<usize> = (0..25).filter(|index| field.values[*index] == 1.0).collect();
        assert_eq!(inside, [0, 1, 2, 3, 4, 5, 9, 10, 14, 15, 19, 20, 21, 22, 23, 24]);
    }
}
