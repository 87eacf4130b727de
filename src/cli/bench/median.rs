use super::measurement::Measurement;
use crate::film::Errors;

/// An RMSE and a relMSE, or a slope of each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    pub(super) rmse: f64,
    pub(super) rel_mse: f64,
}

/// The medians over the seeds at one mark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Median {
    pub(super) mark: f64,
    /// The actual time of the iterations.
    pub(super) seconds: f64,
    pub(super) errors: Pair,
    /// The errors outside the mask; `None` without a mask.
    pub(super) outside: Option<Pair>,
    /// The mean FLIP, if it was measured.
    pub(super) flip: Option<f64>,
    /// The median of [`Measurement::estimate_over_error`].
    pub(super) estimate_over_error: Option<f64>,
}

/// The medians of each mark, in ascending order.
pub(super) fn medians(rows: &[Measurement]) -> Vec<Median> {
    let mut marks: Vec<_> = rows.iter().map(|row| row.mark).collect();
    marks.sort_by(f64::total_cmp);
    marks.dedup();
    marks.into_iter().map(|mark| at_mark(mark, rows)).collect()
}

fn at_mark(mark: f64, rows: &[Measurement]) -> Median {
    let rows: Vec<_> = rows.iter().filter(|row| row.mark == mark).collect();
    let outside: Vec<_> = rows.iter().filter_map(|row| row.outside).collect();
    let flips: Vec<_> = rows.iter().filter_map(|row| row.flip).collect();
    let estimates: Vec<_> = rows.iter().filter_map(|row| row.estimate_over_error()).collect();
    Median {
        mark,
        seconds: median(rows.iter().map(|row| row.stats.seconds)),
        errors: pair(rows.iter().map(|row| row.errors)),
        outside: (!outside.is_empty()).then(|| pair(outside.into_iter())),
        flip: (!flips.is_empty()).then(|| median(flips.into_iter())),
        estimate_over_error: (!estimates.is_empty()).then(|| median(estimates.into_iter())),
    }
}

fn pair(errors: impl Iterator<Item = Errors> + Clone) -> Pair {
    Pair { rmse: median(errors.clone().map(|e| e.rmse)), rel_mse: median(errors.map(|e| e.rel_mse)) }
}

/// The median; NaN for no values.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<_> = values.collect();
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    match (values.get(half), half.checked_sub(1).and_then(|k| values.get(k))) {
        (Some(upper), Some(lower)) if values.len().is_multiple_of(2) => (lower + upper) / 2.0,
        (Some(middle), _) => *middle,
        (None, _) => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        engine::Stats,
        film::{LinearImage, compare},
    };

    #[test]
    fn median_of_odd_and_even_counts() {
        assert_eq!(median([3.0, 1.0, 9.0].into_iter()), 3.0);
        assert_eq!(median([4.0, 1.0, 9.0, 2.0].into_iter()), 3.0);
        assert_eq!(median([5.0].into_iter()), 5.0);
        assert!(median([].into_iter()).is_nan());
    }

    #[test]
    fn marks_are_kept_apart() {
        let black = LinearImage::black(1, 1);
        let errors = compare(&black, &black, None).unwrap();
        let row = |seed, mark, seconds, rmse| Measurement {
            seed,
            mark,
            stats: Stats { seconds, ..Stats::default() },
            errors: Errors { rmse, ..errors },
            outside: Some(Errors { rel_mse: 2.0 * rmse, ..errors }),
            flip: Some(0.1 * rmse),
            flip_outside: None,
        };
        let rows = [row(0, 1.0, 0.9, 4.0), row(0, 2.0, 1.9, 1.0), row(1, 1.0, 0.7, 6.0), row(1, 2.0, 1.7, 2.0)];
        let medians = medians(&rows);
        assert_eq!(medians.iter().map(|m| m.mark).collect::<Vec<_>>(), [1.0, 2.0]);
        assert!((medians[0].seconds - 0.8).abs() < 1e-12);
        assert_eq!((medians[0].errors.rmse, medians[1].errors.rmse), (5.0, 1.5));
        assert_eq!(medians[0].flip, Some(0.5));
        assert_eq!(medians[1].outside, Some(Pair { rmse: 0.0, rel_mse: 3.0 }));
    }
}
