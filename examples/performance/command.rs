//! Programs run in the project's folder.

use std::{
    path::Path,
    process::{Command, Stdio},
};

/// The project's folder.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Runs a command, whose words are separated by spaces, and returns its standard output.
pub(crate) fn output(command: &str) -> Result<String, String> {
    let bytes = finished(command, Stdio::piped())?;
    String::from_utf8(bytes).map_err(|e| format!("{command}: {e}"))
}

/// Runs a command whose standard output goes to the terminal.
pub(crate) fn run(command: &str) -> Result<(), String> {
    finished(command, Stdio::inherit()).map(|_| ())
}

fn finished(command: &str, stdout: Stdio) -> Result<Vec<u8>, String> {
    let mut words = command.split(' ');
    let program = words.next().unwrap_or_default();
    let child = Command::new(program).args(words).current_dir(root()).stdout(stdout).spawn();
    let output = child.and_then(|child| child.wait_with_output()).map_err(|e| format!("{command}: {e}"))?;
    if output.status.success() { Ok(output.stdout) } else { Err(format!("{command}: {}", output.status)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failures_name_the_command() {
        assert!(output("rustc --version").unwrap().starts_with("rustc "));
        assert_eq!(run("rustc --no-such-flag").unwrap_err(), "rustc --no-such-flag: exit status: 1");
        assert!(run("no-such-program x").unwrap_err().starts_with("no-such-program x: "));
    }
}
