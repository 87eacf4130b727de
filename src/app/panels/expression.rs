//! Arithmetic in number fields: `0.05 + 0.1`, `2 * (1 - 0.25)`, `0,25`, and changes of the field's number: `+0.1`, `*2`.
//!
//! The parser is our own: `exmex` reads no exponents (`1e-3`), `meval` and `fasteval` have had no release for years, and the
//! licence of `evalexpr` is the AGPL.

/// Parentheses and signs nest at most this deep, so that no text overflows the stack.
const DEEPEST: usize = 64;

/// The number that a typed text makes of a field's number `present`. A text that begins with `+`, `*` or `/` changes
/// `present`, and so does `-=`; `-` alone is the sign of a new number. Any other text is an expression of numbers, `+`, `-`,
/// `*`, `/` and parentheses; a comma is a decimal point. `None` where the text is no expression, and where the result is not
/// finite.
pub(super) fn typed(text: &str, present: f64) -> Option<f64> {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).map(plain).collect();
    let value = match relative(&text) {
        Some((operator, operand)) => {
            let operand = value_of(operand)?;
            match operator {
                '+' => present + operand,
                '-' => present - operand,
                '*' => present * operand,
                _ => present / operand,
            }
        }
        None => value_of(&text)?,
    };
    value.is_finite().then_some(value)
}

/// The operator and the operand of a text that changes a number; `None` for a text that sets it.
fn relative(text: &str) -> Option<(char, &str)> {
    let operator = text.chars().next().filter(|c| "+-*/".contains(*c))?;
    let operand = &text[1..];
    match operand.strip_prefix('=') {
        Some(operand) => Some((operator, operand)),
        None => (operator != '-').then_some((operator, operand)),
    }
}

/// The value of an expression without spaces.
fn value_of(mut text: &str) -> Option<f64> {
    let value = sum(&mut text, 0)?;
    (text.is_empty() && value.is_finite()).then_some(value)
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
            assert_eq!(typed(text, 7.0), Some(expected), "{text}");
        }
    }

    #[test]
    fn an_operator_in_front_changes_the_number() {
        let cases = [
            ("+0.5", 2.5),
            ("+ 2 * 3", 8.0),
            ("+-0.5", 1.5),
            ("+=0,5", 2.5),
            ("-=0.5", 1.5),
            ("-=-1", 3.0),
            ("*3", 6.0),
            ("×=3", 6.0),
            ("/4", 0.5),
            ("/ (1 + 3)", 0.5),
            ("-0.5", -0.5),
            ("-1-1", -2.0),
        ];
        for (text, expected) in cases {
            assert_eq!(typed(text, 2.0), Some(expected), "{text}");
        }
    }

    #[test]
    fn text_that_is_no_number_has_no_value() {
        let deep = "(".repeat(100_000);
        let texts = ["", "nan", "inf", "1/0", "1e999", "1+", "(1", "1)", "1.2.3", "1,2,3", "2e", "x", "--", &deep];
        for text in texts.into_iter().chain(["+", "+=", "-=", "=1", "/0", "**2", "*1e999", "+é"]) {
            assert_eq!(typed(text, 2.0), None, "{text}");
        }
    }
}
