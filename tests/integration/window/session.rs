//! The driver of the window's tests: a scene of two patches in a window, where its points are on the screen, and what the window saves.

use super::desktop::{Desktop, Running};
use super::picture::rectangle_of;
use super::wait_for;
use glam::DVec3;
use patchlight::geometry::bezier::ControlNet;
use patchlight::scene::{Scene, SceneFile, Shape};
use std::path::{Path, PathBuf};

/// The side of the film, pixels: small enough for one screen pixel per film pixel beside the panels.
const FILM: i32 = 400;
/// The background of the scene on the screen; nothing else in the window has this colour.
const BACKGROUND: [u8; 3] = [255, 0, 255];
/// Distance of the camera, which looks along -z, from the plane z = 0 of the patches.
pub(super) const DISTANCE: f64 = 4.0;

/// Two patches in the plane z = 0 with the seam x = 0: P[3][j] of the first is P[0][j] of the second.
const SCENE: &str = r#"
version = 1
name = "two patches"

[camera]
position = [0.0, 0.0, 4.0]
target = [0.0, 0.0, 0.0]
fov_y = 40.0

[film]
width = 400
height = 400

[render]
background = [1.0, 0.0, 1.0]

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
name = "sheet"
type = "bezier"
material = "white"
"#;

/// The text of the scene's file.
pub(super) fn scene_text() -> String {
    let point = |i: i32, j: i32| format!("[{}, {}, 0.0]", 0.3 * f64::from(i), 0.3 * f64::from(j) - 0.45);
    let row = |i| format!("[{}]", (0..4).map(|j| point(i, j)).collect::<Vec<_>>().join(", "));
    let patch = |first: i32| format!("[{}]", (first..first + 4).map(row).collect::<Vec<_>>().join(", "));
    format!("{SCENE}patches = [{}, {}]\n", patch(-3), patch(0))
}

/// A scene file in a window with one screen pixel per film pixel.
pub(super) struct Session {
    pub(super) desktop: Desktop,
    pub(super) program: Running,
    /// The folder of the scene, and of all that a test writes.
    pub(super) folder: tempfile::TempDir,
    pub(super) scene: PathBuf,
    /// The top left pixel of the film on the screen.
    corner: (i32, i32),
}

impl Session {
    pub(super) fn start() -> Self {
        Self::start_on(Desktop::start())
    }

    /// Starts on this desktop.
    pub(super) fn start_on(desktop: Desktop) -> Self {
        let folder = tempfile::tempdir().expect("a folder for the scene");
        let scene = folder.path().join("scene.toml");
        std::fs::write(&scene, scene_text()).expect("the scene is written");
        let program = desktop.open(&scene);
        let mut session = Self { desktop, program, folder, scene, corner: (0, 0) };
        let mut last = None;
        session.corner = wait_for("picture at its size", || {
            session.key("ctrl+1");
            let corner = session.film_corner();
            let rests = last == corner;
            last = corner;
            corner.filter(|_| rests)
        });
        session
    }

    /// The top left pixel of the film on the screen; `None` while the whole film does not show with one screen pixel per film pixel.
    pub(super) fn film_corner(&self) -> Option<(i32, i32)> {
        let place = rectangle_of(&self.desktop.screenshot(), BACKGROUND);
        place.filter(|(.., width, height)| [*width, *height] == [FILM; 2]).map(|(x, y, ..)| (x, y))
    }

    /// Screen pixels per scene unit, across the view direction at the distance of the patches.
    pub(super) fn pixels_per_unit() -> f64 {
        0.5 * f64::from(FILM) / 20.0_f64.to_radians().tan() / DISTANCE
    }

    /// The screen pixel of a point of the plane z = 0, for the camera of the start.
    pub(super) fn pixel(&self, world: DVec3) -> (i32, i32) {
        let scale = Self::pixels_per_unit();
        let (x, y) = (0.5 * f64::from(FILM) + scale * world.x, 0.5 * f64::from(FILM) - scale * world.y);
        (self.corner.0 + x.floor() as i32, self.corner.1 + y.floor() as i32)
    }

    /// Drags with the left button, with keys held down.
    pub(super) fn drag(&self, from: (i32, i32), way: (i32, i32), held: &[&str]) {
        held.iter().for_each(|key| drop(self.desktop.xdotool(&["keydown", key])));
        self.desktop.drag(from, way);
        self.desktop.release();
        held.iter().for_each(|key| drop(self.desktop.xdotool(&["keyup", key])));
    }

    /// Clicks at a screen pixel with the left button.
    pub(super) fn click(&self, (x, y): (i32, i32)) {
        let [x, y] = [x, y].map(|pixel| pixel.to_string());
        self.desktop.xdotool(&["mousemove", &x, &y, "sleep", "0.3", "click", "1", "sleep", "0.3"]);
    }

    /// Waits until a dialog dims the window.
    pub(super) fn wait_for_dialog(&self) {
        wait_for("dialog", || self.has_dialog().then_some(()));
    }

    /// Waits until no dialog dims the window.
    pub(super) fn wait_for_no_dialog(&self) {
        wait_for("window without a dialog", || (!self.has_dialog()).then_some(()));
    }

    /// Whether a dialog dims the window.
    pub(super) fn has_dialog(&self) -> bool {
        rectangle_of(&self.desktop.screenshot(), BACKGROUND).is_none()
    }

    /// The scene in the file.
    pub(super) fn in_file(&self) -> Scene {
        open(&self.scene)
    }

    /// Saves until the file shows what is expected; returns the scene in the file.
    pub(super) fn saved(&self, what: &str, is_expected: impl Fn(&Scene) -> bool) -> Scene {
        let save = || {
            self.key("ctrl+s");
            self.in_file()
        };
        wait_for(what, || Some(save()).filter(&is_expected));
        // In a slow frame, the window takes a key before the last movement of the mouse.
        save()
    }

    /// Presses a key in the window.
    pub(super) fn key(&self, key: &str) {
        self.desktop.key_in_window(key);
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let errors = self.desktop.errors();
            assert!(!errors.contains("panicked"), "the program panicked: {errors}");
        }
    }
}

/// The scene in a file.
pub(super) fn open(path: &Path) -> Scene {
    SceneFile::open(path).expect("a valid scene").scene
}

/// The patches of the scene.
pub(super) fn patches(scene: &Scene) -> &[ControlNet] {
    match &scene.objects[0].shape {
        Shape::Bezier(bezier) => &bezier.patches,
        _ => panic!("the first object has patches"),
    }
}

/// The control point P[i][j] of a patch.
pub(super) fn point(scene: &Scene, patch: usize, (i, j): (usize, usize)) -> DVec3 {
    patches(scene)[patch].points[i][j]
}

/// How far control points moved, by more than rounding: the patch, the indices and the way of each.
pub(super) fn moved(before: &Scene, after: &Scene) -> Vec<(usize, (usize, usize), DVec3)> {
    let indices = (0..patches(before).len()).flat_map(|p| (0..16).map(move |k| (p, (k / 4, k % 4))));
    let ways = indices.map(|(patch, index)| (patch, index, point(after, patch, index) - point(before, patch, index)));
    ways.filter(|(.., way)| way.length() > 1e-9).collect()
}
