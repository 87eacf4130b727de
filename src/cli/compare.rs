//! `patchlight compare`: the difference of two pictures.

use super::{
    CliError,
    args::CompareArguments,
    output::{must_not_overwrite, needs_folder},
};
use crate::file::write_whole;
use crate::film::{Errors, ImageError, LinearImage, Mask, compare, difference_image, read_exr};
use image::ImageFormat;
use std::{
    io::{self, Cursor, Write, stdout},
    path::Path,
};

/// Compares two pictures, prints their difference in numbers, and writes it in false colours if that is asked for.
pub(super) fn compare_pictures(arguments: &CompareArguments) -> Result<(), CliError> {
    let CompareArguments { picture, reference, mask, output } = arguments;
    if let Some(path) = output {
        needs_folder(path)?;
        let read = [(Some(picture), "the picture"), (Some(reference), "the reference"), (mask.as_ref(), "the mask")];
        must_not_overwrite(path, read.into_iter().filter_map(|(read, name)| Some((read?.as_path(), name))))?;
    }
    let (image, truth) = (read_exr(picture)?, read_exr(reference)?);
    let mask = mask.as_deref().map(Mask::read).transpose()?;
    let errors = compare(&image, &truth, mask.as_ref())?;
    if let Some(path) = output {
        write_difference(path, &image, &truth)?;
    }
    Ok(print(&errors, flip(&image, &truth, mask.as_ref()))?)
}

fn print(errors: &Errors, flip: Option<f64>) -> io::Result<()> {
    let mut out = stdout().lock();
    writeln!(out, "pixels          {}", errors.pixels)?;
    writeln!(out, "RMSE            {:.6e}", errors.rmse)?;
    writeln!(out, "RMSE / mean     {:.6e}", errors.rmse / errors.reference_mean)?;
    writeln!(out, "relMSE          {:.6e}", errors.rel_mse)?;
    writeln!(out, "relMSE, trimmed {:.6e}", errors.rel_mse_trimmed)?;
    let [red, green, blue] = errors.mean_ratio;
    writeln!(out, "mean / mean     {red:.6} {green:.6} {blue:.6}")?;
    match flip {
        Some(flip) => writeln!(out, "FLIP            {flip:.6}"),
        None => Ok(()),
    }
}

fn write_difference(path: &Path, image: &LinearImage, reference: &LinearImage) -> Result<(), ImageError> {
    let failed = |source| ImageError::Write { file: path.to_owned(), source };
    let mut bytes = Cursor::new(Vec::new());
    let colors = difference_image(image, reference);
    colors.write_to(&mut bytes, ImageFormat::Png).map_err(|e| failed(io::Error::other(e)))?;
    write_whole(path, bytes.get_ref()).map_err(failed)
}

/// The mean perceived difference without exposure on the sRGB curve; `None` without the feature `flip`.
#[cfg(feature = "flip")]
fn flip(image: &LinearImage, reference: &LinearImage, mask: Option<&Mask>) -> Option<f64> {
    use crate::film::{ToneMap, flip, mean_inside};
    let tone = ToneMap::new(0.0, crate::scene::ToneCurve::Srgb);
    Some(mean_inside(&flip(&tone.map_image(image), &tone.map_image(reference)), mask))
}

#[cfg(not(feature = "flip"))]
fn flip(_: &LinearImage, _: &LinearImage, _: Option<&Mask>) -> Option<f64> {
    None
}
