//! The picture follows a drag and converges again.

use super::desktop::{Desktop, SCREEN};
use super::picture::{Picture, settled};
use super::wait_for;

const MIDDLE: (i32, i32) = (SCREEN.0 as i32 / 2, SCREEN.1 as i32 / 2);

/// A bent sheet over a floor. Its corner P[0][0] is in the middle of the picture, before the black background: where it
/// is dragged to, the picture becomes bright.
pub(super) const SCENE: &str = r#"
version = 1
name = "window test"

[camera]
position = [0.0, 0.0, 4.0]
target = [0.0, 0.0, 0.0]
fov_y = 40.0

[film]
width = 160
height = 160

[[material]]
name = "white"
type = "diffuse"
albedo = [0.7, 0.7, 0.7]

[[light]]
name = "lamp"
type = "point"
position = [0.0, 1.5, 1.5]
intensity = [6.0, 6.0, 6.0]

[[object]]
name = "floor"
type = "quad"
corner = [-2.0, -1.0, 2.0]
edge_u = [4.0, 0.0, 0.0]
edge_v = [0.0, 0.0, -4.0]
material = "white"

[[object]]
name = "sheet"
type = "bezier"
material = "white"
patches = [[
  [[0.0, 0.0, 0.0], [0.0, -0.3, 0.0], [0.0, -0.6, 0.0], [0.0, -0.9, 0.0]],
  [[0.5, 0.0, 0.0], [0.5, -0.3, 1.0], [0.5, -0.6, 0.0], [0.5, -0.9, 0.0]],
  [[1.0, 0.0, 0.0], [1.0, -0.3, 0.0], [1.0, -0.6, 0.0], [1.0, -0.9, 0.0]],
  [[1.5, 0.0, 0.0], [1.5, -0.3, 0.0], [1.5, -0.6, 0.0], [1.5, -0.9, 0.0]],
]]
"#;

#[test]
fn the_picture_follows_a_dragged_control_point_and_converges_again() {
    let folder = tempfile::tempdir().expect("a folder for the scene");
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, SCENE).expect("the scene is written");
    let desktop = Desktop::start();
    let _program = desktop.open(&scene);
    wait_for("picture in the window", || (Picture::of(&desktop).brightness() > 20.0).then_some(()));

    // Without panels the picture is in the middle of the screen; without handles the picture alone is compared.
    desktop.key("ctrl+b");
    desktop.key("h");
    let (before, _) = settled(&desktop, |_| 1.0);
    desktop.key("h");
    let with_handles = Picture::of(&desktop);
    desktop.drag(MIDDLE, (-150, -120));
    // The lines that move with the point are a few thousandths of the picture.
    let changes = || Picture::of(&desktop).difference(&with_handles);
    wait_for("other picture while the button is down", || (changes() > 2.0).then_some(()));
    desktop.release();
    desktop.key("h");

    let (after, differences) = settled(&desktop, |first| (0.5 * first).min(1.0));
    let remaining = differences.last().copied().unwrap_or_default();
    let changed = after.difference(&before);
    assert!(changed > 5.0 * remaining, "it changed by {changed}, of which noise is {remaining}: {differences:?}");

    desktop.key("ctrl+z");
    let (undone, _) = settled(&desktop, |_| 1.0);
    let back = undone.difference(&before);
    assert!(back < 0.5 * changed, "after undo it differs by {back} from before, after the drag by {changed}");
}
