//! The error estimate over time.

/// Measurements kept at most. Beyond them, every second measurement is dropped.
const CAPACITY: usize = 512;

/// The part of the curve that tells how fast the error falls, powers of ten of the time.
const TELLING: f64 = 0.6;
/// Least length of that part, powers of ten of the time, and least number of measurements.
const LEAST_TELLING: f64 = 0.25;
const LEAST_POINTS: usize = 5;
/// The exponents by which the error may be expected to fall: from that of sharp caustics to that of stratified samples.
const EXPONENTS: [f64; 2] = [-1.0, -0.2];

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

    /// The rendering time from the last measurement until the error is this, seconds, if it falls as it did in the last measurements;
    /// `None` for too few of them.
    pub(crate) fn seconds_until(&self, error: f64) -> Option<f64> {
        let [now, last] = *self.points.last()?;
        let part = &self.points[self.points.partition_point(|point| point[0] < now - TELLING)..];
        if part.len() < LEAST_POINTS || now - part[0][0] < LEAST_TELLING || error <= 0.0 {
            return None;
        }
        let count = part.len() as f64;
        let mean = |k: usize| part.iter().map(|point| point[k]).sum::<f64>() / count;
        let (x, y) = (mean(0), mean(1));
        let product: f64 = part.iter().map(|point| (point[0] - x) * (point[1] - y)).sum();
        let square: f64 = part.iter().map(|point| (point[0] - x).powi(2)).sum();
        let exponent = (product / square).clamp(EXPONENTS[0], EXPONENTS[1]);
        let expected = y + exponent * (now - x);
        let powers = (error.log10() - expected.max(last.min(expected))) / exponent;
        Some((10f64.powf(now + powers.max(0.0)) - 10f64.powf(now)).max(0.0))
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
    fn the_time_left_follows_the_fall_of_the_error() {
        let curve = |exponent: f64| {
            let mut curve = ErrorCurve::default();
            (1..=20).for_each(|k| curve.push(1, f64::from(k), 0.1 * f64::from(k).powf(exponent)));
            curve
        };
        let half = curve(-0.5);
        // 0.01 after 100 s.
        assert!((half.seconds_until(0.01).unwrap() - 80.0).abs() < 0.1, "{:?}", half.seconds_until(0.01));
        assert_eq!(half.seconds_until(0.05), Some(0.0), "it is reached");
        assert!(curve(0.3).seconds_until(0.01).unwrap() > 1e4, "an error that grows will fall some day");
        let mut short = ErrorCurve::default();
        (1..=4).for_each(|k| short.push(1, f64::from(k), 0.1));
        assert_eq!((short.seconds_until(0.01), half.seconds_until(0.0)), (None, None));
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
