use super::{ImageError, LinearImage, Provenance, ToneMap};
use crate::file::{read_limited, write_whole};
use crate::scene::Film;
use image::ImageReader;
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, SrgbRenderingIntent};
use std::{
    io::{self, Cursor},
    path::Path,
};

/// Most bytes of a mask: more than the largest picture of the program takes without compression.
const MAX_MASK_BYTES: u64 = 1 << 30;

/// The bits of each channel of a PNG file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PngDepth {
    /// 8 bits.
    #[default]
    Eight,
    /// 16 bits, for gradients that are edited further.
    Sixteen,
}

/// Writes an image as an sRGB PNG file, with its provenance in text chunks. The file is written whole or not at all.
///
/// # Errors
///
/// If the file cannot be written.
pub fn write_png(
    path: &Path,
    image: &LinearImage,
    tone: &ToneMap,
    depth: PngDepth,
    provenance: &Provenance,
) -> Result<(), ImageError> {
    let failed = |source| ImageError::Write { file: path.to_owned(), source };
    let bytes = encoded(image, tone, depth, provenance).map_err(|e| failed(io::Error::other(e)))?;
    write_whole(path, &bytes).map_err(failed)
}

/// The bytes of a PNG file.
fn encoded(
    image: &LinearImage,
    tone: &ToneMap,
    depth: PngDepth,
    provenance: &Provenance,
) -> Result<Vec<u8>, EncodingError> {
    let (bits, data) = match depth {
        PngDepth::Eight => (BitDepth::Eight, tone.map_image(image).into_raw()),
        PngDepth::Sixteen => {
            let channels = image.pixels.iter().flat_map(|radiance| tone.map_to_16_bits(*radiance));
            (BitDepth::Sixteen, channels.flat_map(u16::to_be_bytes).collect())
        }
    };
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, image.width, image.height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(bits);
    encoder.set_compression(Compression::Fast);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    encoder.add_text_chunk("Software".to_owned(), Provenance::SOFTWARE.to_owned())?;
    for (name, value) in provenance.fields() {
        encoder.add_itxt_chunk(name, value)?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(bytes)
}

/// The pixels that a comparison includes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    /// Pixels per row.
    pub width: u32,
    /// Rows of pixels.
    pub height: u32,
    /// Whether each pixel is included, row by row from the top.
    pub inside: Vec<bool>,
}

impl Mask {
    /// The mask of the bright pixels of a PNG or JPEG file.
    ///
    /// # Errors
    ///
    /// If the file cannot be read or decoded, or if its pixels are all bright or all dark: one side of the comparison would have no pixel.
    pub fn read(path: &Path) -> Result<Self, ImageError> {
        let bytes =
            read_limited(path, MAX_MASK_BYTES).map_err(|source| ImageError::Read { file: path.to_owned(), source })?;
        let wrong = |message| ImageError::Content { file: path.to_owned(), message };
        let damaged = |e: image::ImageError| wrong(e.to_string().trim().to_owned());
        let reader = || ImageReader::new(Cursor::new(&bytes)).with_guessed_format().map_err(|e| damaged(e.into()));
        let (width, height) = reader()?.into_dimensions().map_err(damaged)?;
        if width.max(height) > Film::MOST_PIXELS {
            let most = Film::MOST_PIXELS;
            return Err(wrong(format!("has {width} x {height} pixels, expected at most {most} x {most}")));
        }
        let mut reader = reader()?;
        // The decoder's own limit is below the largest film.
        reader.no_limits();
        let image = reader.decode().map_err(damaged)?.into_luma8();
        let inside: Vec<_> = image.iter().map(|luma| *luma > 127).collect();
        for (side, brightness) in [(true, "bright"), (false, "dark")] {
            if !inside.contains(&side) {
                return Err(wrong(format!(
                    "the mask has no {brightness} pixel: bright ones are inside, dark ones outside"
                )));
            }
        }
        Ok(Self { width: image.width(), height: image.height(), inside })
    }

    /// The mask of the pixels that this mask excludes.
    pub fn inverted(&self) -> Self {
        Self { inside: self.inside.iter().map(|inside| !inside).collect(), ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{math::Rgb, scene::ToneCurve};
    use std::fs;

    fn write_png(path: &Path, image: &LinearImage, tone: &ToneMap) -> Result<(), ImageError> {
        super::write_png(path, image, tone, PngDepth::Eight, &Provenance::default())
    }

    #[test]
    fn sixteen_bits_tell_more_than_eight_and_the_text_tells_the_scene() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.png");
        let pixels: Vec<Rgb> = (0..64).map(|k| Rgb::splat(0.2 + 1e-5 * k as f32)).collect();
        let image = LinearImage { width: 64, height: 1, pixels };
        let scene = "version = 1\nname = \"\u{e4}\"\n".to_owned();
        let provenance = Provenance { scene: Some(scene.clone()), iterations: 9, ..Provenance::default() };
        let tone = ToneMap::new(1.0, ToneCurve::Srgb);
        super::write_png(&path, &image, &tone, PngDepth::Sixteen, &provenance).unwrap();
        let read = image::open(&path).unwrap().into_rgb16();
        for (k, pixel) in read.pixels().enumerate() {
            let x = 2.0 * (0.2 + 1e-5 * k as f64);
            let exact = (1.055 * x.powf(1.0 / 2.4) - 0.055) * 65535.0;
            assert!((f64::from(pixel.0[1]) - exact).abs() < 1.0, "{} instead of {exact}", pixel.0[1]);
        }
        let decoder = png::Decoder::new(io::BufReader::new(fs::File::open(&path).unwrap()));
        let reader = decoder.read_info().unwrap();
        let texts = &reader.info().utf8_text;
        let text = |name: &str| texts.iter().find(|chunk| chunk.keyword == name).map(|chunk| chunk.get_text().unwrap());
        assert_eq!((text("Scene"), text("Iterations")), (Some(scene), Some("9".to_owned())));
        assert_eq!(reader.info().uncompressed_latin1_text[0].text, Provenance::SOFTWARE);
    }

    #[test]
    fn rows_begin_at_the_top() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.png");
        let pixels = vec![Rgb::X, Rgb::Y, Rgb::Z, Rgb::ONE, Rgb::splat(0.214_041_14), Rgb::ZERO];
        let image = LinearImage { width: 2, height: 3, pixels };
        write_png(&path, &image, &ToneMap::new(0.0, ToneCurve::Srgb)).unwrap();
        let read = image::open(&path).unwrap().into_rgb8();
        // 0.21404114 is the radiance of half of full brightness on the sRGB curve: 127.5 of 255.
        let middle = read.get_pixel(0, 2).0[0];
        assert!(middle == 127 || middle == 128);
        assert_eq!(read.get_pixel(1, 0).0, [0, 255, 0]);
        assert_eq!(read.get_pixel(0, 1).0, [0, 0, 255]);
        let mask = Mask::read(&path).unwrap();
        assert_eq!((mask.width, mask.height, mask.inside[3], mask.inside[5]), (2, 3, true, false));
        let others = mask.inverted();
        assert_eq!((others.width, others.height, others.inside[3], others.inside[5]), (2, 3, false, true));
    }

    #[test]
    fn files_that_are_not_images_are_rejected() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.png");
        assert!(matches!(Mask::read(&path), Err(ImageError::Read { .. })));
        fs::write(&path, b"no image").unwrap();
        assert!(matches!(Mask::read(&path), Err(ImageError::Content { .. })));
    }

    #[test]
    fn a_mask_without_an_inside_or_an_outside_is_rejected() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.png");
        for (pixel, missing) in [(Rgb::ZERO, "no bright pixel"), (Rgb::ONE, "no dark pixel")] {
            let image = LinearImage { width: 2, height: 1, pixels: vec![pixel; 2] };
            write_png(&path, &image, &ToneMap::new(0.0, ToneCurve::Srgb)).unwrap();
            let error = Mask::read(&path).unwrap_err().to_string();
            assert!(error.contains(missing), "{error}");
        }
    }
}
