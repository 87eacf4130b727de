use super::median::{Median, Pair};

/// Slopes use the marks from the last mark divided by this factor on: early errors fall at another rate.
const OCTAVES: f64 = 4.0;

/// The powers of time by which the errors fall in the last two octaves of time. `None` without two different times, or if an
/// error is 0.
pub(super) fn slopes(medians: &[Median]) -> Option<Pair> {
    let last = medians.last()?.mark;
    let late = medians.iter().filter(|median| median.mark >= last / OCTAVES);
    let slope = |error: fn(&Median) -> f64| log_slope(late.clone().map(|median| (median.seconds, error(median))));
    let slopes = Pair { rmse: slope(|m| m.errors.rmse), rel_mse: slope(|m| m.errors.rel_mse) };
    (slopes.rmse.is_finite() && slopes.rel_mse.is_finite()).then_some(slopes)
}

/// The slope of the line through the logarithms of (x, y), by least squares: y falls as x to this power. NaN without two
/// different x.
fn log_slope(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let logs: Vec<_> = points.map(|(x, y)| (x.ln(), y.ln())).collect();
    let Some((first, _)) = logs.first() else { return f64::NAN };
    if logs.iter().all(|(x, _)| x == first) {
        return f64::NAN;
    }
    let n = logs.len() as f64;
    let mean = logs.iter().fold((0.0, 0.0), |m, (x, y)| (m.0 + x / n, m.1 + y / n));
    let sums = logs
        .iter()
        .fold((0.0, 0.0), |s, (x, y)| (s.0 + (x - mean.0) * (y - mean.1), s.1 + (x - mean.0) * (x - mean.0)));
    sums.0 / sums.1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(mark: f64, rmse: f64) -> Median {
        Median {
            mark,
            seconds: mark,
            errors: Pair { rmse, rel_mse: rmse * rmse },
            outside: None,
            flip: None,
            estimate_over_error: None,
        }
    }

    #[test]
    fn powers_have_their_exponent_as_slope() {
        let points = [1.0, 2.0, 4.0, 7.0].map(|x: f64| (x, 3.0 * x.powf(-0.5)));
        assert!((log_slope(points.into_iter()) + 0.5).abs() < 1e-12);
        assert!(log_slope([(3.0, 2.0)].into_iter()).is_nan());
        // The mean of three equal logarithms may differ from them by a rounding.
        assert!(log_slope([(0.3, 2.0), (0.3, 3.0), (0.3, 5.0)].into_iter()).is_nan());
    }

    #[test]
    fn only_the_last_two_octaves_count() {
        let late = [4.0, 8.0, 16.0].map(|t: f64| at(t, t.powf(-0.3)));
        let slopes = slopes(&[&[at(0.5, 1e3), at(2.0, 1e-9)], &late[..]].concat()).unwrap();
        assert!((slopes.rmse + 0.3).abs() < 1e-12 && (slopes.rel_mse + 0.6).abs() < 1e-12, "{slopes:?}");
    }

    #[test]
    fn there_is_no_slope_without_two_times_or_errors() {
        assert_eq!(slopes(&[]), None);
        assert_eq!(slopes(&[at(1.0, 0.5), at(16.0, 0.1)]), None, "one mark in the last two octaves");
        let same = Median { seconds: 1.0, ..at(2.0, 0.5) };
        assert_eq!(slopes(&[at(1.0, 0.5), same]), None, "the same picture at both marks");
        assert_eq!(slopes(&[at(1.0, 0.5), at(2.0, 0.0)]), None, "no error at all");
    }
}
