/// One row of the table: a quantity whose right value is known, and a function that measures it.
pub(crate) struct Case {
    /// The name, unique in the table.
    pub(crate) name: String,
    /// Where the right value comes from: a closed form (C1 to C12), a hazard (G1, O1, ...), a field case or the oracle.
    pub(crate) source: &'static str,
    /// The right value.
    pub(crate) expected: Expected,
    /// The largest error of a mean over infinitely many rounds.
    pub(crate) tolerance: Tolerance,
    /// The rounds that the case needs.
    pub(crate) rounds: Rounds,
    /// The work of one round: a number and its unit.
    pub(crate) work: (u64, &'static str),
    /// The measured values in a round; the round seeds all random numbers. Several values, such as means of blocks, are compared one by
    /// one.
    pub(crate) measure: Measure,
}

/// A function from the number of a round, from 0, to values.
pub(crate) type Measure = Box<dyn Fn(u64) -> Vec<f64>>;

/// The right values of a case.
pub(crate) enum Expected {
    /// One value for all measured ones.
    Value(f64),
    /// Values with random errors of their own, such as pictures of the oracle.
    Sampled(Measure),
}

/// The systematic error that a measurement may have. Random errors come on top, by the standard error over the rounds.
#[derive(Clone, Copy)]
pub(crate) enum Tolerance {
    /// In units of the value.
    Absolute(f64),
    /// A fraction of the expected value.
    Relative(f64),
    /// The case counts faults; every fault counts, in any round.
    NoFaults,
}

/// How often a case is measured.
#[derive(Clone, Copy)]
pub(crate) enum Rounds {
    /// Once: nothing is random.
    Once,
    /// At least so often.
    AtLeast(u64),
}

/// Rounds of a case with noise: the standard error over them has an uncertainty of a quarter.
const NOISY: u64 = 8;

impl Rounds {
    /// The least number of rounds.
    pub(crate) fn least(self) -> u64 {
        match self {
            Self::Once => 1,
            Self::AtLeast(rounds) => rounds,
        }
    }
}

impl Case {
    /// Whether another round measures anything new.
    pub(crate) fn is_random(&self) -> bool {
        matches!(self.rounds, Rounds::AtLeast(_))
    }

    /// A case with noise.
    pub(crate) fn noisy(
        name: impl Into<String>,
        source: &'static str,
        expected: f64,
        tolerance: Tolerance,
        work: (u64, &'static str),
        measure: impl Fn(u64) -> f64 + 'static,
    ) -> Self {
        let measure: Measure = Box::new(move |round| vec![measure(round)]);
        let rounds = Rounds::AtLeast(NOISY);
        Self { name: name.into(), source, expected: Expected::Value(expected), tolerance, rounds, work, measure }
    }

    /// A case without random numbers.
    pub(crate) fn exact(
        name: impl Into<String>,
        source: &'static str,
        expected: f64,
        tolerance: Tolerance,
        work: (u64, &'static str),
        measure: impl Fn() -> f64 + 'static,
    ) -> Self {
        Self { rounds: Rounds::Once, ..Self::noisy(name, source, expected, tolerance, work, move |_| measure()) }
    }

    /// A case that counts faults, of which none is right.
    pub(crate) fn faults(
        name: impl Into<String>,
        source: &'static str,
        work: (u64, &'static str),
        measure: impl Fn(u64) -> u64 + 'static,
    ) -> Self {
        let rounds = Rounds::AtLeast(1);
        Self { rounds, ..Self::noisy(name, source, 0.0, Tolerance::NoFaults, work, move |round| measure(round) as f64) }
    }

    /// A case of several values, each of which is to equal its expected value.
    pub(crate) fn values(
        name: impl Into<String>,
        source: &'static str,
        expected: Expected,
        tolerance: Tolerance,
        work: (u64, &'static str),
        measure: impl Fn(u64) -> Vec<f64> + 'static,
    ) -> Self {
        let rounds = Rounds::AtLeast(NOISY);
        Self { name: name.into(), source, expected, tolerance, rounds, work, measure: Box::new(measure) }
    }
}
