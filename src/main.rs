//! The `patchlight` program.

use clap::Parser;
use patchlight::cli::{self, Arguments, CliError};
use patchlight::scene::SceneFile;
use std::{io::Write, process::ExitCode};

fn main() -> ExitCode {
    match cli::run(Arguments::parse(), open_window) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if error.is_broken_pipe() => ExitCode::SUCCESS,
        Err(error) => {
            // If the message cannot be written either, the exit code remains.
            writeln!(std::io::stderr(), "{error}").ok();
            ExitCode::from(error.exit_code())
        }
    }
}

#[cfg(feature = "gui")]
fn open_window(scene: SceneFile) -> Result<(), CliError> {
    patchlight::app::run(scene).map_err(|error| CliError::Failed(error.to_string()))
}

#[cfg(not(feature = "gui"))]
fn open_window(scene: SceneFile) -> Result<(), CliError> {
    Err(CliError::Failed(format!(
        "this build of patchlight has no window (feature `gui`)\nTo render without a window: patchlight render {} -o picture.png",
        scene.location.argument()
    )))
}
