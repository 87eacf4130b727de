use std::f64::consts::PI;

/// The value that Student's t with `degrees` degrees of freedom exceeds, up or down, with this probability.
pub(crate) fn critical_value(degrees: u64, probability: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1e9);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if tails(middle, degrees) > probability { low = middle } else { high = middle }
    }
    high
}

/// The probability that |t| exceeds `t`, by the finite series for whole degrees of freedom (Abramowitz and Stegun 26.7.3, 26.7.4).
fn tails(t: f64, degrees: u64) -> f64 {
    let angle = (t / (degrees as f64).sqrt()).atan();
    let (sin, cos) = angle.sin_cos();
    let is_odd = degrees % 2 == 1;
    // Even: 1 + 1/2 cos^2 + (1 3)/(2 4) cos^4 + ...; odd: cos + 2/3 cos^3 + (2 4)/(3 5) cos^5 + ...
    let (mut term, mut sum) = (if is_odd { cos } else { 1.0 }, 0.0);
    for k in 0..degrees / 2 {
        sum += term;
        let even = (2 * k + 1) as f64 + f64::from(u8::from(is_odd));
        term *= even / (even + 1.0) * cos * cos;
    }
    let inside = if is_odd { 2.0 / PI * (angle + sin * sum) } else { sin * sum };
    (1.0 - inside).max(0.0)
}

#[test]
fn critical_values_match_published_tables() {
    for (degrees, probability, t) in [
        (1, 0.05, 12.706),
        (2, 0.05, 4.303),
        (7, 0.01, 3.499),
        (7, 0.001, 5.408),
        (30, 0.001, 3.646),
        (15, 0.0001, 5.239),
    ] {
        let found = critical_value(degrees, probability);
        assert!((found / t - 1.0).abs() < 3e-4, "{degrees} degrees of freedom: {found}, the table says {t}");
    }
}
