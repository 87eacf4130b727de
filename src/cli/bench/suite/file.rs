//! The file of a suite.

use crate::cli::{CliError, args::ComponentName};
use crate::file::read_text_limited;
use serde::Deserialize;
use std::{
    num::NonZeroU64,
    path::{Path, PathBuf},
};

/// The rendering time of a reference, relative to the last mark: it then has a quarter of the noise.
const REFERENCE_FACTOR: f64 = 16.0;

/// Most bytes of the file: some hundred thousand runs.
const MAX_BYTES: u64 = 16 << 20;

/// The contents of the file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Suite {
    run: Vec<Entry>,
}

/// One `[[run]]`. Paths are relative to the file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Entry {
    pub(super) name: Name,
    /// A scene file, or the name of a built-in scene.
    pub(super) scene: PathBuf,
    pub(super) reference: Option<PathBuf>,
    /// A second reference with independent noise.
    pub(super) second_reference: Option<PathBuf>,
    reference_seconds: Option<Positive>,
    pub(super) mask: Option<PathBuf>,
    /// The component of the light that is measured; all by default.
    pub(super) only: Option<ComponentName>,
    /// The relMSE of another program, to compare with.
    pub(super) others: Option<Positive>,
    pub(super) seconds: Marks,
    #[serde(default = "one")]
    pub(super) seeds: NonZeroU64,
}

impl Entry {
    /// The rendering time of the reference, in seconds, for a run without a reference image.
    pub(super) fn reference_seconds(&self) -> f64 {
        let last = self.seconds.0.iter().copied().fold(0.0, f64::max);
        self.reference_seconds.as_ref().map_or(REFERENCE_FACTOR * last, |seconds| seconds.0)
    }
}

/// A name that file names can contain.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct Name(pub(super) String);

impl TryFrom<String> for Name {
    type Error = &'static str;

    fn try_from(name: String) -> Result<Self, Self::Error> {
        let fits = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_');
        fits.then_some(Self(name))
            .ok_or("expected a name of letters, digits, \"-\" and \"_\", which becomes the name of files")
    }
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "f64")]
pub(super) struct Positive(pub(super) f64);

impl TryFrom<f64> for Positive {
    type Error = &'static str;

    fn try_from(number: f64) -> Result<Self, Self::Error> {
        let fits = number.is_finite() && number > 0.0;
        fits.then_some(Self(number)).ok_or("expected a number above 0")
    }
}

/// The marks, in seconds.
#[derive(Debug, Deserialize)]
#[serde(try_from = "Vec<f64>")]
pub(super) struct Marks(pub(super) Vec<f64>);

impl TryFrom<Vec<f64>> for Marks {
    type Error = &'static str;

    fn try_from(seconds: Vec<f64>) -> Result<Self, Self::Error> {
        let fits = !seconds.is_empty() && seconds.iter().all(|x| x.is_finite() && *x > 0.0);
        fits.then_some(Self(seconds)).ok_or("expected one or more numbers above 0")
    }
}

fn one() -> NonZeroU64 {
    NonZeroU64::MIN
}

/// The runs of a suite.
pub(super) fn read(path: &Path) -> Result<Vec<Entry>, CliError> {
    let wrong = |message: &str| CliError::Usage(format!("{}: {message}", path.display()));
    let text = read_text_limited(path, MAX_BYTES).map_err(|e| wrong(&format!("cannot be read: {e}")))?;
    parse(&text).map_err(|message| wrong(&message))
}

fn parse(text: &str) -> Result<Vec<Entry>, String> {
    let suite: Suite = toml::from_str(text).map_err(|e| e.to_string().trim_end().to_owned())?;
    if suite.run.is_empty() {
        return Err("the suite has no run; add a [[run]] with name, scene and seconds".to_owned());
    }
    for (k, entry) in suite.run.iter().enumerate() {
        let Name(name) = &entry.name;
        // Some file systems ignore case in names.
        if suite.run[..k].iter().any(|other| other.name.0.eq_ignore_ascii_case(name)) {
            return Err(format!("two runs have the name \"{name}\"; rename one of them"));
        }
        if entry.reference.is_some() && entry.reference_seconds.is_some() {
            return Err(format!("run \"{name}\": expected reference or reference_seconds, found both"));
        }
        if entry.second_reference.is_some() && entry.reference.is_none() {
            return Err(format!("run \"{name}\": second_reference requires reference"));
        }
    }
    Ok(suite.run)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RUN: &str = "[[run]]\nname = \"a\"\nscene = \"a.toml\"\nseconds = [1, 0.5]\n";

    #[test]
    fn missing_keys_have_defaults() {
        let runs = parse(RUN).unwrap();
        assert_eq!((runs.len(), runs[0].seeds.get(), runs[0].reference_seconds()), (1, 1, 16.0));
        let runs = parse(&format!("{RUN}reference_seconds = 3\nseeds = 5")).unwrap();
        assert_eq!((runs[0].seeds.get(), runs[0].reference_seconds()), (5, 3.0));
    }

    #[test]
    fn mistakes_are_named() {
        let twice = format!("{RUN}{RUN}");
        let both = format!("{RUN}reference = \"a.exr\"\nreference_seconds = 2");
        for (text, part) in [
            ("", "missing field `run`"),
            ("run = []", "add a [[run]]"),
            (&format!("{RUN}scnee = 1"), "unknown field `scnee`, expected one of `name`, `scene`"),
            (&RUN.replace("scene", "mask"), "missing field `scene`"),
            (&RUN.replace("[1, 0.5]", "1"), "expected a sequence"),
            (&RUN.replace("[1, 0.5]", "[]"), "expected one or more numbers above 0"),
            (&RUN.replace("[1, 0.5]", "[1, -1]"), "expected one or more numbers above 0"),
            (&RUN.replace("[1, 0.5]", "[inf]"), "expected one or more numbers above 0"),
            (&RUN.replace("\"a\"", "\"../a\""), "expected a name of letters"),
            (&format!("{RUN}seeds = 0"), "line 5, column 9"),
            (&format!("{RUN}reference_seconds = 0"), "expected a number above 0"),
            (&format!("{RUN}others = -1e-4"), "expected a number above 0"),
            (&format!("{RUN}second_reference = \"b.exr\""), "run \"a\": second_reference requires reference"),
            (&twice.replacen("\"a\"", "\"A\"", 1), "two runs have the name \"a\""),
            (&both, "expected reference or reference_seconds, found both"),
        ] {
            let message = parse(text).unwrap_err();
            assert!(message.contains(part), "should say {part:?}, but says\n{message}");
        }
    }
}
