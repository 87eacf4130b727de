//! The machine and the commit of a measurement.

use crate::command::output;
use std::{fs, thread};

/// A Markdown table of the processor, the threads, the compiler and the commit.
pub(crate) fn table(commit: &str) -> Result<String, String> {
    let processors = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let processor = model(&processors).unwrap_or("unknown");
    let threads = thread::available_parallelism().map_or(1, |n| n.get());
    let compiler = output("rustc --version")?;
    let compiler = compiler.trim();
    Ok(format!(
        "| processor | threads | compiler | commit |\n|---|--:|---|---|\n| {processor} | {threads} | {compiler} | {commit} |"
    ))
}

/// The measured commit, followed by "with changes" where a file outside `docs` differs from it.
pub(crate) fn commit() -> Result<String, String> {
    let commit = output("git rev-parse --short HEAD")?;
    let changes = output("git status --porcelain --untracked-files=no -- . :!docs")?;
    Ok(format!("{}{}", commit.trim(), if changes.is_empty() { "" } else { " with changes" }))
}

/// The model of the first processor in `/proc/cpuinfo`; `None` where it lists none.
fn model(processors: &str) -> Option<&str> {
    let line = processors.lines().find(|line| line.starts_with("model name"))?;
    line.split_once(": ").map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_has_a_name() {
        let text = "processor\t: 0\nmodel\t\t: 143\nmodel name\t: Some CPU @ 2.50GHz\n\nprocessor\t: 1\n";
        assert_eq!(model(text), Some("Some CPU @ 2.50GHz"));
        assert_eq!(model(""), None);
    }
}
