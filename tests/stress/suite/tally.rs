use super::case::{Case, Expected, Tolerance};
use super::student::critical_value;
use std::fmt;

/// Probability with which a row fails although nothing is wrong, over all its values: with two hundred rows, once in five hundred runs.
const SIGNIFICANCE: f64 = 1e-5;

/// Running statistics of the values of a case.
#[derive(Default)]
pub(crate) struct Tally {
    rounds: u64,
    values: Vec<Value>,
}

/// Sums over the rounds for one value.
#[derive(Clone, Copy, Default)]
struct Value {
    got: f64,
    expected: f64,
    /// Mean difference of measured and expected value.
    difference: f64,
    /// Sum of squared deviations from the mean difference.
    squares: f64,
}

/// A finished row of the table. Of several values it shows the one that uses up the most of its tolerance.
pub(crate) struct Row {
    pub(crate) name: String,
    pub(crate) source: &'static str,
    pub(crate) expected: f64,
    pub(crate) got: f64,
    /// Systematic tolerance and random error together.
    pub(crate) tolerance: f64,
    /// The work of all rounds.
    pub(crate) work: String,
    pub(crate) holds: bool,
}

impl Tally {
    /// Measures a case in this round and adds the values.
    pub(crate) fn add(&mut self, case: &Case, round: u64) {
        let got = (case.measure)(round);
        let expected = match &case.expected {
            Expected::Value(value) => vec![*value; got.len()],
            Expected::Sampled(sample) => sample(round),
        };
        assert_eq!(got.len(), expected.len(), "{}: one expected value for each measured one", case.name);
        self.rounds += 1;
        self.values.resize(got.len(), Value::default());
        for (value, (got, expected)) in self.values.iter_mut().zip(got.into_iter().zip(expected)) {
            value.got += got;
            value.expected += expected;
            // Welford's update: the squares do not cancel.
            let off = got - expected - value.difference;
            value.difference += off / self.rounds as f64;
            value.squares += off * (got - expected - value.difference);
        }
    }

    /// The row of a case after at least one round.
    pub(crate) fn row(&self, case: &Case) -> Row {
        let rounds = self.rounds as f64;
        let standard_errors = if self.rounds > 1 {
            critical_value(self.rounds - 1, SIGNIFICANCE / self.values.len() as f64)
        } else {
            0.0
        };
        let rated = self.values.iter().map(|value| {
            let expected = value.expected / rounds;
            let noise = standard_errors * (value.squares / (rounds * (rounds - 1.0).max(1.0))).sqrt();
            let (got, tolerance) = match case.tolerance {
                // Every fault counts, so the row shows their number.
                Tolerance::NoFaults => (value.got, 0.0),
                Tolerance::Absolute(bound) => (value.got / rounds, bound + noise),
                Tolerance::Relative(bound) => (value.got / rounds, bound * expected.abs() + noise),
            };
            // How much of the tolerance is used up; a value that is not a number is the worst of all.
            let used = match (got - expected).abs() {
                0.0 => 0.0,
                off if off.is_finite() => off / tolerance,
                _ => f64::INFINITY,
            };
            (used, [expected, got, tolerance])
        });
        let (used, [expected, got, tolerance]) =
            rated.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, [0.0, f64::NAN, 0.0]));
        Row {
            name: case.name.clone(),
            source: case.source,
            expected,
            got,
            tolerance,
            work: format!("{} {}", grouped(self.rounds * case.work.0), case.work.1),
            holds: used <= 1.0,
        }
    }
}

/// A line of a Markdown table.
impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, source, work, .. } = self;
        let [expected, got, tolerance] = [self.expected, self.got, self.tolerance].map(rounded);
        let verdict = if self.holds { "holds" } else { "**fails**" };
        write!(f, "| {name} | {source} | {expected} | {got} | {tolerance} | {work} | {verdict} |")
    }
}

/// A number with about six digits.
fn rounded(number: f64) -> String {
    match number.abs() {
        size if size > 0.0 && size < 1e-3 => format!("{number:.2e}"),
        size if size >= 1e6 => format!("{number:.4e}"),
        _ => format!("{}", (number * 1e6).round() / 1e6),
    }
}

/// A number with a comma between groups of three digits.
fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let comma = |k: usize| if k > 0 && (digits.len() - k).is_multiple_of(3) { "," } else { "" };
    digits.char_indices().map(|(k, digit)| format!("{}{digit}", comma(k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(tolerance: Tolerance, values: &'static [f64]) -> Row {
        let case = Case::noisy("a", "C1", 1.0, tolerance, (1000, "rays"), |round| values[round as usize]);
        let mut tally = Tally::default();
        (0..values.len() as u64).for_each(|round| tally.add(&case, round));
        tally.row(&case)
    }

    #[test]
    fn noise_adds_to_the_tolerance() {
        let noisy = &[1.1, 0.9, 1.2, 0.8, 1.05, 0.95];
        assert!(row(Tolerance::Absolute(0.0), noisy).holds);
        assert!(!row(Tolerance::Absolute(0.1), &[1.2, 1.2, 1.2]).holds, "without noise the difference counts");
        assert!(row(Tolerance::Relative(0.21), &[1.2, 1.2, 1.2]).holds);
        assert!(!row(Tolerance::Absolute(1.0), &[1.0, f64::NAN, 1.0]).holds, "NaN never holds");
        assert_eq!(row(Tolerance::Absolute(0.0), noisy).work, "6,000 rays");
    }

    #[test]
    fn one_fault_fails_the_row() {
        let case = Case::faults("a", "G4", (7, "rays"), |round| u64::from(round == 3));
        let mut tally = Tally::default();
        (0..100).for_each(|round| tally.add(&case, round));
        let row = tally.row(&case);
        assert!(!row.holds && row.got == 1.0, "{row}");
    }
}
