//! Time against error: how fast a scene's picture comes near to its reference.

mod csv;
mod measurement;
mod median;
mod slope;
mod table;
mod trial;
mod truth;

use super::{
    CliError,
    args::BenchArguments,
    render::{needs_folder, pool},
};
use crate::{
    file::write_whole,
    film::{Mask, read_exr},
    scene::SceneFile,
};
use std::path::Path;
use trial::Trial;
use truth::Truth;

/// `patchlight bench`.
pub(super) fn bench(arguments: &BenchArguments) -> Result<(), CliError> {
    arguments.csv.as_deref().map_or(Ok(()), needs_folder)?;
    let file = SceneFile::find(&arguments.scene)?;
    let reference = read_exr(&arguments.reference)?;
    let mask = arguments.mask.as_deref().map(Mask::read).transpose()?;
    let trial = Trial::new(file, Truth::new(reference, mask)?, &arguments.seconds, arguments.seeds);
    let rows = pool(arguments.threads)?.install(|| trial.measure())?;
    if let Some(path) = &arguments.csv {
        write(path, csv::csv(&rows).as_bytes())?;
    }
    Ok(())
}

/// Writes a result, whole or not at all.
fn write(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    write_whole(path, bytes).map_err(|e| CliError::Failed(format!("{}: cannot be written: {e}", path.display())))
}
