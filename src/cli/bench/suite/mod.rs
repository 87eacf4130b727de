//! `patchlight bench --suite`: several scenes measured with one command.
//!
//! | file | holds |
//! |---|---|
//! | `file` | reads the file of a suite |
//! | `run` | `Run`: one scene with its reference |
//! | `result` | `RunResult`: the medians of a run |
//! | `markdown` | the table of all results |

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

/// The least number of marks for a plot.
const MIN_PLOTTED: usize = 3;

/// Measures the runs of a suite and writes to a folder: for each run a table, and a plot if there are enough marks; for all runs
/// the medians as one table with the name of the suite.
pub(super) fn bench_suite(suite: &Path, output: &Path, threads: Option<u16>) -> Result<(), CliError> {
    // Reads all files before the first rendering.
    let folder = suite.parent().unwrap_or(Path::new(""));
    let load = |entry| Run::load(entry, folder).map_err(|e| in_run(suite, &entry.name.0, &e));
    let runs = file::read(suite)?.iter().map(load).collect::<Result<Vec<_>, _>>()?;
    fs::create_dir_all(output)
        .map_err(|e| CliError::Failed(format!("{}: the folder cannot be created: {e}", output.display())))?;
    let pool = pool(threads)?;
    let mut results = Vec::new();
    for run in runs {
        let (name, others) = (run.name.clone(), run.others);
        writeln!(stdout(), "\n{name}")?;
        let rows = pool.install(|| run.measure())?;
        write(&output.join(format!("{name}.csv")), csv(&rows).as_bytes())?;
        let medians = medians(&rows);
        if medians.len() >= MIN_PLOTTED {
            write(&output.join(format!("{name}.png")), &plot::png(&name, &rows)?)?;
        }
        results.push(RunResult { name, others, medians });
    }
    let suite_md = suite.with_extension("md");
    let table = output.join(suite_md.file_name().unwrap_or("suite.md".as_ref()));
    write(&table, markdown::table(&results, pool.current_num_threads()).as_bytes())
}

/// The error of a run in the suite.
fn in_run(suite: &Path, run: &str, error: &CliError) -> CliError {
    CliError::Usage(format!("{}: run \"{run}\": {error}", suite.display()))
}
