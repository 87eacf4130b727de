//! How a picture came about, for its file.

use crate::scene::Camera;

/// Names of fields.
const ITERATIONS: &str = "Iterations";
const ERROR: &str = "Relative error";
const SCENE: &str = "Scene";

/// How a picture came about.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// The text of the scene with its size, settings and patches: [`SceneFile::snapshot`](crate::scene::SceneFile::snapshot). `None` where
    /// it is not known.
    pub scene: Option<String>,
    /// Settings of the rendering that are not in the scene: names and values.
    pub settings: Vec<(String, String)>,
    /// Number of iterations.
    pub iterations: u64,
    /// Estimated RMSE over the mean radiance; `None` where it is not known.
    pub error: Option<f64>,
    /// The camera; `None` where it is not known.
    pub camera: Option<Camera>,
}

impl Provenance {
    /// The program and its version.
    pub const SOFTWARE: &'static str = concat!("patchlight ", env!("CARGO_PKG_VERSION"));

    /// Names and values, without the program; the scene comes last.
    pub fn fields(&self) -> Vec<(String, String)> {
        let named = |name: &str, value: String| (name.to_owned(), value);
        let iterations = named(ITERATIONS, self.iterations.to_string());
        let error = self.error.map(|error| named(ERROR, format!("{error:.3e}")));
        let scene = self.scene.clone().map(|scene| named(SCENE, scene));
        [iterations].into_iter().chain(error).chain(self.settings.iter().cloned()).chain(scene).collect()
    }

    /// All fields in one text: a line each, an empty line, and the scene.
    pub(super) fn comment(&self) -> String {
        let line = |(name, value): (String, String)| match name.as_str() {
            SCENE => format!("\n{value}"),
            _ => format!("{name}: {}\n", value.replace('\n', " ")),
        };
        self.fields().into_iter().map(line).collect()
    }

    /// The provenance of a [`Self::comment`], without the camera; what the text lacks stays unknown.
    pub(super) fn of_comment(comment: &str) -> Self {
        let (lines, scene) = comment.split_once("\n\n").unwrap_or((comment, ""));
        let mut found = Self { scene: (!scene.is_empty()).then(|| scene.to_owned()), ..Self::default() };
        for (name, value) in lines.lines().filter_map(|line| line.split_once(": ")) {
            match name {
                ITERATIONS => found.iterations = value.parse().unwrap_or_default(),
                ERROR => found.error = value.parse().ok(),
                _ => found.settings.push((name.to_owned(), value.to_owned())),
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_keeps_what_a_later_window_needs() {
        let provenance = Provenance {
            scene: Some("version = 1\n\n[camera]\nposition = [0, 0, 1]\n".to_owned()),
            iterations: 12,
            error: Some(0.0125),
            ..Provenance::default()
        };
        let named = |name: &str| Provenance {
            settings: vec![("Seed".to_owned(), "3".to_owned()), ("Name".to_owned(), name.to_owned())],
            ..provenance.clone()
        };
        assert_eq!(Provenance::of_comment(&named("a: b").comment()), named("a: b"));
        assert_eq!(Provenance::of_comment(&named("two\n\nlines").comment()), named("two  lines"));
    }

    #[test]
    fn a_comment_of_another_program_tells_nothing() {
        for comment in ["", "a picture", "Iterations: many\n\n", "Relative error: a\n"] {
            assert_eq!(Provenance::of_comment(comment), Provenance::default(), "{comment}");
        }
    }
}
