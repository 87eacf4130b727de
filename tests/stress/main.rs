//! The stress suite: every case with the least number of rounds. `cargo run --release --example stress` runs the same cases for as long as it
//! is told to, and writes `docs/stability.md`.
//!
//! | folder | holds |
//! |---|---|
//! | `suite/` | a table of cases, statistics and verdicts |
//! | `cases/` | the cases |
//! | `oracle/` | a brute-force path tracer |
//! | `inputs/` | damaged and random files |

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::print_stderr, reason = "a file that makes the program fail is shown")]

mod cases;
mod inputs;
mod oracle;
mod suite;

use std::time::Instant;

/// Asserts the rows of a group.
fn assert_holds(group: &str) {
    let (_, cases) = cases::GROUPS.iter().find(|(name, _)| *name == group).expect("a group");
    let cases = cases();
    let rows = suite::rows(&cases, Instant::now(), |_, _, _| {});
    let failed: Vec<String> = rows.iter().filter(|row| !row.holds).map(suite::Row::to_string).collect();
    assert!(failed.is_empty(), "{} of {} rows failed:\n{}", failed.len(), rows.len(), failed.join("\n"));
}

/// A test for each group, so that each can be run alone.
macro_rules! tests {
    ($($test:ident: $group:literal),* $(,)?) => {
        $(#[test]
        fn $test() {
            assert_holds($group);
        })*

        #[test]
        fn every_group_has_a_test() {
            let tested = [$($group),*];
            assert_eq!(cases::GROUPS.map(|(name, _)| name), tested);
        }
    };
}

tests! {
    closed_forms: "closed forms",
    geometry: "geometry",
    optics: "optics",
    photons: "photons",
    long_runs: "long runs",
    sampling: "sampling",
    sweeps: "sweeps",
    furnaces: "furnaces",
    energy: "energy",
    bodies: "bodies",
    far_away: "far away",
    determinism: "determinism",
    field: "field",
    files: "files",
}
