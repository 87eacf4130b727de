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
            // Where not even messages can be written, the exit code must do.
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
        "this program was built without a window\nThis works at once: patchlight render {} -o picture.png",
        scene.location.argument()
    )))
}
