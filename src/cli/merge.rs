use super::{
    CliError,
    args::MergeArguments,
    output::{must_be_own_files, must_not_overwrite, write},
    picture_format::PictureFormat,
    statistics::Statistics,
};
use crate::engine::{Checkpoint, CheckpointFile};
use crate::film::PngDepth;
use std::{
    io::{self, Write, stderr},
    path::{Path, PathBuf},
};

/// `patchlight merge`: merges the checkpoints of consecutive iterations.
pub(super) fn merge(arguments: &MergeArguments) -> Result<(), CliError> {
    let MergeArguments { films, output, checkpoint, stats, png_bits } = arguments;
    let format = output.as_deref().map(PictureFormat::of).transpose()?;
    let written = [(output, "picture"), (checkpoint, "checkpoint"), (stats, "statistics")];
    let written: Vec<_> = written.into_iter().filter_map(|(path, name)| Some((path.as_deref()?, name))).collect();
    must_be_own_files(&written)?;
    for (path, _) in &written {
        must_not_overwrite(path, films.iter().map(|film| (film.as_path(), "a film")))?;
    }
    let merged = merged(films)?;
    if let Some(path) = checkpoint {
        Checkpoint::write(path, &merged.run, &merged.part)?;
    }
    if let (Some(format), Some(path)) = (format, output) {
        let (image, provenance) = (merged.part.film().image(), merged.run.provenance(&merged.part.stats()));
        format.write(path, &image, merged.run.display(), PngDepth::from(*png_bits), &provenance)?;
    }
    if let Some(path) = stats {
        write(path, Statistics::new(&merged.part.stats(), merged.run.size()).json()?.as_bytes())?;
    }
    // The files are written: a message that nobody can read is no failure.
    output.as_ref().or(checkpoint.as_ref()).map(|path| report(&merged, path).ok());
    Ok(())
}

/// The merged films of consecutive iterations of one run.
fn merged(films: &[PathBuf]) -> Result<Checkpoint, CliError> {
    let files: Result<Vec<_>, _> = films.iter().map(|film| CheckpointFile::open(film)).collect();
    let mut files = files?;
    files.sort_by_key(CheckpointFile::iterations);
    files.windows(2).try_for_each(|pair| must_follow(&pair[0], &pair[1]))?;
    let mut rest = files.into_iter();
    let Some(first) = rest.next() else { return Err(CliError::Usage("expected a film".to_owned())) };
    must_have_iterations(&first)?;
    let mut before = first.path().to_owned();
    let mut merged = first.read()?;
    for file in rest {
        let path = file.path().to_owned();
        let next = file.read()?;
        if !merged.part.precedes(&next.part) {
            let message = "begins with another plan than the one that";
            let (path, before) = (path.display(), before.display());
            return Err(CliError::Usage(format!(
                "{path}: {message} {before} ends with: render it with --plan {before}"
            )));
        }
        merged.part = merged.part.followed_by(next.part);
        before = path;
    }
    Ok(merged)
}

/// Fails if `next` does not begin where `film` ends, or belongs to another run.
fn must_follow(film: &CheckpointFile, next: &CheckpointFile) -> Result<(), CliError> {
    let (a, b) = (film.path().display(), next.path().display());
    must_have_iterations(next)?;
    if let Some(difference) = next.run().difference(film.run()) {
        return Err(CliError::Usage(format!("{b}: is a film of {difference} as {a}")));
    }
    let ((_, last), (first, end)) = (film.iterations(), next.iterations());
    if first <= last {
        return Err(CliError::Usage(format!("{a} and {b} both have iterations {first} to {}", last.min(end))));
    }
    if first > last + 1 {
        let missing = format!("iterations {} to {} are missing", last + 1, first - 1);
        return Err(CliError::Usage(format!("{missing} between {a} and {b}")));
    }
    Ok(())
}

fn must_have_iterations(file: &CheckpointFile) -> Result<(), CliError> {
    let (first, last) = file.iterations();
    if first <= last {
        return Ok(());
    }
    let path = file.path().display();
    Err(CliError::Usage(format!("{path}: ended before its first iteration: go on with render --resume {path}")))
}

fn report(merged: &Checkpoint, path: &Path) -> io::Result<()> {
    let film = merged.part.film();
    let error = merged.part.error_estimate().map_or(String::new(), |e| format!(", error about {:.2} %", 100.0 * e));
    writeln!(stderr(), "{}: iterations {} to {}{error}", path.display(), film.first(), film.last())
}
