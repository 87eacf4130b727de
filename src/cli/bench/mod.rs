//! Time against error: how fast a scene's picture comes near to its reference.

mod measurement;
mod table;

use super::{
    CliError,
    args::BenchArguments,
    render::{advance, needs_folder, pool},
};
use crate::{
    engine::Session,
    file::write_whole,
    film::{LinearImage, Mask, compare, read_exr},
    scene::SceneFile,
};
use measurement::Measurement;
use std::io::{Write, stdout};

/// `patchlight bench`.
pub(super) fn bench(arguments: &BenchArguments) -> Result<(), CliError> {
    arguments.csv.as_deref().map_or(Ok(()), needs_folder)?;
    let mut file = SceneFile::find(&arguments.scene)?;
    let reference = read_exr(&arguments.reference)?;
    let mask = arguments.mask.as_deref().map(Mask::read).transpose()?;
    file.scene.film.width = reference.width;
    file.scene.film.height = reference.height;
    // Tells before the rendering whether the mask fits.
    compare(&reference, &reference, mask.as_ref())?;
    let mut marks = arguments.seconds.clone();
    marks.sort_by(f64::total_cmp);
    let truth = Truth { reference: &reference, mask: mask.as_ref() };
    let pool = pool(arguments.threads)?;
    let mut rows = Vec::new();
    writeln!(stdout(), "{}", table::header())?;
    for seed in 0..arguments.seeds {
        pool.install(|| measure(&file, seed, &marks, &truth, &mut rows))?;
    }
    write!(stdout(), "{}", table::summary(&rows))?;
    if let Some(path) = &arguments.csv {
        write_whole(path, table::csv(&rows).as_bytes())
            .map_err(|e| CliError::Failed(format!("{}: cannot be written: {e}", path.display())))?;
    }
    Ok(())
}

/// What pictures are compared with.
struct Truth<'a> {
    reference: &'a LinearImage,
    mask: Option<&'a Mask>,
}

/// Renders until the last mark and measures the picture at each of them; at a mark that comes before the first
/// iteration's end, after that.
fn measure(
    file: &SceneFile,
    seed: u64,
    marks: &[f64],
    truth: &Truth<'_>,
    rows: &mut Vec<Measurement>,
) -> Result<(), CliError> {
    let mut session = Session::prepare(file, seed, None)?;
    let mut last = advance(&mut session);
    for mark in marks {
        while session.seconds() + last <= *mark {
            last = advance(&mut session);
        }
        let frame = session.frame(0);
        let errors = compare(&frame.image, truth.reference, truth.mask)?;
        let row = Measurement { seed, mark: *mark, stats: frame.stats, errors };
        writeln!(stdout(), "{}", table::line(&row))?;
        rows.push(row);
    }
    Ok(())
}
