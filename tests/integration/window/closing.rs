//! The question about unsaved changes.

use super::session::Session;
use super::{messages, wait_for};

#[test]
fn a_window_with_unsaved_changes_asks_before_it_closes() {
    let mut session = Session::start();
    session.key("e");
    wait_for("mark of unsaved changes", || session.desktop.has_title("^\\*scene.toml").then_some(()));

    messages::close(&session.desktop);
    session.wait_for_dialog();
    // Under the question no shortcut works: this Ctrl+Z would take the changes back.
    session.key("ctrl+z");
    session.key("Escape");
    session.wait_for_no_dialog();
    assert!(session.program.is_alive() && session.desktop.has_title("^\\*scene.toml"), "the changes are still there");
    assert_eq!(session.in_file().film.exposure, 0.0, "and not in the file");
    session.key("e");
    session.key("e");

    messages::close(&session.desktop);
    session.wait_for_dialog();
    session.key("Return");
    wait_for("end of the program", || (!session.program.is_alive()).then_some(()));
    assert_eq!(session.in_file().film.exposure, 1.5, "three steps of half a stop");
}

#[test]
fn a_window_without_unsaved_changes_closes_at_once() {
    let mut session = Session::start();
    messages::close(&session.desktop);
    wait_for("end of the program", || (!session.program.is_alive()).then_some(()));
    let status = session.program.0.wait().expect("a child that has ended");
    assert!(status.success(), "{status}");
}
