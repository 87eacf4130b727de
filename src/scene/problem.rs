use crate::file::shortened;
use std::fmt;

/// An error in a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The path of the value in the file format, like `object[2].radius`; empty for the scene as a whole.
    pub path: String,
    /// The value found and the value expected, with a suggestion if there is one.
    pub message: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (path, message) = (shortened(&self.path), shortened(&self.message));
        if path.is_empty() { f.write_str(&message) } else { write!(f, "{path}: {message}") }
    }
}

/// Most letters of a name for which another one is suggested: the distance of two names takes the product of their lengths.
const LONGEST_SUGGESTED: usize = 64;

/// A suggestion for the end of a message: the known name nearest to `name`, or empty if no name is near.
pub(super) fn suggestion<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    // Typing errors make about one edit in three letters; a larger limit would suggest unrelated words.
    let length = name.chars().count();
    if length > LONGEST_SUGGESTED {
        return String::new();
    }
    let limit = 1 + length / 3;
    known
        .into_iter()
        .filter(|candidate| candidate.len().abs_diff(name.len()) <= 4 * limit)
        .map(|candidate| (strsim::damerau_levenshtein(&name.to_lowercase(), &candidate.to_lowercase()), candidate))
        .filter(|(distance, _)| *distance <= limit)
        .min_by_key(|(distance, _)| *distance)
        .map_or(String::new(), |(_, nearest)| format!("; did you mean \"{nearest}\"?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggests_only_near_names() {
        let known = ["radius", "center", "material"];
        assert_eq!(suggestion("raduis", known), "; did you mean \"radius\"?");
        assert_eq!(suggestion("Center", known), "; did you mean \"center\"?");
        assert_eq!(suggestion("colour", known), "");
    }

    #[test]
    fn long_texts_are_shortened() {
        let problem = Problem { path: "ä".repeat(1000), message: "x".repeat(10_000_000) };
        let text = problem.to_string();
        assert!(text.len() < 1300 && text.starts_with("ää") && text.ends_with('x'), "{}", text.len());
    }
}
