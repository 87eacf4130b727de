use crate::{engine::Stats, film::Errors};

/// A picture's error at some time.
#[derive(Clone, Debug)]
pub(super) struct Measurement {
    pub(super) seed: u64,
    /// Seconds at which it should be taken.
    pub(super) mark: f64,
    /// At that time; its seconds are those that iterations really took.
    pub(super) stats: Stats,
    pub(super) errors: Errors,
}

/// The slope of the line through the logarithms of (x, y), by least squares: y falls like x to this power. Not a
/// number where there are no two different x.
pub(super) fn log_slope(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let logs: Vec<_> = points.map(|(x, y)| (x.ln(), y.ln())).collect();
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

    #[test]
    fn powers_have_their_exponent_as_slope() {
        let points = [1.0, 2.0, 4.0, 7.0].map(|x: f64| (x, 3.0 * x.powf(-0.5)));
        assert!((log_slope(points.into_iter()) + 0.5).abs() < 1e-12);
        assert!(log_slope([(1.0, 2.0)].into_iter()).is_nan());
    }
}
