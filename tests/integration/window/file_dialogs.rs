//! The desktop's file dialogs, by a stand-in for `zenity`: without a desktop portal the window starts it.

use super::desktop::Desktop;
use super::session::{self, Session};
use super::wait_for;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

/// What the stand-in does.
pub(super) enum Answer<'a> {
    /// Chooses the first path to open, the second to save.
    Paths(&'a Path, &'a Path),
    /// Is cancelled, after a time in which a user can do so.
    Cancel,
    /// Fails at once, as on a display that refuses it.
    Fail,
}

fn folder(desktop: &Desktop) -> PathBuf {
    desktop.home.path().join("bin")
}

/// A desktop where the stand-in is the only program that the window can start.
pub(super) fn desktop_with(answer: &Answer<'_>) -> Desktop {
    let mut desktop = Desktop::start();
    let folder = folder(&desktop);
    fs::create_dir_all(&folder).expect("a folder for the stand-in");
    desktop.environment.push(("PATH", folder.into_os_string()));
    set(&desktop, answer);
    desktop
}

/// Replaces the stand-in's answer.
pub(super) fn set(desktop: &Desktop, answer: &Answer<'_>) {
    let answer = match answer {
        Answer::Paths(open, save) => {
            format!("case \"$*\" in *--save*) echo '{}';; *) echo '{}';; esac", save.display(), open.display())
        }
        Answer::Cancel => "/bin/sleep 0.7; exit 1".to_owned(),
        Answer::Fail => "exit 1".to_owned(),
    };
    let asked = asked_path(desktop);
    let script = format!("#!/bin/sh\nprintf '%s ' \"$@\" >> '{0}'; echo >> '{0}'\n{answer}\n", asked.display());
    let path = folder(desktop).join("zenity");
    fs::write(&path, script).expect("the stand-in is written");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).expect("the stand-in may run");
}

fn asked_path(desktop: &Desktop) -> PathBuf {
    desktop.home.path().join("asked")
}

/// The arguments of the last call of the stand-in, once there were `calls`.
fn asked(desktop: &Desktop, calls: usize) -> String {
    wait_for("call of the file dialog", || {
        let text = fs::read_to_string(asked_path(desktop)).unwrap_or_default();
        (text.lines().count() >= calls).then(|| text.lines().last().unwrap_or_default().to_owned())
    })
}

/// Saves as, until the window shows a field for the path; types the path and confirms.
fn save_by_typing(session: &Session, path: &Path) {
    wait_for("field for the path", || {
        // A dialog that failed slowly counts as cancelled.
        session.key("ctrl+shift+s");
        std::thread::sleep(std::time::Duration::from_millis(500));
        session.has_dialog().then_some(())
    });
    session.desktop.xdotool(&["type", "--delay", "20", &path.display().to_string()]);
    session.key("Return");
    wait_for("saved scene", || path.is_file().then_some(()));
    session.wait_for_no_dialog();
    assert_eq!(session::open(path), session.in_file(), "the same scene");
}

#[test]
fn file_dialogs_open_and_save_and_a_cancelled_one_changes_nothing() {
    let session = Session::start_on(desktop_with(&Answer::Cancel));
    let desktop = &session.desktop;
    let [other, copy] = ["other.toml", "copy.toml"].map(|name| session.folder.path().join(name));
    fs::copy(&session.scene, &other).expect("a second scene");

    session.key("ctrl+o");
    assert!(asked(desktop, 1).contains("--file-selection"));
    set(desktop, &Answer::Paths(&other, &copy));
    std::thread::sleep(std::time::Duration::from_secs(1));
    assert!(desktop.has_title("^scene.toml"), "a cancelled dialog opens nothing");
    assert!(!session.has_dialog(), "nor does it ask for a path");

    session.key("ctrl+o");
    asked(desktop, 2);
    wait_for("other scene", || desktop.has_title("^other.toml").then_some(()));

    session.key("e");
    wait_for("mark of unsaved changes", || desktop.has_title("^\\*other.toml").then_some(()));
    // The window adds the extension.
    set(desktop, &Answer::Paths(&other, &copy.with_extension("")));
    session.key("ctrl+shift+s");
    let arguments = asked(desktop, 3);
    assert!(arguments.contains("--save") && arguments.contains("--confirm-overwrite"), "{arguments}");
    wait_for("copy", || copy.is_file().then_some(()));
    wait_for("title of the copy", || desktop.has_title("^copy.toml").then_some(()));
    assert_eq!(session::open(&copy).film.exposure, 0.5);
    assert_eq!(session::open(&other).film.exposure, 0.0, "the file before stays");

    session.key("e");
    wait_for("mark of unsaved changes", || desktop.has_title("^\\*copy.toml").then_some(()));
    set(desktop, &Answer::Cancel);
    session.key("ctrl+shift+s");
    asked(desktop, 4);
    std::thread::sleep(std::time::Duration::from_secs(1));
    assert!(desktop.has_title("^\\*copy.toml"), "a cancelled dialog saves nothing");
    assert_eq!(session::open(&copy).film.exposure, 0.5);
}

#[test]
fn where_the_file_dialog_fails_or_is_missing_a_path_can_be_typed() {
    let session = Session::start_on(desktop_with(&Answer::Fail));
    save_by_typing(&session, &session.folder.path().join("typed.toml"));
    asked(&session.desktop, 1);
    fs::remove_file(folder(&session.desktop).join("zenity")).expect("the stand-in goes");
    save_by_typing(&session, &session.folder.path().join("again.toml"));
    wait_for("title of the typed file", || session.desktop.has_title("^again.toml").then_some(()));
}
