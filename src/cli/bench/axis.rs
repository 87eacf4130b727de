/// The values that an axis can show. Errors beyond are meaningless: references are rendered in 32 bits.
const RANGE: std::ops::Range<f64> = 1e-30..1e30;

/// The margin between the values and the ends of the axis, a factor.
const ROOM: f64 = 1.05;

/// The number of labels that fit beside each other.
const LABELS: i32 = 10;

/// A logarithmic axis that begins and ends with round numbers: 1, 2 or 5 times a power of ten.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    pub(super) low: f64,
    pub(super) high: f64,
    /// The values with labels, ascending.
    pub(super) labels: Vec<f64>,
    /// The values with grid lines, ascending.
    pub(super) lines: Vec<f64>,
}

/// Whether an axis can show a value.
pub(super) fn is_shown(value: f64) -> bool {
    RANGE.contains(&value)
}

/// The axis of all values that can be shown; around 1 without such values.
pub(super) fn axis(values: impl Iterator<Item = f64>) -> Axis {
    let ends = values.filter(|x| is_shown(*x)).fold(None, |ends: Option<(f64, f64)>, x| {
        let (low, high) = ends.unwrap_or((x, x));
        Some((low.min(x), high.max(x)))
    });
    let (least, greatest) = ends.unwrap_or((1.0, 1.0));
    let (mut first, mut last) = (3 * decade(least), 3 * decade(greatest));
    // The number at `first` is at most the least value, and that at `last` at most the greatest.
    while round(first + 1) * ROOM <= least {
        first += 1;
    }
    first -= i32::from(round(first) * ROOM > least);
    while round(last) < greatest * ROOM {
        last += 1;
    }
    let labels = (first..=last).filter(|k| last - first < LABELS || k % (3 * stride(first, last)) == 0);
    let tens = decade(least) - 1..=decade(greatest);
    let lines = tens.flat_map(|ten| (1..10).map(move |n| f64::from(n) * 10f64.powi(ten)));
    let (low, high) = (round(first), round(last));
    Axis { low, high, labels: labels.map(round).collect(), lines: lines.filter(|x| (low..=high).contains(x)).collect() }
}

/// The label of a round number.
pub(super) fn label(x: f64) -> String {
    if (1e-3..1e5).contains(&x) {
        format!("{x:.*}", usize::try_from(-decade(x)).unwrap_or(0))
    } else {
        format!("{x:.0e}")
    }
}

/// The exponent of the power of ten at or below a number; the factor compensates rounding.
fn decade(x: f64) -> i32 {
    (x * (1.0 + 1e-9)).log10().floor() as i32
}

/// The round numbers in ascending order; the number with index 0 is 1.
fn round(index: i32) -> f64 {
    let digit = match index.rem_euclid(3) {
        0 => 1.0,
        1 => 2.0,
        _ => 5.0,
    };
    digit * 10f64.powi(index.div_euclid(3))
}

/// The number of powers of ten from one label to the next.
fn stride(first: i32, last: i32) -> i32 {
    1 + (last - first) / (3 * LABELS)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(values: &[f64]) -> Vec<String> {
        axis(values.iter().copied()).labels.into_iter().map(label).collect()
    }

    #[test]
    fn ends_and_labels_are_round() {
        assert_eq!(labels(&[0.25, 16.0]), ["0.2", "0.5", "1", "2", "5", "10", "20"]);
        assert_eq!(labels(&[0.021, 0.034]), ["0.02", "0.05"], "less than a decade");
        assert_eq!(labels(&[0.0012]), ["0.001", "0.002"]);
        assert_eq!(labels(&[1.0]), ["0.5", "1", "2"], "a value keeps away from the ends");
        assert_eq!(labels(&[2e-6, 0.3]), ["1e-6", "1e-5", "1e-4", "0.001", "0.01", "0.1"]);
        assert_eq!(labels(&[300.0, 3e4]), ["200", "500", "1000", "2000", "5000", "10000", "20000", "50000"]);
    }

    #[test]
    fn every_value_has_room() {
        for exponent in -290..290 {
            let (a, b) = (1.1f64.powi(exponent), 1.1f64.powi(exponent + exponent.rem_euclid(40)));
            let axis = axis([a, b].into_iter());
            assert!(axis.low * 1.04 <= a && b * 1.04 <= axis.high, "{a} {b} {axis:?}");
            assert!(a < 6.0 * axis.low && axis.high < 6.0 * b, "no decade is empty: {a} {b} {axis:?}");
        }
    }

    #[test]
    fn labels_stay_few() {
        for orders in 0..29 {
            let axis = axis([1e-29, 3.0 * 10f64.powi(orders)].into_iter());
            assert!((2..=11).contains(&axis.labels.len()), "{axis:?}");
        }
    }

    #[test]
    fn values_without_logarithm_are_skipped() {
        assert_eq!(labels(&[0.0, f64::NAN, f64::INFINITY, -1.0]), ["0.5", "1", "2"]);
        assert_eq!(labels(&[0.0, 0.25, f64::NAN, 16.0]), labels(&[0.25, 16.0]));
    }

    #[test]
    fn lines_stand_at_every_digit() {
        let lines: Vec<_> = axis([0.9, 1.9].into_iter()).lines.into_iter().map(label).collect();
        assert_eq!(lines, ["0.5", "0.6", "0.7", "0.8", "0.9", "1", "2"]);
    }
}
