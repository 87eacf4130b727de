use super::{args::Budget, words::counted};
use crate::engine::Stats;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{Write, stderr};

/// The length of the progress bar, in steps.
const STEPS: u64 = 1000;

/// The progress bar of a rendering, which is visible on terminals only.
pub(super) struct Progress {
    bar: ProgressBar,
    budget: Budget,
}

impl Progress {
    pub(super) fn new(budget: Budget) -> Self {
        let bar = ProgressBar::new(STEPS);
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {msg}") {
            bar.set_style(style);
        }
        Self { bar, budget }
    }

    /// Shows the progress after an iteration, unless the bar was cleared.
    pub(super) fn show(&self, stats: &Stats) {
        if self.bar.is_finished() {
            return;
        }
        let fraction = fraction_done(&self.budget, stats).clamp(0.0, 1.0);
        self.bar.set_position((STEPS as f64 * fraction) as u64);
        let error = stats.error_estimate.map_or(String::new(), |e| format!(", error about {:.1} %", 100.0 * e));
        let missing = stats.missing_light.map_or(String::new(), |missing| format!("; {missing}"));
        self.bar.set_message(format!(
            "{}, {:.0} s{error}{missing}",
            counted(stats.iterations, "iteration"),
            stats.seconds
        ));
    }

    /// Clears the bar for good.
    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// Writes a line to stderr, above the bar.
    pub(super) fn tell(&self, message: &str) {
        // Where stderr cannot be written, nobody reads it.
        self.bar.suspend(|| writeln!(stderr(), "{message}").ok());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.clear();
    }
}

/// The approximate fraction of the budget that is spent.
fn fraction_done(budget: &Budget, stats: &Stats) -> f64 {
    match (budget.iterations, budget.error, stats.error_estimate) {
        (Some(range), _, _) => stats.iterations as f64 / (range.last + 1 - range.first) as f64,
        // Errors fall about as 1 over the square root of time.
        (_, Some(limit), Some(estimate)) => (limit / estimate).powi(2),
        (_, Some(_), None) => 0.0,
        _ => stats.seconds / budget.seconds.unwrap_or(Budget::DEFAULT_SECONDS),
    }
}
