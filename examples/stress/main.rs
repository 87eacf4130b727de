//! Runs the cases of `tests/stress` with more and more rounds until the time is used up, and prints a table of them:
//! `cargo run --release --example stress [-- --minutes N] [--write FILE] [NAME ...]`.
//!
//! Names restrict the run to cases whose name contains one of them. With `--write docs/stability.md` the tables of the page are written as
//! well; the page keeps the text around them. The exit code is 1 where a row fails.
//!
//! | file | holds |
//! |---|---|
//! | `arguments` | the command line |
//! | `page` | the page with the tables |

#![allow(clippy::print_stderr, clippy::print_stdout, reason = "the cases take long; the user sees the progress")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a case that cannot be measured is a fault of the suite")]

mod arguments;
#[path = "../performance/block.rs"]
mod block;
#[path = "../../tests/stress/cases/mod.rs"]
mod cases;
#[allow(dead_code, reason = "only the example `performance` runs commands whose output it does not read")]
#[path = "../performance/command.rs"]
mod command;
#[path = "../../tests/stress/inputs/mod.rs"]
mod inputs;
#[path = "../performance/machine.rs"]
mod machine;
#[path = "../../tests/stress/oracle/mod.rs"]
mod oracle;
mod page;
#[path = "../../tests/stress/suite/mod.rs"]
mod suite;

use arguments::Arguments;
use std::process::ExitCode;
use std::time::Instant;
use suite::{Case, Row};

fn main() -> ExitCode {
    match run(std::env::args().skip(1)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

/// Runs the cases of a command line. Returns whether all rows hold.
fn run(words: impl Iterator<Item = String>) -> Result<bool, String> {
    let arguments = Arguments::parse(words)?;
    let chosen = |(name, cases): &cases::Group| {
        let cases = cases().into_iter().filter(|case| arguments.chooses(&case.name));
        (*name, cases.collect::<Vec<Case>>())
    };
    let (names, cases): (Vec<&str>, Vec<Vec<Case>>) = cases::GROUPS.iter().map(chosen).unzip();
    let counts: Vec<usize> = cases.iter().map(Vec::len).collect();
    let start = Instant::now();
    let cases: Vec<Case> = cases.into_iter().flatten().collect();
    let mut rows = suite::rows(&cases, start + arguments.time, |case, round, time| {
        eprintln!("round {round}, {:.1} s: {}", time.as_secs_f64(), case.name);
    })
    .into_iter();
    let groups: Vec<(&str, Vec<Row>)> =
        names.into_iter().zip(counts).map(|(name, count)| (name, rows.by_ref().take(count).collect())).collect();
    let tables = page::tables(&groups);
    println!("{tables}");
    if let Some(file) = &arguments.write {
        page::write(file, &tables, start.elapsed())?;
    }
    Ok(groups.iter().flat_map(|(_, rows)| rows).all(|row| row.holds))
}
