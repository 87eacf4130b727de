//! Several scenes measured with one command: what a suite's file lists.

mod file;
mod markdown;
mod result;
mod run;

use super::{csv::csv, median::medians, plot};
use crate::cli::{CliError, output::write, rendering::pool};
use result::RunResult;
use run::Run;
use std::{
    fs,
    io::{Write, stdout},
    path::Path,
};

/// Fewer marks make no curve.
const FEWEST_PLOTTED: usize = 3;

/// `patchlight bench --suite`: for each run a table, and a plot where it makes a curve, into a folder, and the medians of all
/// into one table that is called like the suite.
pub(super) fn bench_suite(suite: &Path, output: &Path, threads: Option<u16>) -> Result<(), CliError> {
    // All files are read before anything is rendered.
    let folder = suite.parent().unwrap_or(Path::new(""));
    let load = |entry| Run::load(entry, folder).map_err(|e| in_run(suite, &entry.name.0, &e));
    let runs = file::read(suite)?.iter().map(load).collect::<Result<Vec<_>, _>>()?;
    fs::create_dir_all(output)
        .map_err(|e| CliError::Failed(format!("{}: the folder cannot be made: {e}", output.display())))?;
    let pool = pool(threads)?;
    let mut results = Vec::new();
    for run in runs {
        let (name, others) = (run.name.clone(), run.others);
        writeln!(stdout(), "\n{name}")?;
        let rows = pool.install(|| run.measure())?;
        write(&output.join(format!("{name}.csv")), csv(&rows).as_bytes())?;
        let medians = medians(&rows);
        if medians.len() >= FEWEST_PLOTTED {
            write(&output.join(format!("{name}.png")), &plot::png(&name, &rows)?)?;
        }
        results.push(RunResult { name, others, medians });
    }
    let suite_md = suite.with_extension("md");
    let table = output.join(suite_md.file_name().unwrap_or("suite.md".as_ref()));
    write(&table, markdown::table(&results, pool.current_num_threads()).as_bytes())
}

/// What is wrong with a file that a run names.
fn in_run(suite: &Path, run: &str, error: &CliError) -> CliError {
    CliError::Usage(format!("{}: run \"{run}\": {error}", suite.display()))
}
