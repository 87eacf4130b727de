//! A display without a monitor, and a keyboard and a mouse for it.

use super::{PROGRAM, wait_for};
use image::RgbImage;
use std::ffi::OsString;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

pub(super) const SCREEN: (u32, u32) = (1280, 800);

/// A child process that does not outlive its owner.
pub(super) struct Running(pub(super) Child);

impl Running {
    /// Whether the process has not ended.
    pub(super) fn is_alive(&mut self) -> bool {
        self.0.try_wait().expect("the state of a child is known").is_none()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // Fails where the process has already ended.
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

/// A display with its keyboard and mouse.
pub(super) struct Desktop {
    pub(super) display: String,
    /// In place of the user's folders.
    pub(super) home: tempfile::TempDir,
    /// Variables of the programs that start here.
    pub(super) environment: Vec<(&'static str, OsString)>,
    _server: Running,
}

fn missing(tool: &str, package: &str, error: &std::io::Error) -> String {
    format!("{tool} cannot be started ({error}); `apt install {package}` installs it")
}

impl Desktop {
    pub(super) fn start() -> Self {
        Self::start_scaled(1)
    }

    /// A display with this many screen pixels a point along each side, and programs that know it.
    pub(super) fn start_scaled(scale: u32) -> Self {
        let screen = format!("{}x{}x24", scale * SCREEN.0, scale * SCREEN.1);
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
        let environment = vec![
            ("XDG_STATE_HOME", home.path().join("state").into_os_string()),
            ("XDG_CONFIG_HOME", home.path().join("config").into_os_string()),
            ("WINIT_X11_SCALE_FACTOR", scale.to_string().into()),
            // No desktop of the user shows the dialogs of these windows.
            ("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nonexistent".into()),
        ];
        Self { display: format!(":{}", number.trim()), home, environment, _server: server }
    }

    pub(super) fn run(&self, tool: &str, package: &str, arguments: &[&str]) -> Output {
        let output = Command::new(tool).args(arguments).env("DISPLAY", &self.display).output();
        output.unwrap_or_else(|error| panic!("{}", missing(tool, package, &error)))
    }

    pub(super) fn xdotool(&self, arguments: &[&str]) -> String {
        let output = self.run("xdotool", "xdotool", arguments);
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    }

    pub(super) fn open(&self, scene: &Path) -> Running {
        let errors = File::options().create(true).append(true).open(self.errors_path());
        let program = Command::new(PROGRAM)
            .arg(scene)
            .env("DISPLAY", &self.display)
            .env_remove("WAYLAND_DISPLAY")
            .envs(self.environment.iter().map(|(name, value)| (name, value)))
            .stderr(errors.expect("a file for the messages of the program"))
            .spawn();
        let mut program = Running(program.expect("the program that was built starts"));
        wait_for("window", || {
            assert!(program.is_alive(), "the program ended: {}", self.errors());
            self.window()
        });
        self.focus();
        program
    }

    fn errors_path(&self) -> PathBuf {
        self.home.path().join("errors")
    }

    /// What the programs wrote to their standard error.
    pub(super) fn errors(&self) -> String {
        std::fs::read_to_string(self.errors_path()).unwrap_or_default()
    }

    /// The number of the window; `None` while there is none.
    pub(super) fn window(&self) -> Option<String> {
        self.xdotool(&["search", "--onlyvisible", "--name", "patchlight"]).lines().next().map(str::to_owned)
    }

    /// Gives the window the keyboard. No window manager does, and the window may lose the keyboard while it opens.
    fn focus(&self) {
        self.xdotool(&["windowfocus", "--sync", &self.window().unwrap_or_default()]);
    }

    /// Whether the window's title matches a regular expression.
    pub(super) fn has_title(&self, expression: &str) -> bool {
        !self.xdotool(&["search", "--name", expression]).is_empty()
    }

    /// Presses a key in the window, which may have lost the keyboard.
    pub(super) fn key_in_window(&self, key: &str) {
        self.focus();
        self.key(key);
    }

    pub(super) fn key(&self, key: &str) {
        self.xdotool(&["key", key]);
        // The next frames of the window show the effect of the key.
        std::thread::sleep(Duration::from_millis(300));
    }

    pub(super) fn screenshot(&self) -> RgbImage {
        let output = self.run("import", "imagemagick", &["-window", "root", "png:-"]);
        image::load_from_memory(&output.stdout).expect("a screenshot is a PNG file").to_rgb8()
    }

    /// Presses the left button at a screen pixel and moves the mouse by a way. The button stays down. The pauses are longer than a slow
    /// frame of the window: a press and a release in one frame are no drag.
    pub(super) fn drag(&self, (x, y): (i32, i32), (dx, dy): (i32, i32)) {
        const STEPS: i32 = 10;
        let at = |step: i32| [x + dx * step / STEPS, y + dy * step / STEPS].map(|pixel| pixel.to_string());
        let [left, top] = at(0);
        self.xdotool(&["mousemove", &left, &top, "sleep", "0.3", "mousedown", "1", "sleep", "0.3"]);
        let moves: Vec<String> = (1..=STEPS)
            .flat_map(|step| {
                let [x, y] = at(step);
                ["mousemove".to_owned(), x, y, "sleep".to_owned(), "0.03".to_owned()]
            })
            .collect();
        self.xdotool(&moves.iter().map(String::as_str).collect::<Vec<_>>());
    }

    /// Releases the left button, after a frame has taken the last movement.
    pub(super) fn release(&self) {
        self.xdotool(&["sleep", "0.3", "mouseup", "1"]);
    }
}
