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
        if self.path.is_empty() { f.write_str(&self.message) } else { write!(f, "{}: {}", self.path, self.message) }
    }
}

/// Whether `path` is `ancestor` or the path of a value inside it.
pub(super) fn is_within(path: &str, ancestor: &str) -> bool {
    path.strip_prefix(ancestor)
        .is_some_and(|rest| rest.is_empty() || ancestor.is_empty() || rest.starts_with(['.', '[']))
}

/// A suggestion for the end of a message: the known name nearest to `name`, or empty if no name is near.
pub(super) fn suggestion<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    // Typing errors make about one edit in three letters; a larger limit would suggest unrelated words.
    let limit = 1 + name.chars().count() / 3;
    known
        .into_iter()
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
    fn paths_nest() {
        assert!(is_within("object[2].radius", "object[2]"));
        assert!(is_within("object[2]", "object[2]"));
        assert!(is_within("anything", ""));
        assert!(!is_within("object[21]", "object[2]"));
    }
}
