use super::{ImageError, LinearImage, ToneMap};
use crate::file::{read_limited, write_whole};
use crate::scene::Film;
use image::{ImageReader, codecs::png::PngEncoder};
use std::{
    io::{self, Cursor},
    path::Path,
};

/// Most bytes of a mask: more than the largest picture of the program takes without compression.
const MAX_MASK_BYTES: u64 = 1 << 30;

/// Writes an image as an sRGB PNG file of 8 bits per channel. The file is written whole or not at all.
///
/// # Errors
///
/// If the file cannot be written.
pub fn write_png(path: &Path, image: &LinearImage, tone: &ToneMap) -> Result<(), ImageError> {
    let failed = |source| ImageError::Write { file: path.to_owned(), source };
    let mut bytes = Vec::new();
    tone.map_image(image).write_with_encoder(PngEncoder::new(&mut bytes)).map_err(|e| failed(io::Error::other(e)))?;
    write_whole(path, &bytes).map_err(failed)
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
