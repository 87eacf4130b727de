//! Without a display that answers, a message names the commands that work.

use super::PROGRAM;
use std::process::{Command, Output};

#[test]
fn without_a_display_a_message_names_the_commands_that_work() {
    let output =
        Command::new(PROGRAM).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET").output();
    explains_itself(&output.expect("the program that was built starts"));
}

#[test]
fn without_an_answer_of_the_display_a_message_names_the_commands_that_work() {
    let output = Command::new(PROGRAM).env("DISPLAY", ":54321").env_remove("WAYLAND_DISPLAY").output();
    explains_itself(&output.expect("the program that was built starts"));
}

fn explains_itself(output: &Output) {
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("apt install"), "the package: {message}");
    assert!(message.contains("patchlight render"), "a command that works: {message}");
    assert!(!message.contains("panicked"), "no panic: {message}");
    assert!(!message.contains(".rs:"), "no line of a source file: {message}");
}
