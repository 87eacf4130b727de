//! The error estimate over time.

/// Measurements kept at most. Beyond them, every second measurement is dropped.
const CAPACITY: usize = 512;

/// The error estimates of one generation over its rendering time.
#[derive(Clone, Debug, Default)]
pub(crate) struct ErrorCurve {
    generation: u64,
    /// Decimal logarithms of seconds and relative error: the error falls with a power of time, which is a straight line here.
    points: Vec<[f64; 2]>,
}

impl ErrorCurve {
    /// Decimal logarithms of the rendering time in seconds and of the relative error, in order of time.
    pub(crate) fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Clears the curve if `generation` is new.
    pub(crate) fn begin(&mut self, generation: u64) {
        if self.generation != generation {
            *self = Self { generation, points: Vec::new() };
        }
    }

    /// Appends a measurement: the relative error after `seconds` of rendering.
    pub(crate) fn push(&mut self, generation: u64, seconds: f64, error: f64) {
        self.begin(generation);
        let later = self.points.last().is_none_or(|last| last[0] < seconds.log10());
        if later && seconds > 0.0 && error > 0.0 {
            self.points.push([seconds.log10(), error.log10()]);
        }
        if self.points.len() > CAPACITY {
            let mut keep = false;
            self.points.retain(|_| {
                keep = !keep;
                keep
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_generation_clears_the_curve() {
        let mut curve = ErrorCurve::default();
        curve.push(1, 1.0, 0.1);
        curve.push(1, 10.0, 0.01);
        assert_eq!(curve.points, [[0.0, -1.0], [1.0, -2.0]]);
        curve.push(2, 0.1, 1.0);
        assert_eq!(curve.points, [[-1.0, 0.0]]);
    }

    #[test]
    fn the_curve_stays_small_and_keeps_its_start() {
        let mut curve = ErrorCurve::default();
        for second in 1..=10_000 {
            curve.push(1, f64::from(second), 0.5);
        }
        assert!(curve.points.len() <= CAPACITY, "{}", curve.points.len());
        assert_eq!(curve.points.first().map(|point| point[0]), Some(0.0), "the first second");
    }
}
