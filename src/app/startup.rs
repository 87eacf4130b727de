//! Opens the window on a scene, or explains why no window can open.

use super::keeping::{Folders, LoadedPreferences, WindowPlace};
use super::window::Window;
use crate::engine::EngineError;
use crate::scene::{Location, SceneFile};
use eframe::App;
use egui::{IconData, ViewportBuilder};
use std::any::Any;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The Debian packages of the libraries that a window loads at run time.
const PACKAGES: &str = "libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0 libgl1";

/// The size of a new window, points.
const SIZE: [f32; 2] = [1280.0, 800.0];

/// The reason why no window can open.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The engine cannot start.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// No display is set.
    #[error(
        "no window can be opened: neither DISPLAY nor WAYLAND_DISPLAY is set\n\
         For a display on another machine, log in with `ssh -X`. Without any display, `apt install xvfb`, then run `xvfb-run patchlight`.\n\
         {render}"
    )]
    NoDisplay {
        /// The command line that renders without a window.
        render: String,
    },
    /// The display does not open a window.
    #[error(
        "no window can be opened: {reason}\nDISPLAY or WAYLAND_DISPLAY must name a running display. \
         On Debian, install the libraries of a window: apt install {PACKAGES}\n{render}"
    )]
    NoWindow {
        /// The window system's message.
        reason: String,
        /// The command line that renders without a window.
        render: String,
    },
}

/// Opens the window on a scene. Returns when the user closes the window.
///
/// # Errors
/// Returns an error when no window can open, or the engine cannot start.
pub fn run(scene: SceneFile) -> Result<(), AppError> {
    let kept = Folders::of_user().map(|folders| {
        let loaded = LoadedPreferences::read(&folders.preferences());
        (folders, loaded)
    });
    let place = kept.as_ref().and_then(|(_, loaded)| loaded.preferences.window);
    open_window(scene, placed(place), kept, |window| Box::new(window))
}

/// A sentence with the command line that renders the scene without a window.
fn render_line(scene: &Location) -> String {
    format!("To render without a window: patchlight render {} -o picture.png --seconds 10", scene.argument())
}

fn has_display() -> bool {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(not(all(unix, not(target_os = "macos"))))
        || ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"].into_iter().any(set)
}

/// Opens a window at this place on a scene, with the application that `app` makes of the window. Without `kept`, the window neither reads nor
/// writes the user's folders.
///
/// # Errors
/// Returns an error when no window can open, or the engine cannot start.
pub(crate) fn open_window(
    file: SceneFile,
    viewport: ViewportBuilder,
    kept: Option<(Folders, LoadedPreferences)>,
    app: impl FnOnce(Window) -> Box<dyn App> + 'static,
) -> Result<(), AppError> {
    let render = render_line(&file.location);
    if !has_display() {
        return Err(AppError::NoDisplay { render });
    }
    let shown = Arc::new(AtomicBool::new(false));
    let created = Arc::clone(&shown);
    let viewport = viewport
        .with_title("patchlight")
        .with_app_id("patchlight")
        .with_icon(icon())
        .with_min_inner_size([640.0, 400.0])
        .with_drag_and_drop(true);
    let options = eframe::NativeOptions { viewport, ..Default::default() };
    let run = move || {
        eframe::run_native(
            "patchlight",
            options,
            Box::new(move |creation| {
                let window = Window::new(creation, file, kept)?;
                created.store(true, Ordering::Relaxed);
                Ok(app(window))
            }),
        )
    };
    quietly_until(&shown, run, |reason| AppError::NoWindow { reason, render: render.clone() })
}

/// The program's icon, for the title bar and lists of windows.
fn icon() -> IconData {
    // Without an icon the window is as useful.
    eframe::icon_data::from_png_bytes(include_bytes!("../../assets/linux/patchlight.png")).unwrap_or_default()
}

/// A window at the place of the window before; `None` leaves the place to the desktop.
fn placed(place: Option<WindowPlace>) -> ViewportBuilder {
    let Some(place) = place else { return ViewportBuilder::default().with_inner_size(SIZE) };
    let window =
        ViewportBuilder::default().with_inner_size([place.width, place.height]).with_maximized(place.maximized);
    match place.corner {
        Some(corner) => window.with_position(corner),
        None => window,
    }
}

/// Runs `run`. The window system's crates panic when a library is missing, so a panic before `shown` is set becomes an
/// error without output. A later panic is a bug and unwinds.
fn quietly_until(
    shown: &Arc<AtomicBool>,
    run: impl FnOnce() -> Result<(), eframe::Error>,
    fail: impl Fn(String) -> AppError,
) -> Result<(), AppError> {
    let usual: Arc<dyn Fn(&panic::PanicHookInfo<'_>) + Send + Sync> = Arc::from(panic::take_hook());
    let (quiet, after) = (Arc::clone(shown), Arc::clone(&usual));
    panic::set_hook(Box::new(move |info| {
        if quiet.load(Ordering::Relaxed) {
            after(info);
        }
    }));
    let outcome = panic::catch_unwind(AssertUnwindSafe(run));
    panic::set_hook(Box::new(move |info| usual(info)));
    match outcome {
        Ok(result) => {
            result.map_err(|error| engine_error(error).unwrap_or_else(|error| fail(plain(&error.to_string()))))
        }
        Err(payload) if shown.load(Ordering::Relaxed) => panic::resume_unwind(payload),
        Err(payload) => Err(fail(plain(&panic_text(payload.as_ref())))),
    }
}

/// The engine's error, if the engine kept the window from opening.
///
/// # Errors
/// Returns any other error unchanged.
fn engine_error(error: eframe::Error) -> Result<AppError, eframe::Error> {
    match error {
        eframe::Error::AppCreation(source) => match source.downcast::<EngineError>() {
            Ok(error) => Ok(AppError::Engine(*error)),
            Err(source) => Err(eframe::Error::AppCreation(source)),
        },
        other => Err(other),
    }
}

/// The reason without the source file and line that some libraries put before it.
fn plain(reason: &str) -> String {
    let after_line = reason.rsplit_once(".rs:").and_then(|(_, rest)| rest.split_once(": "));
    let sentence = after_line.filter(|(line, _)| line.bytes().all(|byte| byte.is_ascii_digit() || byte == b':'));
    sentence.map_or(reason, |(_, sentence)| sentence).to_owned()
}

fn panic_text(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_else(|| "the window system failed".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn failed(run: impl FnOnce() -> Result<(), eframe::Error>) -> String {
        let shown = Arc::new(AtomicBool::new(false));
        let fail = |reason| AppError::NoWindow { reason, render: render_line(&Location::BuiltIn("report".to_owned())) };
        quietly_until(&shown, run, fail).unwrap_err().to_string()
    }

    #[test]
    fn a_panic_of_the_window_system_becomes_a_message() {
        let message = failed(|| panic!("Library libxkbcommon-x11.so could not be loaded."));
        assert!(message.contains("libxkbcommon-x11.so could not be loaded"), "the reason: {message}");
        assert!(message.contains("apt install") && message.contains("libxkbcommon-x11-0"), "the package: {message}");
        assert!(message.contains("patchlight render"), "the command without a window: {message}");
    }

    #[test]
    fn a_reason_names_no_source_file() {
        let reason = "winit EventLoopError: os error at /a/b-0.3/src/mod.rs:788: Failed to open connection to X server";
        assert_eq!(plain(reason), "Failed to open connection to X server");
        assert_eq!(plain("no config: all were tried"), "no config: all were tried");
    }

    #[test]
    fn the_render_command_names_the_scene() {
        let line = render_line(&Location::Disk("a b/c.toml".into()));
        assert!(line.contains("patchlight render 'a b/c.toml' -o"), "{line}");
        assert!(
            render_line(&Location::BuiltIn("water".to_owned())).contains("patchlight render water -o"),
            "by its built-in name"
        );
    }
}
