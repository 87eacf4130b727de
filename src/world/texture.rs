use super::PrepareError;
use crate::math::Rgb;
use crate::scene::{Encoding, Location};
use glam::DVec2;
use std::time::SystemTime;

/// A decoded texture, repeated in both directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: usize,
    height: usize,
    texels: Texels,
    /// The linear value of each code of the file.
    values: Vec<f32>,
}

/// The codes of the file's channels, row by row from the top. They take a fraction of the memory of linear values, whose
/// cache misses would dominate the time of a lookup.
#[derive(Clone, Debug, PartialEq)]
enum Texels {
    Bytes(Vec<[u8; 3]>),
    Words(Vec<[u16; 3]>),
}

/// The identity of a decoded image.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TextureKey {
    location: Location,
    file: String,
    /// The time of the last change and the length of the file: another program may write the file anew.
    state: Option<(SystemTime, u64)>,
    linear: bool,
}

impl TextureKey {
    /// The image in this file as it is now.
    pub(super) fn new(location: &Location, file: &str, linear: bool) -> Self {
        Self { location: location.clone(), file: file.to_owned(), state: location.state_of(file), linear }
    }

    /// Reads and decodes the file.
    ///
    /// # Errors
    ///
    /// If the file cannot be read or decoded.
    pub(super) fn decode(&self) -> Result<Image, PrepareError> {
        let picture = self.location.read_picture(&self.file).map_err(PrepareError::Texture)?;
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        let color = picture.color();
        let is_deep = color.bytes_per_pixel() > color.channel_count();
        let (texels, most) = if is_deep {
            (Texels::Words(picture.into_rgb16().pixels().map(|p| p.0).collect()), u16::MAX)
        } else {
            (Texels::Bytes(picture.into_rgb8().pixels().map(|p| p.0).collect()), u16::from(u8::MAX))
        };
        let fraction = |k: u16| f32::from(k) / f32::from(most);
        let meaning = |k: u16| if self.linear { fraction(k) } else { linear_from_srgb(fraction(k)) };
        Ok(Image { width, height, texels, values: (0..=most).map(meaning).collect() })
    }
}

/// Whether a texture is decoded as linear: always if it is a normal or height map.
pub(super) fn is_linear(encoding: Encoding, is_map: bool) -> bool {
    is_map || encoding == Encoding::Linear
}

/// The sRGB transfer function, IEC 61966-2-1.
fn linear_from_srgb(c: f32) -> f32 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

impl Image {
    /// The linear value at (u, v), bilinear between texel centers; (0, 0) is the bottom-left corner.
    pub fn sample(&self, uv: DVec2) -> Rgb {
        let ((x0, x1, fx), (y0, y1, fy)) = self.neighbours(uv);
        let top = self.texel(x0, y0).lerp(self.texel(x1, y0), fx);
        let bottom = self.texel(x0, y1).lerp(self.texel(x1, y1), fx);
        top.lerp(bottom, fy)
    }

    /// The derivatives by u and v of the bilinear interpolation of the mean of the channels.
    pub fn gradient(&self, uv: DVec2) -> DVec2 {
        let ((x0, x1, fx), (y0, y1, fy)) = self.neighbours(uv);
        let h = |x, y| f64::from(self.texel(x, y).element_sum()) / 3.0;
        let (fx, fy) = (f64::from(fx), f64::from(fy));
        let du = (1.0 - fy) * (h(x1, y0) - h(x0, y0)) + fy * (h(x1, y1) - h(x0, y1));
        let dv = (1.0 - fx) * (h(x0, y0) - h(x0, y1)) + fx * (h(x1, y0) - h(x1, y1));
        DVec2::new(du * self.width as f64, dv * self.height as f64)
    }

    #[inline]
    fn texel(&self, x: usize, y: usize) -> Rgb {
        let (index, value) = (y * self.width + x, |code: usize| self.values[code]);
        Rgb::from_array(match &self.texels {
            Texels::Bytes(codes) => codes[index].map(|code| value(code.into())),
            Texels::Words(codes) => codes[index].map(|code| value(code.into())),
        })
    }

    /// The two columns and the two rows around (u, v), each with the weight of the second.
    fn neighbours(&self, uv: DVec2) -> ((usize, usize, f32), (usize, usize, f32)) {
        let around = |x: f64, n: usize| {
            // Repeated first, so that no coordinate is too large; the difference may round up to 1 itself.
            let x = (x - x.floor()) * n as f64 - 0.5;
            let x = if x < 0.0 { x + n as f64 } else { x };
            let low = (x as usize).min(n - 1);
            (low, (low + 1) % n, (x - low as f64) as f32)
        };
        (around(uv.x, self.width), around(1.0 - uv.y, self.height))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orientation_repeat_and_gradient() {
        // Rows from the top: the bottom-left texel is 1.
        let texels = Texels::Bytes(vec![[0; 3], [0; 3], [1; 3], [0; 3]]);
        let image = Image { width: 2, height: 2, texels, values: vec![0.0, 1.0] };
        assert_eq!(image.sample(DVec2::new(0.25, 0.25)).x, 1.0);
        assert_eq!(image.sample(DVec2::new(1.25, -0.75)).x, 1.0, "repeats");
        assert_eq!(image.sample(DVec2::new(0.5, 0.25)).x, 0.5, "bilinear");
        let slope = image.gradient(DVec2::new(0.3, 0.3));
        assert!(slope.distance(DVec2::new(-1.8, -1.8)) < 1e-6, "falls to the right and upwards: {slope}");
        assert!(image.sample(DVec2::new(-1e-18, f64::MAX)).is_finite());
    }

    #[test]
    fn deep_and_flat_codes_have_equal_values() {
        let folder = tempfile::tempdir().unwrap();
        let location = Location::Disk(folder.path().join("scene.toml"));
        let decode = |file: &str, linear| TextureKey::new(&location, file, linear).decode().unwrap();
        let codes: Vec<u8> = vec![0, 1, 17, 100, 200, 255];
        image::RgbImage::from_raw(2, 1, codes.clone()).unwrap().save(folder.path().join("flat.png")).unwrap();
        let wide = codes.iter().map(|&code| 257 * u16::from(code)).collect();
        let wide: image::ImageBuffer<image::Rgb<u16>, Vec<u16>> = image::ImageBuffer::from_raw(2, 1, wide).unwrap();
        image::DynamicImage::from(wide).save(folder.path().join("deep.png")).unwrap();
        for linear in [false, true] {
            let (flat, deep) = (decode("flat.png", linear), decode("deep.png", linear));
            assert!(matches!((&flat.texels, &deep.texels), (Texels::Bytes(_), Texels::Words(_))));
            for x in 0..2 {
                assert!(
                    flat.texel(x, 0).distance(deep.texel(x, 0)) < 1e-6,
                    "{}, {}",
                    flat.texel(x, 0),
                    deep.texel(x, 0)
                );
            }
        }
    }

    #[test]
    fn a_file_that_was_written_anew_is_another_image() {
        let folder = tempfile::tempdir().unwrap();
        let location = Location::Disk(folder.path().join("scene.toml"));
        let write = |size| image::RgbImage::new(size, size).save(folder.path().join("a.png")).unwrap();
        let key = || TextureKey::new(&location, "a.png", false);
        write(3);
        let before = key();
        assert_eq!(before, key(), "an unchanged file");
        write(300);
        assert_ne!(before, key());
    }
}
