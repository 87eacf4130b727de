//! Files that are dragged onto the window.

use super::messages::drop_files;
use super::session::{self, Session, patches};
use super::wait_for;
use std::fs;

#[test]
fn dropped_files_are_opened_and_added() {
    let session = Session::start();
    // File managers escape all signs that a URI does not have.
    let [other, surface, text] =
        ["other (2) ä.toml", "a 50% sheet.bpt", "notes.txt"].map(|name| session.folder.path().join(name));
    fs::copy(&session.scene, &other).expect("a second scene");
    let flat = (0..16).map(|k| format!("{} {} 0.5\n", 0.1 * f64::from(k / 4), 0.1 * f64::from(k % 4)));
    fs::write(&surface, format!("1\n3 3\n{}", flat.collect::<String>())).expect("a patch");
    fs::write(&text, "no scene").expect("a text");

    drop_files(&session.desktop, &[&other], || {
        // The hint dims the window.
        session.wait_for_dialog();
    });
    // xdotool knows ASCII alone.
    wait_for("other scene", || session.desktop.has_title("^other .2. ").then_some(()));
    session.wait_for_no_dialog();

    drop_files(&session.desktop, &[&text], || {});
    drop_files(&session.desktop, &[&surface], || {});
    wait_for("added patches", || {
        session.key("ctrl+s");
        (session::open(&other).objects.len() == 2).then_some(())
    });
    assert_eq!(patches(&session::open(&other)), patches(&session.in_file()), "the first object stays");
}
