//! Measures the tables of `docs/performance.md` again and writes them into the page:
//! `cargo run --release --example performance [STEP ...]`. Without a step it runs all steps, which takes about an hour.
//!
//! The table of a step stands between `<!-- table: STEP -->` and `<!-- end -->`. The page is written after each step, so that a
//! failed step loses no earlier table. Plots and complete tables of suites go into `docs/performance`.
//!
//! | file | holds |
//! |---|---|
//! | `block` | the generated parts of a page |
//! | `command` | programs run in the project's folder |
//! | `criterion` | the output of criterion as a table |
//! | `machine` | the machine and the commit of a measurement |
//! | `step` | the steps, and the command of each |

#![allow(clippy::print_stderr, reason = "the steps take long; the user sees the progress")]

mod block;
mod command;
mod criterion;
mod machine;
mod step;

use patchlight::file::write_whole;
use std::{fs, process::ExitCode};
use step::Step;

const PAGE: &str = "docs/performance.md";

fn main() -> ExitCode {
    match run(&std::env::args().skip(1).collect::<Vec<_>>()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run(names: &[String]) -> Result<(), String> {
    let steps = step::chosen(names)?;
    // A missing place for a table is reported now, not after an hour.
    let page = read_page()?;
    for step in &steps {
        block::replaced(&page, step.name, "").map_err(in_page)?;
    }
    let commit = machine::commit()?;
    for Step { name, source } in steps {
        eprintln!("{name}: {}", source.description());
        let table = source.measure(&commit)?;
        // Read again, because the user may have edited the page in the meantime.
        let page = block::replaced(&read_page()?, name, &table).map_err(in_page)?;
        write_whole(&command::root().join(PAGE), page.as_bytes()).map_err(in_page)?;
    }
    Ok(())
}

fn read_page() -> Result<String, String> {
    fs::read_to_string(command::root().join(PAGE)).map_err(in_page)
}

fn in_page(error: impl std::fmt::Display) -> String {
    format!("{PAGE}: {error}")
}
