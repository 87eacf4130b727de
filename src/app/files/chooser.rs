//! The desktop's file dialogs, on a thread of their own.

use crate::app::commands::Purpose;
use crossbeam_channel::{Receiver, TryRecvError, bounded};
use egui::Context;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A dialog that ends within this time was never shown, because no user is that fast. Without a desktop portal and
/// without `zenity`, rfd returns at once, with the value of "Cancel".
const NEVER_SHOWN: Duration = Duration::from_millis(350);
/// After this time the window offers a path field, because the dialog may hang or be hidden.
const SLOW: Duration = Duration::from_millis(1500);

/// A request for a path.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Request {
    pub(crate) purpose: Purpose,
    /// The proposed path: a folder, with a name for a file to write.
    pub(crate) proposal: PathBuf,
}

/// The result of a file dialog.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Outcome {
    Chosen(PathBuf),
    Cancelled,
    /// This desktop shows no file dialogs.
    Unavailable,
}

/// The chosen path, and the time that the dialog was open.
type Reply = (Option<PathBuf>, Duration);
type Dialog = Arc<dyn Fn(&Request) -> Option<PathBuf> + Send + Sync>;

/// The file dialog that is open, if any.
pub(crate) struct Chooser {
    dialog: Dialog,
    open: Option<(Request, Instant, Receiver<Reply>)>,
}

impl Default for Chooser {
    fn default() -> Self {
        Self::new(Arc::new(desktop_dialog))
    }
}

impl Chooser {
    /// A chooser that calls `dialog` for a path; tests pass a function that returns at once.
    pub(crate) fn new(dialog: Dialog) -> Self {
        Self { dialog, open: None }
    }

    /// Opens a dialog on its own thread and returns at once. Dismisses a dialog that is still open.
    pub(crate) fn start(&mut self, ctx: &Context, request: Request) {
        let (send, receive) = bounded(1);
        let (dialog, asked, ctx, start) = (Arc::clone(&self.dialog), request.clone(), ctx.clone(), Instant::now());
        let started = std::thread::Builder::new().name("file dialog".to_owned()).spawn(move || {
            // The receiver is gone if the user dismissed the dialog for the path field.
            send.try_send((dialog(&asked), start.elapsed())).ok();
            ctx.request_repaint();
        });
        // A thread that cannot start drops its sender; `poll` reports that as an unavailable dialog.
        drop(started);
        self.open = Some((request, start, receive));
    }

    /// The request of the open dialog; `None` while none is open.
    pub(crate) fn pending(&self) -> Option<&Request> {
        self.open.as_ref().map(|(request, ..)| request)
    }

    /// Whether the open dialog takes so long that the window should offer a path field. Schedules a repaint for that time.
    pub(crate) fn is_slow(&self, ctx: &Context) -> bool {
        let Some((_, since, _)) = &self.open else { return false };
        let left = SLOW.saturating_sub(since.elapsed());
        if !left.is_zero() {
            ctx.request_repaint_after(left);
        }
        left.is_zero()
    }

    /// Dismisses the open dialog and ignores its result. Returns its request; `None` without an open dialog.
    pub(crate) fn dismiss(&mut self) -> Option<Request> {
        self.open.take().map(|(request, ..)| request)
    }

    /// The request and the result of a dialog that has ended since the last call; `None` while the dialog is open, and without a dialog.
    pub(crate) fn poll(&mut self) -> Option<(Request, Outcome)> {
        let (_, _, receive) = self.open.as_ref()?;
        let outcome = match receive.try_recv() {
            Ok((Some(path), _)) => Outcome::Chosen(path),
            Ok((None, open_for)) if open_for > NEVER_SHOWN => Outcome::Cancelled,
            Ok((None, _)) | Err(TryRecvError::Disconnected) => Outcome::Unavailable,
            Err(TryRecvError::Empty) => return None,
        };
        self.dismiss().map(|request| (request, outcome))
    }
}

fn desktop_dialog(request: &Request) -> Option<PathBuf> {
    let mut dialog = rfd::FileDialog::new().set_title(request.purpose.title());
    if request.purpose.writes() {
        for extension in request.purpose.extensions() {
            dialog = dialog.add_filter(extension.to_uppercase(), &[extension]);
        }
    } else {
        dialog = dialog.add_filter(request.purpose.extensions().join(", "), request.purpose.extensions());
    }
    if let Some(folder) = request.proposal.parent().filter(|folder| folder.is_dir()) {
        dialog = dialog.set_directory(folder);
    }
    if !request.purpose.writes() {
        return dialog.pick_file();
    }
    if let Some(name) = request.proposal.file_name() {
        dialog = dialog.set_file_name(name.to_string_lossy());
    }
    dialog.save_file()
}
