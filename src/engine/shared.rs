//! The state that the caller and the worker share.

use super::frame::Frame;
use super::messages::{Limits, Status};
use crate::scene::SceneFile;
use crate::transport::Component;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The caller's newest commands. The worker takes scenes and restarts; the other fields stay.
#[derive(Debug, Default)]
pub(super) struct Request {
    /// The newest scene and its generation, until the worker takes it.
    pub(super) scene: Option<(u64, Arc<SceneFile>)>,
    /// The generation under which to restart the present scene, until the worker takes it.
    pub(super) restart: Option<u64>,
    /// Whether to pause.
    pub(super) paused: bool,
    /// Estimated error at which to rest.
    pub(super) target: Option<f64>,
    /// Time and iterations after which to rest.
    pub(super) limits: Limits,
    /// Whether previews have less noise in their interreflection.
    pub(super) smooth: bool,
    /// The component of the light to render; `None` for all.
    pub(super) only: Option<Component>,
    /// Whether frames tell the noise of their pixels.
    pub(super) noise: bool,
    /// Whether to end the thread.
    pub(super) quit: bool,
}

/// The state that the caller and the worker share.
pub(super) struct Shared {
    /// Generation of the newest scene.
    pub(super) generation: AtomicU64,
    request: Mutex<Request>,
    newest: Mutex<Option<Arc<Frame>>>,
    status: Mutex<Status>,
    wake_caller: Box<dyn Fn() + Send + Sync>,
}

impl Shared {
    pub(super) fn new(wake_caller: impl Fn() + Send + Sync + 'static) -> Self {
        Self {
            generation: AtomicU64::new(0),
            request: Mutex::default(),
            newest: Mutex::default(),
            status: Mutex::new(Status::Idle),
            wake_caller: Box::new(wake_caller),
        }
    }

    /// The caller's newest commands, locked.
    pub(super) fn request(&self) -> MutexGuard<'_, Request> {
        lock(&self.request)
    }

    /// Whether a scene newer than this generation was sent.
    pub(super) fn is_outdated(&self, generation: u64) -> bool {
        self.generation.load(Ordering::Acquire) != generation
    }

    /// Makes this the newest frame, and wakes the caller.
    pub(super) fn publish(&self, frame: Frame) {
        *lock(&self.newest) = Some(Arc::new(frame));
        self.wake();
    }

    /// The newest frame; `None` if it was taken before, or none was published yet.
    pub(super) fn take_newest(&self) -> Option<Arc<Frame>> {
        lock(&self.newest).take()
    }

    pub(super) fn status(&self) -> Status {
        lock(&self.status).clone()
    }

    pub(super) fn set_status(&self, status: Status) {
        let mut current = lock(&self.status);
        if *current != status {
            *current = status;
            drop(current);
            self.wake();
        }
    }

    /// Wakes the caller. A panic of the caller's function is its own fault: it must not end the thread that renders, which would leave a
    /// status behind that never changes. The panic hook has told of it.
    fn wake(&self) {
        let _panicked = catch_unwind(AssertUnwindSafe(|| (self.wake_caller)()));
    }
}

/// Locks, even after a panic of another holder: every holder leaves whole values behind.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
