use std::path::PathBuf;
use std::time::Duration;

/// The command line.
#[derive(Default)]
pub(crate) struct Arguments {
    /// The time after which no case is measured more often than it needs.
    pub(crate) time: Duration,
    /// The page to write.
    pub(crate) write: Option<PathBuf>,
    /// Parts of names of cases; none for all cases.
    names: Vec<String>,
}

impl Arguments {
    /// The arguments of these words.
    pub(crate) fn parse(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut arguments = Self::default();
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or_else(|| format!("{word} needs a value"));
            match word.as_str() {
                "--minutes" => {
                    let minutes = value()?;
                    let time =
                        minutes.parse().ok().and_then(|minutes: f64| Duration::try_from_secs_f64(60.0 * minutes).ok());
                    arguments.time = time.ok_or_else(|| format!("--minutes: `{minutes}` is no time"))?;
                }
                "--write" => arguments.write = Some(value()?.into()),
                _ if word.starts_with('-') => return Err(format!("there is no {word}, but --minutes and --write")),
                _ => arguments.names.push(word),
            }
        }
        Ok(arguments)
    }

    /// Whether the case of this name is to be run.
    pub(crate) fn chooses(&self, name: &str) -> bool {
        self.names.is_empty() || self.names.iter().any(|part| name.contains(part.as_str()))
    }
}
