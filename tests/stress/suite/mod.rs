//! A table of cases, each with a right value from a closed form or from the oracle, and the verdict on measurements of it.
//!
//! | file | holds |
//! |---|---|
//! | `case` | [`Case`]: one row of the table, as data and a function |
//! | `student` | critical values of Student's t |
//! | `tally` | [`Tally`]: statistics over the rounds of a case; [`Row`]: the result |
//! | `picture` | scenes from text, pictures, and the numbers that cases take from them |
//! | `text` | texts of cameras, materials and lights |

mod case;
mod picture;
mod student;
mod tally;
mod text;

pub(crate) use case::{Case, Expected, Tolerance};
pub(crate) use picture::*;
pub(crate) use tally::Row;
pub(crate) use text::*;

use std::time::{Duration, Instant};
use tally::Tally;

/// Measures each case as often as it needs, then all cases in turn until the end; cases without random numbers once. Calls `progress` with
/// the case, the number of the round and the time after each measurement. Returns a row for each case.
pub(crate) fn rows(cases: &[Case], end: Instant, progress: impl Fn(&Case, u64, Duration)) -> Vec<Row> {
    let mut tallies: Vec<Tally> = cases.iter().map(|_| Tally::default()).collect();
    for round in 0.. {
        let mut is_finished = true;
        for (case, tally) in cases.iter().zip(&mut tallies) {
            let start = Instant::now();
            if round < case.rounds.least() || start < end && case.is_random() {
                tally.add(case, round);
                progress(case, round, start.elapsed());
                is_finished = false;
            }
        }
        if is_finished {
            break;
        }
    }
    cases.iter().zip(&tallies).map(|(case, tally)| tally.row(case)).collect()
}
