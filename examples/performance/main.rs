//! Measures everything again that `docs/performance.md` has in its tables, and writes it there:
//! `cargo run --release --example performance [STEP ...]`; without a step all of them, which takes about an hour.
//!
//! What a step gives stands between `<!-- table: STEP -->` and `<!-- end -->`. It is written as soon as the step is done, so that
//! a step that fails takes nothing of those before it. Plots and whole tables of suites go into `docs/performance`.

#![allow(clippy::print_stderr, reason = "people want to see where it is")]

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
    // Whether there is a place for every table is told now, not after an hour.
    let page = read_page()?;
    for step in &steps {
        block::replaced(&page, step.name, "").map_err(in_page)?;
    }
    let commit = machine::commit()?;
    for Step { name, source } in steps {
        eprintln!("{name}: {}", source.description());
        let table = source.measure(&commit)?;
        // Read again: people may have written to the page in the meantime.
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
