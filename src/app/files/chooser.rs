//! File dialogs of the desktop, on a thread of their own.

use crossbeam_channel::{Receiver, TryRecvError, bounded};
use egui::Context;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A dialog that is gone after so short a time was never shown: no hand is that fast. Where neither a desktop portal
/// nor `zenity` answers, rfd returns at once and in the same way as for "Cancel".
const NEVER_SHOWN: Duration = Duration::from_millis(350);
/// After this time the window offers a path field in place of a dialog that may be hanging or hidden.
const SLOW: Duration = Duration::from_millis(1500);

/// What a file is chosen for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    OpenScene,
    SaveScene,
    ExportPicture,
    ExportSurface,
    AddSurface,
    AddTexture,
}

/// What the dialog begins with.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Request {
    pub(crate) purpose: Purpose,
    /// The folder and the name to propose.
    pub(crate) proposal: PathBuf,
}

/// How a dialog ended.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Outcome {
    Chosen(PathBuf),
    Cancelled,
    /// This system shows no file dialogs.
    Unavailable,
}

/// What was chosen, and how long the dialog was open.
type Answer = (Option<PathBuf>, Duration);
type Dialog = Arc<dyn Fn(&Request) -> Option<PathBuf> + Send + Sync>;

/// At most one file dialog.
pub(crate) struct Chooser {
    dialog: Dialog,
    open: Option<(Request, Instant, Receiver<Answer>)>,
}

impl Default for Chooser {
    fn default() -> Self {
        Self::new(Arc::new(desktop_dialog))
    }
}

impl Purpose {
    /// The dialog's title.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::OpenScene => "Open scene",
            Self::SaveScene => "Save scene",
            Self::ExportPicture => "Export picture",
            Self::ExportSurface => "Export surface",
            Self::AddSurface => "Add patches",
            Self::AddTexture => "Add texture",
        }
    }

    /// What a file is for that was dropped onto the window: by its extension, and a scene where that says nothing.
    pub(crate) fn of_dropped(path: &Path) -> Self {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        let takes = |purpose: &Self| purpose.extensions().iter().any(|known| extension.as_deref() == Some(known));
        [Self::AddSurface, Self::AddTexture].into_iter().find(takes).unwrap_or(Self::OpenScene)
    }

    /// Whether the file will be written.
    pub(crate) fn writes(self) -> bool {
        matches!(self, Self::SaveScene | Self::ExportPicture | Self::ExportSurface)
    }

    /// The extensions it may have; the first is given to a name without one.
    pub(crate) fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::OpenScene | Self::SaveScene => &["toml"],
            Self::ExportPicture => &["png", "exr"],
            Self::ExportSurface => &["obj", "bpt"],
            Self::AddSurface => &["bpt"],
            Self::AddTexture => &["png", "jpg", "jpeg"],
        }
    }

    /// What the extensions mean.
    pub(crate) fn formats(self) -> &'static str {
        match self {
            Self::OpenScene | Self::SaveScene => ".toml, a scene",
            Self::ExportPicture => ".png, as the screen shows it, or .exr, linear 32-bit floats",
            Self::ExportSurface => ".obj, a mesh, or .bpt, the control points",
            Self::AddSurface => ".bpt, control points of bicubic patches",
            Self::AddTexture => ".png or .jpg, an image",
        }
    }
}

impl Chooser {
    /// With another way to choose; the test's, say.
    pub(crate) fn new(dialog: Dialog) -> Self {
        Self { dialog, open: None }
    }

    /// Opens a dialog and returns at once. Forgets one that is still open.
    pub(crate) fn start(&mut self, ctx: &Context, request: Request) {
        let (send, receive) = bounded(1);
        let (dialog, asked, ctx, start) = (Arc::clone(&self.dialog), request.clone(), ctx.clone(), Instant::now());
        let started = std::thread::Builder::new().name("file dialog".to_owned()).spawn(move || {
            // Nobody listens any more where the dialog was given up for the path field.
            send.try_send((dialog(&asked), start.elapsed())).ok();
            ctx.request_repaint();
        });
        // A thread that cannot start drops its sender, which poll reports as an unavailable dialog.
        drop(started);
        self.open = Some((request, start, receive));
    }

    /// The request of the open dialog.
    pub(crate) fn pending(&self) -> Option<&Request> {
        self.open.as_ref().map(|(request, ..)| request)
    }

    /// Whether the open dialog lets itself wait for, so that another way should be offered.
    pub(crate) fn is_slow(&self, ctx: &Context) -> bool {
        let Some((_, since, _)) = &self.open else { return false };
        let left = SLOW.saturating_sub(since.elapsed());
        if !left.is_zero() {
            ctx.request_repaint_after(left);
        }
        left.is_zero()
    }

    /// Forgets the open dialog, whatever it still says, and returns its request.
    pub(crate) fn give_up(&mut self) -> Option<Request> {
        self.open.take().map(|(request, ..)| request)
    }

    /// How the dialog ended, once.
    pub(crate) fn poll(&mut self) -> Option<(Request, Outcome)> {
        let (_, _, receive) = self.open.as_ref()?;
        let outcome = match receive.try_recv() {
            Ok((Some(path), _)) => Outcome::Chosen(path),
            Ok((None, open_for)) if open_for > NEVER_SHOWN => Outcome::Cancelled,
            Ok((None, _)) | Err(TryRecvError::Disconnected) => Outcome::Unavailable,
            Err(TryRecvError::Empty) => return None,
        };
        self.give_up().map(|request| (request, outcome))
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
