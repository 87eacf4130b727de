//! The types of values that a key can have.

use super::notes::Notes;
use crate::{
    geometry::bezier::ControlNet,
    math::Rgb,
    scene::{Encoding, ToneCurve, UvRect, problem::suggestion},
};
use glam::{DVec2, DVec3};
use toml::de::DeValue;

/// A type that can be read from a TOML value.
pub(super) trait Field: Sized {
    /// The kind of value, in messages.
    const EXPECTED: &'static str;

    /// The value; `None` after reporting a problem at `path`.
    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self>;
}

/// Reports the difference between the found and the expected value; always `None`.
pub(super) fn mismatch<T>(value: &DeValue<'_>, path: &str, expected: &str, notes: &mut Notes) -> Option<T> {
    notes.add(path, format!("found {}, expected {expected}", describe(value)));
    None
}

fn describe(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(s) => format!("the string \"{s}\""),
        DeValue::Integer(n) => format!("the number {n}"),
        DeValue::Float(x) => format!("the number {x}"),
        DeValue::Boolean(b) => b.to_string(),
        DeValue::Datetime(d) => format!("the date {d}"),
        DeValue::Array(a) if a.is_empty() => "an empty list".to_owned(),
        DeValue::Array(a) => format!("a list of {}", a.len()),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// The text of a decimal number, which `f32` and `f64` each parse with one rounding; `None` for other values.
fn decimal(value: &DeValue<'_>) -> Option<String> {
    match value {
        DeValue::Integer(n) if n.radix() == 10 => Some(n.as_str().to_owned()),
        DeValue::Float(x) => Some(x.as_str().to_owned()),
        _ => None,
    }
}

impl Field for f64 {
    const EXPECTED: &'static str = "a number";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        match decimal(value).and_then(|text| text.parse::<Self>().ok()) {
            Some(x) if x.is_finite() => Some(x),
            Some(_) => mismatch(value, path, "a finite number", notes),
            None => mismatch(value, path, Self::EXPECTED, notes),
        }
    }
}

impl Field for f32 {
    const EXPECTED: &'static str = "a number";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        match decimal(value).and_then(|text| text.parse::<Self>().ok()) {
            Some(x) if x.is_finite() => Some(x),
            Some(_) => mismatch(value, path, "a finite number of at most 3.4e38", notes),
            None => mismatch(value, path, Self::EXPECTED, notes),
        }
    }
}

impl Field for bool {
    const EXPECTED: &'static str = "true or false";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        match value {
            DeValue::Boolean(b) => Some(*b),
            _ => mismatch(value, path, Self::EXPECTED, notes),
        }
    }
}

impl Field for u32 {
    const EXPECTED: &'static str = "a whole number";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        let DeValue::Integer(n) = value else { return mismatch(value, path, Self::EXPECTED, notes) };
        Self::from_str_radix(n.as_str(), n.radix()).ok().or_else(|| {
            let expected = if n.as_str().starts_with('-') { "1 or more" } else { "a smaller number" };
            mismatch(value, path, expected, notes)
        })
    }
}

impl Field for i32 {
    const EXPECTED: &'static str = "a whole number";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        let DeValue::Integer(n) = value else { return mismatch(value, path, Self::EXPECTED, notes) };
        let read = Self::from_str_radix(n.as_str(), n.radix()).ok();
        read.or_else(|| mismatch(value, path, "a whole number from -2147483648 to 2147483647", notes))
    }
}

impl Field for String {
    const EXPECTED: &'static str = "a string";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        match value {
            DeValue::String(s) => Some(s.clone().into_owned()),
            _ => mismatch(value, path, Self::EXPECTED, notes),
        }
    }
}

/// The meaning of one of several words.
fn word<T: Copy>(value: &DeValue<'_>, path: &str, words: &[(&str, T)], notes: &mut Notes) -> Option<T> {
    let known = words.iter().map(|(word, _)| *word);
    let expected = known.clone().map(|w| format!("\"{w}\"")).collect::<Vec<_>>().join(" or ");
    let DeValue::String(found) = value else { return mismatch(value, path, &expected, notes) };
    let meaning = words.iter().find(|(word, _)| word == found).map(|(_, meaning)| *meaning);
    meaning.or_else(|| mismatch(value, path, &format!("{expected}{}", suggestion(found, known)), notes))
}

impl Field for ToneCurve {
    const EXPECTED: &'static str = "\"srgb\" or \"filmic\"";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        word(value, path, &[("srgb", Self::Srgb), ("filmic", Self::Filmic)], notes)
    }
}

impl Field for Encoding {
    const EXPECTED: &'static str = "\"srgb\" or \"linear\"";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        word(value, path, &[("srgb", Self::Srgb), ("linear", Self::Linear)], notes)
    }
}

impl<T: Field> Field for Vec<T> {
    const EXPECTED: &'static str = "a list";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        let DeValue::Array(items) = value else {
            return mismatch(value, path, &format!("{}, each of them {}", Self::EXPECTED, T::EXPECTED), notes);
        };
        let read = items.iter().enumerate().map(|(k, item)| {
            let path = format!("{path}[{k}]");
            notes.mark(&path, item.span());
            T::read(item.get_ref(), &path, notes)
        });
        // Reads all items, so that all problems are reported.
        read.collect::<Vec<_>>().into_iter().collect()
    }
}

fn array<T: Field, const N: usize>(
    value: &DeValue<'_>,
    path: &str,
    expected: &str,
    notes: &mut Notes,
) -> Option<[T; N]> {
    match value {
        DeValue::Array(items) if items.len() == N => Vec::read(value, path, notes)?.try_into().ok(),
        _ => mismatch(value, path, expected, notes),
    }
}

impl Field for DVec2 {
    const EXPECTED: &'static str = "two numbers like [4.0, 4.0]";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        array::<f64, 2>(value, path, Self::EXPECTED, notes).map(Self::from_array)
    }
}

impl Field for DVec3 {
    const EXPECTED: &'static str = "three numbers like [0.0, 1.0, 0.0]";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        array::<f64, 3>(value, path, Self::EXPECTED, notes).map(Self::from_array)
    }
}

impl Field for Rgb {
    const EXPECTED: &'static str = "three numbers like [0.5, 0.5, 0.5]";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        array::<f32, 3>(value, path, Self::EXPECTED, notes).map(Self::from_array)
    }
}

/// The texture coordinates of two opposite corners.
impl Field for UvRect {
    const EXPECTED: &'static str = "four numbers like [0.0, 0.0, 1.0, 1.0]";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        let [u0, v0, u1, v1] = array(value, path, Self::EXPECTED, notes)?;
        Some(Self { start: DVec2::new(u0, v0), end: DVec2::new(u1, v1) })
    }
}

/// One row of a control net.
impl Field for [DVec3; 4] {
    const EXPECTED: &'static str = "a row of 4 points, each of three numbers";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        array(value, path, Self::EXPECTED, notes)
    }
}

impl Field for ControlNet {
    const EXPECTED: &'static str = "4 rows of 4 points";

    fn read(value: &DeValue<'_>, path: &str, notes: &mut Notes) -> Option<Self> {
        array(value, path, Self::EXPECTED, notes).map(|points| Self { points })
    }
}
