//! The command line: the commands that need no window.
//!
//! | file | holds |
//! |---|---|
//! | `args` | [`Arguments`] and the texts of `--help` |
//! | `error` | [`CliError`] and the exit codes |
//! | `words` | plurals |
//! | `interrupt` | signals that ask the program to end |
//! | `output`, `picture_format` | write the files of the commands |
//! | `checkpoints` | checkpoints of `render`: begins, goes on, saves |
//! | `rendering` | the thread pool, timed iterations |
//! | `progress`, `statistics` | the progress bar and `--stats` of `render` |
//! | `render`, `merge`, `check`, `export`, `compare` | the commands of these names |
//! | `intersect/`, `bench/` | the commands of these names |

mod args;
mod bench;
mod check;
mod checkpoints;
mod compare;
mod error;
mod export;
mod interrupt;
mod intersect;
mod merge;
mod output;
mod picture_format;
mod progress;
mod render;
mod rendering;
mod statistics;
mod words;

pub use args::Arguments;
pub use error::CliError;
pub use intersect::write_hits;

use crate::scene::SceneFile;
use args::Command;
use std::path::Path;

/// Runs the command of the command line; without a command, `open_window` with the scene.
///
/// # Errors
///
/// If the command fails. Its message and exit code are in the error.
pub fn run(arguments: Arguments, open_window: impl FnOnce(SceneFile) -> Result<(), CliError>) -> Result<(), CliError> {
    match arguments.command {
        None => {
            let scene = arguments.scene.as_deref().unwrap_or(Path::new("report"));
            open_window(SceneFile::find(scene)?)
        }
        Some(Command::Render(render)) => render::render(&render),
        Some(Command::Merge(merge)) => merge::merge(&merge),
        Some(Command::Bench(bench)) => bench::bench(&bench),
        Some(Command::Check(check)) => check::check(&check),
        Some(Command::Intersect(intersect)) => intersect::intersect(&intersect),
        Some(Command::Export(export)) => export::export(&export),
        Some(Command::Compare(pictures)) => compare::compare_pictures(&pictures),
    }
}
