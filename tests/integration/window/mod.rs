//! The real window on a display of its own: a mouse and a keyboard work in it, and its files and screenshots tell what they did.
//!
//! The tests take the Debian packages xvfb, xdotool, imagemagick and the libraries of a window; where a package is missing they
//! fail and name it.
//!
//! | file | holds |
//! |---|---|
//! | `desktop` | a display without a monitor, and its mouse and keyboard |
//! | `picture` | screenshots |
//! | `session` | the driver: a scene in a window, where its points are on the screen, and what the window saves |
//! | `messages` | messages of a desktop to a window, which no mouse can send |
//! | `convergence` | the picture follows a drag and converges again |
//! | `navigation` | drags that move the camera |
//! | `drags` | drags that move control points |
//! | `seams` | patches that stay together |
//! | `closing` | the question about unsaved changes |
//! | `recovery` | unsaved changes of a killed window |
//! | `file_dialogs` | the desktop's file dialogs, by a stand-in for `zenity` |
//! | `drops` | files that are dragged onto the window |
//! | `random_input` | anything that a hand can do |
//! | `startup` | no display, and a display that does not answer |

mod closing;
mod convergence;
mod desktop;
mod drags;
mod drops;
mod file_dialogs;
mod messages;
mod navigation;
mod picture;
mod random_input;
mod recovery;
mod seams;
mod session;
mod startup;

use std::time::{Duration, Instant};

const PROGRAM: &str = env!("CARGO_BIN_EXE_patchlight");
/// Timeout of a wait, for a loaded machine; an idle machine needs a few seconds.
const PATIENCE: Duration = Duration::from_secs(120);

/// Looks until there is a result.
fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(start.elapsed() < PATIENCE, "there is no {what} after {PATIENCE:?}");
        std::thread::sleep(Duration::from_millis(100));
    }
}
