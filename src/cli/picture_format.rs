use super::CliError;
use crate::{
    film::{LinearImage, PngDepth, Provenance, ToneMap, write_exr, write_png},
    scene::ToneCurve,
};
use std::path::Path;

/// The file format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PictureFormat {
    Png,
    Exr,
}

impl PictureFormat {
    /// The format that the name of a file tells.
    pub(super) fn of(path: &Path) -> Result<Self, CliError> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
        match extension.as_str() {
            "png" => Ok(Self::Png),
            "exr" => Ok(Self::Exr),
            _ => Err(CliError::Usage(format!("{}: expected a name that ends in .png or .exr", path.display()))),
        }
    }

    /// Writes a picture; a PNG file of this depth with an exposure in stops and a tone curve.
    pub(super) fn write(
        self,
        path: &Path,
        image: &LinearImage,
        (exposure, curve): (f64, ToneCurve),
        depth: PngDepth,
        provenance: &Provenance,
    ) -> Result<(), CliError> {
        match self {
            Self::Png => write_png(path, image, &ToneMap::new(exposure, curve), depth, provenance)?,
            Self::Exr => write_exr(path, image, provenance)?,
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_says_the_format() {
        assert_eq!(PictureFormat::of(Path::new("a/b.PNG")).unwrap(), PictureFormat::Png);
        assert_eq!(PictureFormat::of(Path::new("b.exr")).unwrap(), PictureFormat::Exr);
        for wrong in ["b", "b.jpg", ".png", "b.png.txt"] {
            assert!(PictureFormat::of(Path::new(wrong)).is_err(), "{wrong}");
        }
    }
}
