//! The `patchlight` program.

use clap::Parser;
use patchlight::cli::{self, Arguments};
use std::{io::Write, process::ExitCode};

fn main() -> ExitCode {
    match cli::run(Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Where not even messages can be written, the exit code must do.
            writeln!(std::io::stderr(), "{error}").ok();
            ExitCode::from(error.exit_code())
        }
    }
}
