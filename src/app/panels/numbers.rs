//! Numbers as text: short, grouped, as a duration, in percent.

/// A target error in percent, to a thousandth; 0 is "never".
pub(super) fn target_text(percent: f64) -> String {
    if percent > 0.0 { format!("{} %", (1e3 * percent).round() / 1e3) } else { "never".to_owned() }
}

/// A positive number with two significant digits.
pub(super) fn two_digits(number: f64) -> String {
    let decimals = (1.0 - number.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{number:.decimals$}");
    if decimals > 0 { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// 1234567 as "1 234 567".
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// 1234567 as "1.23 M".
pub(super) fn short(number: f64) -> String {
    let steps = [(1e12, " T"), (1e9, " G"), (1e6, " M"), (1e3, " k")];
    match steps.into_iter().find(|(size, _)| number >= *size) {
        Some((size, unit)) => format!("{:.2}{unit}", number / size),
        None => format!("{number:.0}"),
    }
}

/// A time in seconds as "12.3 s", "2:05" or "1:02:05".
pub(crate) fn duration(seconds: f64) -> String {
    let whole = seconds.max(0.0) as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, _) => format!("{seconds:.1} s"),
        (0, minutes, seconds) => format!("{minutes}:{seconds:02}"),
        (hours, minutes, seconds) => format!("{hours}:{minutes:02}:{seconds:02}"),
    }
}

/// 0.05 as "5.00 %", and 0.5 as "50 %".
pub(super) fn percent(fraction: f64) -> String {
    let percent = 100.0 * fraction;
    if percent >= 10.0 { format!("{percent:.0} %") } else { format!("{percent:.2} %") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_readable() {
        assert_eq!([grouped(7), grouped(1234), grouped(1_234_567)], ["7", "1 234", "1 234 567"]);
        assert_eq!([short(999.0), short(1234.0), short(2.5e6)], ["999", "1.23 k", "2.50 M"]);
        assert_eq!(
            [two_digits(0.0316), two_digits(1.6), two_digits(10.0), two_digits(251.0)],
            ["0.032", "1.6", "10", "251"]
        );
        assert_eq!([target_text(100.0 * (0.01 * 7.0)), target_text(0.0)], ["7 %", "never"]);
        assert_eq!([duration(5.04), duration(125.9), duration(3725.0)], ["5.0 s", "2:05", "1:02:05"]);
    }
}
