//! The steps of a measurement, and the command of each.

use crate::{command, criterion, machine};
use std::fs;

/// One command, and the name of the block that takes its tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Step {
    pub(crate) name: &'static str,
    pub(crate) source: Source,
}

/// The command of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Source {
    Machine,
    /// `patchlight bench --suite`, a file in `benches/suite`.
    Suite(&'static str),
    /// A benchmark that prints tables.
    Tables(&'static str),
    /// A benchmark that criterion runs.
    Criterion(&'static str),
}

/// In the order of the page.
const STEPS: [Step; 9] = [
    Step { name: "machine", source: Source::Machine },
    Step { name: "references", source: Source::Suite("references") },
    Step { name: "others", source: Source::Suite("others") },
    Step { name: "suite", source: Source::Suite("suite") },
    Step { name: "latency", source: Source::Tables("latency") },
    Step { name: "transport", source: Source::Criterion("transport") },
    Step { name: "skip", source: Source::Tables("skip") },
    Step { name: "growth", source: Source::Tables("growth") },
    Step { name: "patches", source: Source::Criterion("patches") },
];

/// The steps named in `names`, in the order of the page; all steps where `names` is empty.
pub(crate) fn chosen(names: &[String]) -> Result<Vec<Step>, String> {
    if let Some(name) = names.iter().find(|name| STEPS.iter().all(|step| step.name != **name)) {
        return Err(format!("there is no step {name}, but {}", STEPS.map(|step| step.name).join(", ")));
    }
    let is_chosen = |step: &Step| names.is_empty() || names.iter().any(|name| name == step.name);
    Ok(STEPS.into_iter().filter(is_chosen).collect())
}

impl Source {
    /// The command line.
    pub(crate) fn description(self) -> String {
        match self {
            Self::Machine => "the machine".to_owned(),
            Self::Suite(name) => {
                format!(
                    "cargo run --release --features flip -- bench --suite benches/suite/{name}.toml --output docs/performance"
                )
            }
            Self::Tables(name) => format!("cargo bench --features flip --bench {name}"),
            Self::Criterion(name) => format!("cargo bench --bench {name} -- --noplot"),
        }
    }

    /// Runs the command. Returns the text of the block: the tables below the command and the commit.
    pub(crate) fn measure(self, commit: &str) -> Result<String, String> {
        let command = self.description();
        let tables = match self {
            Self::Machine => return machine::table(commit),
            Self::Suite(name) => {
                command::run(&command)?;
                let file = format!("docs/performance/{name}.md");
                fs::read_to_string(command::root().join(&file)).map_err(|e| format!("{file}: {e}"))?
            }
            Self::Tables(_) => command::output(&command)?,
            Self::Criterion(_) => criterion::table(&command::output(&command)?)?,
        };
        Ok(format!("`{command}`, commit {commit}:\n\n{}", tables.trim()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::replaced;

    #[test]
    fn steps_are_chosen_by_name() {
        assert_eq!(chosen(&[]).unwrap(), STEPS);
        let names = ["skip", "machine"].map(str::to_owned);
        assert_eq!(chosen(&names).unwrap().iter().map(|step| step.name).collect::<Vec<_>>(), ["machine", "skip"]);
        let message = chosen(&["grwth".to_owned()]).unwrap_err();
        assert!(message.starts_with("there is no step grwth, but machine, references, "), "{message}");
    }

    #[test]
    fn the_page_has_a_place_for_every_step() {
        let page = include_str!("../../docs/performance.md");
        for step in STEPS {
            assert!(replaced(page, step.name, "").is_ok(), "{}", step.name);
        }
    }
}
