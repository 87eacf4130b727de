use super::frame::Frame;
use super::worker::Status;
use crate::scene::SceneFile;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// What the caller wants next; the newest scene replaces one that was not begun.
#[derive(Debug, Default)]
pub(super) struct Wanted {
    pub(super) scene: Option<(u64, Arc<SceneFile>)>,
    /// Begin the present scene again, under this generation.
    pub(super) restart: Option<u64>,
    pub(super) paused: bool,
    /// Of the error estimate, below which there is nothing left to do.
    pub(super) target: Option<f64>,
    pub(super) quit: bool,
}

/// What both sides of the engine touch.
pub(super) struct Shared {
    pub(super) generation: AtomicU64,
    wanted: Mutex<Wanted>,
    newest: Mutex<Option<Arc<Frame>>>,
    status: Mutex<Status>,
    wake_caller: Box<dyn Fn() + Send + Sync>,
}

impl Shared {
    pub(super) fn new(wake_caller: impl Fn() + Send + Sync + 'static) -> Self {
        Self {
            generation: AtomicU64::new(0),
            wanted: Mutex::default(),
            newest: Mutex::default(),
            status: Mutex::new(Status::Idle),
            wake_caller: Box::new(wake_caller),
        }
    }

    pub(super) fn wanted(&self) -> MutexGuard<'_, Wanted> {
        lock(&self.wanted)
    }

    /// Whether a scene newer than this was sent.
    pub(super) fn is_outdated(&self, generation: u64) -> bool {
        self.generation.load(Ordering::Acquire) != generation
    }

    pub(super) fn publish(&self, frame: Frame) {
        *lock(&self.newest) = Some(Arc::new(frame));
        (self.wake_caller)();
    }

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
            (self.wake_caller)();
        }
    }
}

/// The lock, also after a panic elsewhere: each holder leaves whole values behind.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
