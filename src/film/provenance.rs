//! How a picture came about, for its file.

use crate::scene::Camera;

/// How a picture came about.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// The text of the scene with its size, settings and patches: [`SceneFile::snapshot`](crate::scene::SceneFile::snapshot). `None` where
    /// it is not known.
    pub scene: Option<String>,
    /// Settings of the rendering that are not in the scene: names and values.
    pub settings: Vec<(&'static str, String)>,
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
    /// The name of the field that holds the scene.
    const SCENE: &'static str = "Scene";

    /// Names and values, without the program; the scene comes last.
    pub fn fields(&self) -> Vec<(&'static str, String)> {
        let iterations = ("Iterations", self.iterations.to_string());
        let error = self.error.map(|error| ("Relative error", format!("{error:.3e}")));
        let scene = self.scene.clone().map(|scene| (Self::SCENE, scene));
        [iterations].into_iter().chain(error).chain(self.settings.iter().cloned()).chain(scene).collect()
    }

    /// All fields in one text: a line each, an empty line, and the scene.
    pub(super) fn comment(&self) -> String {
        let line = |(name, value): (&str, String)| match name {
            Self::SCENE => format!("\n{value}"),
            _ => format!("{name}: {value}\n"),
        };
        self.fields().into_iter().map(line).collect()
    }

    /// The iterations, the error and the scene of a [`Self::comment`]; what the text lacks stays unknown.
    pub(super) fn of_comment(comment: &str) -> Self {
        let (lines, scene) = comment.split_once("\n\n").unwrap_or((comment, ""));
        let value = |wanted: &str| {
            let pairs = lines.lines().filter_map(|line| line.split_once(": "));
            pairs.filter(|(name, _)| *name == wanted).map(|(_, value)| value).next()
        };
        Self {
            scene: (!scene.is_empty()).then(|| scene.to_owned()),
            iterations: value("Iterations").and_then(|text| text.parse().ok()).unwrap_or_default(),
            error: value("Relative error").and_then(|text| text.parse().ok()),
            ..Self::default()
        }
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
        let with_settings = Provenance { settings: vec![("Seed", "3".to_owned())], ..provenance.clone() };
        assert_eq!(Provenance::of_comment(&with_settings.comment()), provenance);
    }

    #[test]
    fn a_comment_of_another_program_tells_nothing() {
        for comment in ["", "a picture", "Iterations: many\n\n", "Relative error: \n"] {
            assert_eq!(Provenance::of_comment(comment), Provenance::default(), "{comment}");
        }
    }
}
