//! Unsaved changes of a killed window.

use super::convergence::SCENE;
use super::desktop::Desktop;
use super::wait_for;
use std::time::Duration;

#[test]
fn unsaved_changes_survive_a_killed_window() {
    let folder = tempfile::tempdir().expect("a folder for the scene");
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, SCENE).expect("the scene is written");
    let desktop = Desktop::start();
    let program = desktop.open(&scene);
    let unsaved = desktop.home.path().join("state/patchlight/unsaved");
    let is_kept = || {
        let mut files = std::fs::read_dir(&unsaved).into_iter().flatten().flatten();
        files.any(|file| file.path().extension().is_some_and(|extension| extension == "toml"))
    };
    wait_for("file with the changes", || {
        desktop.key_in_window("e");
        // Changes are written after a rest.
        std::thread::sleep(Duration::from_secs(3));
        is_kept().then_some(())
    });
    // By SIGKILL.
    drop(program);

    let _program = desktop.open(&scene);
    wait_for("recovered scene, with a mark for unsaved changes in its title", || {
        desktop.key_in_window("Return");
        desktop.has_title("^\\*scene.toml").then_some(())
    });
    let exposure = || patchlight::scene::SceneFile::open(&scene).expect("a valid scene").scene.film.exposure;
    assert_eq!(exposure(), 0.0, "the file is as it was");
    wait_for("saved scene", || {
        desktop.key_in_window("ctrl+s");
        (exposure() > 0.0).then_some(())
    });
    wait_for("state folder without changes", || (!is_kept()).then_some(()));
}
