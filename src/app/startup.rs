//! From a scene's path to an open window, or to a message that says what is missing.

use super::window::Window;
use crate::engine::EngineError;
use crate::scene::{Location, SceneFile};
use egui::ViewportBuilder;
use std::any::Any;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The Debian packages of the libraries that a window is opened with; they are looked for when the program runs.
const PACKAGES: &str = "libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0 libgl1";

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The engine cannot start.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// Nothing shows windows here.
    #[error(
        "no window can be opened: there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set)\n\
         With a display elsewhere, log in with `ssh -X`; with none, `apt install xvfb` and `xvfb-run patchlight` try the window out.\n\
         {render}"
    )]
    NoDisplay {
        /// What works without a window.
        render: String,
    },
    /// There is a display, but no window on it.
    #[error(
        "no window can be opened: {reason}\nDISPLAY or WAYLAND_DISPLAY has to name a display that answers; \
         on Debian this installs the libraries that it takes: apt install {PACKAGES}\n{render}"
    )]
    NoWindow {
        /// What the window system says.
        reason: String,
        /// What works without a window.
        render: String,
    },
}

/// Opens the window on a scene, and returns when it is closed.
pub fn run(scene: SceneFile) -> Result<(), AppError> {
    let render = render_line(&scene.location);
    if !has_display() {
        return Err(AppError::NoDisplay { render });
    }
    open_window(scene, &render)
}

/// The command that makes the picture without a window.
fn render_line(scene: &Location) -> String {
    format!("Without a window this works at once: patchlight render {} -o picture.png --seconds 10", scene.argument())
}

fn has_display() -> bool {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(not(all(unix, not(target_os = "macos"))))
        || ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"].into_iter().any(set)
}

fn open_window(file: SceneFile, render: &str) -> Result<(), AppError> {
    let shown = Arc::new(AtomicBool::new(false));
    let created = Arc::clone(&shown);
    let options = eframe::NativeOptions {
        viewport: ViewportBuilder::default()
            .with_title("patchlight")
            .with_app_id("patchlight")
            .with_inner_size([1280.0, 800.0])
            .with_min_inner_size([640.0, 400.0])
            .with_drag_and_drop(true),
        ..Default::default()
    };
    let run = move || {
        eframe::run_native(
            "patchlight",
            options,
            Box::new(move |creation| {
                let window = Window::new(creation, file)?;
                created.store(true, Ordering::Relaxed);
                Ok(Box::new(window))
            }),
        )
    };
    quietly_until(&shown, run, |reason| AppError::NoWindow { reason, render: render.to_owned() })
}

/// Runs `run`. Libraries of the window system that are missing make its crates panic: until `shown` is set a panic is
/// an error like any other and prints nothing of its own; after that it is a bug and goes on.
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

/// The engine's own error, if that is what kept the window from opening.
fn engine_error(error: eframe::Error) -> Result<AppError, eframe::Error> {
    match error {
        eframe::Error::AppCreation(source) => match source.downcast::<EngineError>() {
            Ok(error) => Ok(AppError::Engine(*error)),
            Err(source) => Err(eframe::Error::AppCreation(source)),
        },
        other => Err(other),
    }
}

/// The reason without the line of a library's source that some of them put before it.
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
    fn a_panic_of_the_window_system_is_a_message() {
        let message = failed(|| panic!("Library libxkbcommon-x11.so could not be loaded."));
        assert!(message.contains("libxkbcommon-x11.so could not be loaded"), "the reason: {message}");
        assert!(message.contains("apt install") && message.contains("libxkbcommon-x11-0"), "the package: {message}");
        assert!(message.contains("patchlight render"), "what works at once: {message}");
    }

    #[test]
    fn a_reason_names_no_source_file() {
        let reason = "winit EventLoopError: os error at /a/b-0.3/src/mod.rs:788: Failed to open connection to X server";
        assert_eq!(plain(reason), "Failed to open connection to X server");
        assert_eq!(plain("no config: all were tried"), "no config: all were tried");
    }

    #[test]
    fn the_line_that_works_names_the_scene() {
        let line = render_line(&Location::Disk("a b/c.toml".into()));
        assert!(line.contains("patchlight render 'a b/c.toml' -o"), "{line}");
        assert!(
            render_line(&Location::BuiltIn("water".to_owned())).contains("patchlight render water -o"),
            "by its name"
        );
    }
}
