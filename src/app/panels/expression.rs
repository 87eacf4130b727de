//! Arithmetic in number fields: `0.05 + 0.1`, `2 * (1 - 0.25)`, `0,25`.

/// Parentheses and signs nest at most this deep, so that no text overflows the stack.
const DEEPEST: usize = 64;

/// The value of an arithmetic expression of numbers, `+`, `-`, `*`, `/` and parentheses; a comma is a decimal point. `None`
/// for any other text, and where the value is not finite.
pub(super) fn value_of(text: &str) -> Option<f64> {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).map(plain).collect();
    let mut rest = text.as_str();
    let value = sum(&mut rest, 0)?;
    (rest.is_empty() && value.is_finite()).then_some(value)
}

/// The typed character in the notation of Rust: decimal commas, and the signs of word processors.
fn plain(c: char) -> char {
    match c {
        ',' => '.',
        '−' => '-',
        '×' | '·' => '*',
        '÷' => '/',
        other => other,
    }
}

fn sum(rest: &mut &str, depth: usize) -> Option<f64> {
    let mut value = product(rest, depth)?;
    while let Some(sign) = take(rest, &['+', '-']) {
        let term = product(rest, depth)?;
        value += if sign == '+' { term } else { -term };
    }
    Some(value)
}

fn product(rest: &mut &str, depth: usize) -> Option<f64> {
    let mut value = factor(rest, depth)?;
    while let Some(sign) = take(rest, &['*', '/']) {
        let factor = factor(rest, depth)?;
        value = if sign == '*' { value * factor } else { value / factor };
    }
    Some(value)
}

fn factor(rest: &mut &str, depth: usize) -> Option<f64> {
    if depth > DEEPEST {
        return None;
    }
    match take(rest, &['+', '-', '(']) {
        Some('+') => factor(rest, depth + 1),
        Some('-') => factor(rest, depth + 1).map(|value| -value),
        Some(_) => {
            let value = sum(rest, depth + 1)?;
            take(rest, &[')']).map(|_| value)
        }
        None => number(rest),
    }
}

/// A decimal number, with an exponent where digits follow an `e`.
fn number(rest: &mut &str) -> Option<f64> {
    let mantissa = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
    let exponent = rest[mantissa..].strip_prefix(['e', 'E']).map_or(0, |after| {
        let digits = after.trim_start_matches(['+', '-']);
        let length = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
        if length > 0 { 1 + after.len() - digits.len() + length } else { 0 }
    });
    let (number, after) = rest.split_at(mantissa + exponent);
    *rest = after;
    number.parse().ok()
}

/// Takes the next character if it is one of `wanted`.
fn take(rest: &mut &str, wanted: &[char]) -> Option<char> {
    let next = rest.chars().next().filter(|c| wanted.contains(c))?;
    *rest = &rest[next.len_utf8()..];
    Some(next)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_follows_its_usual_rules() {
        let cases = [
            ("0.05+0.1", 0.05 + 0.1),
            ("0,25", 0.25),
            (" 2 * (1 - 0.25) / 3 ", 2.0 * (1.0 - 0.25) / 3.0),
            ("1-2-3", -4.0),
            ("8/2/2", 2.0),
            ("-2*-3", 6.0),
            ("−1.5e-3+1E2", -1.5e-3 + 1e2),
            ("1e3-1", 999.0),
            (".5", 0.5),
            ("3.", 3.0),
        ];
        for (text, expected) in cases {
            assert_eq!(value_of(text), Some(expected), "{text}");
        }
    }

    #[test]
    fn text_that_is_no_number_has_no_value() {
        let deep = "(".repeat(100_000);
        for text in ["", "nan", "inf", "1/0", "1e999", "1+", "(1", "1)", "1.2.3", "1,2,3", "2e", "x", "--", &deep] {
            assert_eq!(value_of(text), None, "{text}");
        }
    }
}
