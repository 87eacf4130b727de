//! The real window on a display of its own: a mouse drags in it, and screenshots show its picture.
//!
//! It takes the Debian packages xvfb, xdotool, imagemagick and the libraries of a window; where a package is missing the
//! tests fail and name it.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

const PROGRAM: &str = env!("CARGO_BIN_EXE_patchlight");
/// Timeout of a wait, for a loaded machine; an idle machine needs a few seconds.
const PATIENCE: Duration = Duration::from_secs(120);
const SCREEN: (u32, u32) = (1280, 800);
/// Half the side of the compared square in the middle of the screen, screen pixels.
const HALF: u32 = 300;

/// A bent sheet over a floor. Its corner P[0][0] is in the middle of the picture, before the black background: where it
/// is dragged to, the picture becomes bright.
const SCENE: &str = r#"
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

/// A child process that does not outlive its owner.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // Fails where the process has already ended.
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

/// A display without a monitor, and a keyboard and a mouse for it.
struct Desktop {
    display: String,
    /// In place of the user's folders.
    home: tempfile::TempDir,
    _server: Running,
}

fn missing(tool: &str, package: &str, error: &std::io::Error) -> String {
    format!("{tool} cannot be started ({error}); `apt install {package}` installs it")
}

impl Desktop {
    fn start() -> Self {
        let screen = format!("{}x{}x24", SCREEN.0, SCREEN.1);
        let server = Command::new("Xvfb")
            // It would begin anew whenever its last client has gone, and meanwhile answer none.
            .args(["-displayfd", "1", "-screen", "0", &screen, "-nolisten", "tcp", "-noreset"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let mut server = Running(server.unwrap_or_else(|error| panic!("{}", missing("Xvfb", "xvfb", &error))));
        let mut number = String::new();
        let stdout = server.0.stdout.take().expect("the pipe was asked for");
        BufReader::new(stdout).read_line(&mut number).expect("Xvfb says which display it took");
        assert!(!number.trim().is_empty(), "Xvfb found no free display");
        let home = tempfile::tempdir().expect("a folder for what the window keeps");
        Self { display: format!(":{}", number.trim()), home, _server: server }
    }

    fn run(&self, tool: &str, package: &str, arguments: &[&str]) -> Output {
        let output = Command::new(tool).args(arguments).env("DISPLAY", &self.display).output();
        output.unwrap_or_else(|error| panic!("{}", missing(tool, package, &error)))
    }

    fn xdotool(&self, arguments: &[&str]) -> String {
        let output = self.run("xdotool", "xdotool", arguments);
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    }

    fn open(&self, scene: &Path) -> Running {
        let program = Command::new(PROGRAM)
            .arg(scene)
            .env("DISPLAY", &self.display)
            .env_remove("WAYLAND_DISPLAY")
            .env("XDG_STATE_HOME", self.home.path().join("state"))
            .env("XDG_CONFIG_HOME", self.home.path().join("config"))
            .spawn();
        let mut program = Running(program.expect("the program that was built starts"));
        let window = wait_for("a window", || {
            assert_eq!(program.0.try_wait().expect("the state of a child is known"), None, "the program ended");
            Some(self.xdotool(&["search", "--onlyvisible", "--name", "patchlight"])).filter(|found| !found.is_empty())
        });
        // No window manager is there to focus the window.
        self.xdotool(&["windowfocus", "--sync", window.lines().next().unwrap_or_default()]);
        program
    }

    /// Presses a key in the window, which may have lost the keyboard while it opened.
    fn key_in_window(&self, key: &str) {
        let window = self.xdotool(&["search", "--onlyvisible", "--name", "patchlight"]);
        self.xdotool(&["windowfocus", "--sync", window.lines().next().unwrap_or_default()]);
        self.key(key);
    }

    /// The middle of the screen.
    fn picture(&self) -> Picture {
        let output = self.run("import", "imagemagick", &["-window", "root", "png:-"]);
        let screen = image::load_from_memory(&output.stdout).expect("a screenshot is a PNG file").to_rgb8();
        let (x, y) = (SCREEN.0 / 2 - HALF, SCREEN.1 / 2 - HALF);
        Picture(image::imageops::crop_imm(&screen, x, y, 2 * HALF, 2 * HALF).to_image())
    }

    fn key(&self, key: &str) {
        self.xdotool(&["key", key]);
        // The next frames of the window show the effect of the key.
        std::thread::sleep(Duration::from_millis(500));
    }

    fn drag_from_middle(&self, (dx, dy): (i32, i32), steps: i32) {
        let at = |step: i32| {
            let x = SCREEN.0 as i32 / 2 + dx * step / steps;
            let y = SCREEN.1 as i32 / 2 + dy * step / steps;
            self.xdotool(&["mousemove", &x.to_string(), &y.to_string()]);
            std::thread::sleep(Duration::from_millis(30));
        };
        at(0);
        std::thread::sleep(Duration::from_millis(300));
        self.xdotool(&["mousedown", "1"]);
        (0..=steps).for_each(at);
    }
}

struct Picture(image::RgbImage);

impl Picture {
    /// Mean absolute difference, 8-bit steps a channel.
    fn difference(&self, other: &Self) -> f64 {
        let (a, b) = (self.0.as_raw(), other.0.as_raw());
        a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / a.len() as f64
    }

    fn brightness(&self) -> f64 {
        self.0.as_raw().iter().map(|value| f64::from(*value)).sum::<f64>() / self.0.as_raw().len() as f64
    }
}

fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(start.elapsed() < PATIENCE, "there is no {what} after {PATIENCE:?}");
        std::thread::sleep(Duration::from_millis(200));
    }
}

/// Watches the picture until two screenshots a second apart differ by less than `limit`; returns the last and the
/// differences seen on the way.
fn settled(desktop: &Desktop, limit: impl Fn(f64) -> f64) -> (Picture, Vec<f64>) {
    let mut differences = Vec::new();
    let mut last = desktop.picture();
    wait_for("converged picture", || {
        std::thread::sleep(Duration::from_secs(1));
        let next = desktop.picture();
        differences.push(next.difference(&last));
        last = next;
        let first = differences.first().copied().unwrap_or_default();
        (differences.len() > 2 && differences.iter().rev().take(2).all(|d| *d < limit(first))).then_some(())
    });
    (last, differences)
}

#[test]
fn the_picture_follows_a_dragged_control_point_and_converges_again() {
    let folder = tempfile::tempdir().expect("a folder for the scene");
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, SCENE).expect("the scene is written");
    let desktop = Desktop::start();
    let _program = desktop.open(&scene);
    wait_for("picture in the window", || (desktop.picture().brightness() > 20.0).then_some(()));

    // Without panels the picture is in the middle of the screen; without handles the picture alone is compared.
    desktop.key("ctrl+b");
    desktop.key("h");
    let (before, _) = settled(&desktop, |_| 1.0);
    desktop.key("h");
    let with_handles = desktop.picture();
    desktop.drag_from_middle((-150, -120), 12);
    // The lines that move with the point are a few thousandths of the picture.
    let changes = || desktop.picture().difference(&with_handles);
    wait_for("other picture while the button is down", || (changes() > 2.0).then_some(()));
    desktop.xdotool(&["mouseup", "1"]);
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
        Some(desktop.xdotool(&["search", "--name", "^\\*scene.toml"])).filter(|found| !found.is_empty())
    });
    let exposure = || patchlight::scene::SceneFile::open(&scene).expect("a valid scene").scene.film.exposure;
    assert_eq!(exposure(), 0.0, "the file is as it was");
    wait_for("saved scene", || {
        desktop.key_in_window("ctrl+s");
        (exposure() > 0.0).then_some(())
    });
    wait_for("state folder without changes", || (!is_kept()).then_some(()));
}

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
