//! The tables on standard output.

use super::{
    measurement::Measurement,
    median::{Median, Pair, medians},
    slope::slopes,
};
use std::fmt::Write;

/// The header of the table of measurements; with a mask it has columns for the pixels outside.
pub(super) fn header(masked: bool) -> String {
    let outside = if masked { format!("{:>11} {:>11} ", "RMSE out", "relMSE out") } else { String::new() };
    format!(
        "{:>8} {:>4} {:>10} {:>11} {:>12} {:>10} {:>10} {:>10} {:>12} {outside} {}",
        "seconds",
        "seed",
        "iterations",
        "photons",
        "rays",
        "RMSE",
        "relMSE",
        "RMSE 99.9%",
        "relMSE 99.9%",
        "mean/true R G B"
    )
}

/// The line of a measurement.
pub(super) fn line(row: &Measurement) -> String {
    let (stats, errors) = (&row.stats, &row.errors);
    let [r, g, b] = errors.mean_ratio;
    let outside = row.outside.map_or(String::new(), |e| format!("{:>11.5} {:>11.3e} ", e.rmse, e.rel_mse));
    format!(
        "{:>8.2} {:>4} {:>10} {:>11} {:>12} {:>10.5} {:>10.3e} {:>10.5} {:>12.3e} {outside} {r:.4} {g:.4} {b:.4}",
        stats.seconds,
        row.seed,
        stats.iterations,
        stats.photons_emitted,
        stats.rays,
        errors.rmse,
        errors.rel_mse,
        errors.rmse_trimmed,
        errors.rel_mse_trimmed,
    )
}

/// The medians of several seeds, the rate at which errors fall, and the time of each pass.
pub(super) fn summary(rows: &[Measurement], seeds: u64) -> String {
    let medians = medians(rows);
    let mut text = if seeds > 1 { median_lines(&medians, seeds) } else { String::new() };
    if let Some(Pair { rmse, rel_mse }) = slopes(&medians) {
        text += &format!("RMSE falls as t^{rmse:.2}, relMSE as t^{rel_mse:.2}, over the last two octaves of time\n");
    }
    if let Some(last) = rows.last() {
        let passes = &last.stats.passes;
        let total = last.stats.seconds / 100.0;
        // Writing to a string cannot fail.
        writeln!(
            text,
            "time: camera {:.0} %, photons {:.0} %, photon map {:.0} %, gather {:.0} %, commit {:.0} %; \
             prepared in {:.3} s",
            passes.camera / total,
            passes.photons / total,
            passes.map / total,
            passes.gather / total,
            passes.commit / total,
            passes.prepare,
        )
        .ok();
    }
    text
}

fn median_lines(medians: &[Median], seeds: u64) -> String {
    let masked = medians.iter().any(|median| median.outside.is_some());
    let outside = if masked { format!(" {:>11} {:>11}", "RMSE out", "relMSE out") } else { String::new() };
    let mut text =
        format!("medians of {seeds} seeds\n{:>8} {:>10} {:>10} {:>10}{outside}\n", "mark", "seconds", "RMSE", "relMSE");
    for Median { mark, seconds, errors, outside, .. } in medians {
        let outside = outside.map_or(String::new(), |e| format!(" {:>11.5} {:>11.3e}", e.rmse, e.rel_mse));
        text += &format!("{mark:>8} {seconds:>10.2} {:>10.5} {:>10.3e}{outside}\n", errors.rmse, errors.rel_mse);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        engine::Stats,
        film::{Errors, LinearImage, compare},
    };

    fn row(seed: u64, mark: f64, rmse: f64, outside: Option<f64>) -> Measurement {
        let black = LinearImage::black(1, 1);
        let errors = compare(&black, &black, None).unwrap();
        let stats = Stats { seconds: mark, ..Stats::default() };
        let with = |rmse| Errors { rmse, rel_mse: rmse * rmse, ..errors };
        Measurement {
            seed,
            mark,
            stats,
            errors: with(rmse),
            outside: outside.map(with),
            flip: None,
            flip_outside: None,
        }
    }

    #[test]
    fn columns_are_as_wide_as_their_heads() {
        for outside in [None, Some(0.25)] {
            let (head, line) = (header(outside.is_some()), line(&row(0, 1.0, 0.5, outside)));
            let numbers = line.find("NaN NaN NaN").unwrap();
            assert_eq!(head.find("mean/true"), Some(numbers), "\n{head}\n{line}");
            assert_eq!(line.contains(" 0.25000    6.250e-2 "), outside.is_some(), "{line}");
        }
    }

    #[test]
    fn medians_stand_below_several_seeds() {
        let rows = [row(0, 1.0, 0.5, None), row(1, 1.0, 0.1, None), row(2, 1.0, 0.2, None)];
        let text = summary(&rows, 3);
        assert!(text.starts_with("medians of 3 seeds\n"), "{text}");
        assert!(text.contains("       1       1.00    0.20000   4.000e-2\n"), "{text}");
        assert!(!text.contains("falls as"), "a single time has no slope: {text}");
        assert!(!summary(&rows[..1], 1).contains("median"));
    }
}
