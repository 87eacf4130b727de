//! The engine as the caller sees it.

use super::frame::Frame;
use super::messages::{Command, EngineError, EngineSettings, Status};
use super::shared::Shared;
use super::worker::Worker;
use crossbeam_channel::{Sender, bounded};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread::JoinHandle;

/// A worker thread that renders the newest scene it was given. Dropping the engine joins the thread.
pub struct Engine {
    shared: Arc<Shared>,
    wake_worker: Sender<()>,
    thread: Option<JoinHandle<()>>,
}

impl Engine {
    /// Starts an engine without a scene. It calls `wake`, on its own thread, for each new frame or status.
    ///
    /// # Errors
    ///
    /// When the operating system denies the threads.
    pub fn start(settings: EngineSettings, wake: impl Fn() + Send + Sync + 'static) -> Result<Self, EngineError> {
        let pool = thread_pool(settings.threads)?;
        let shared = Arc::new(Shared::new(wake));
        let (wake_worker, woken) = bounded(1);
        let worker = Worker::new(shared.clone(), woken, pool, settings.seed);
        let thread = std::thread::Builder::new().name("engine".to_owned()).spawn(move || worker.run())?;
        Ok(Self { shared, wake_worker, thread: Some(thread) })
    }

    /// Sends a command; returns at once.
    pub fn send(&self, command: Command) {
        let mut request = self.shared.request();
        match command {
            Command::Show(scene) => {
                let generation = self.shared.generation.fetch_add(1, Ordering::AcqRel) + 1;
                request.scene = Some((generation, scene));
            }
            Command::Restart => {
                let generation = self.shared.generation.fetch_add(1, Ordering::AcqRel) + 1;
                request.restart = Some(generation);
            }
            Command::Pause => request.paused = true,
            Command::Resume => request.paused = false,
            Command::Target(target) => request.target = target,
        }
        drop(request);
        self.wake();
    }

    /// The generation of the newest scene; each frame carries the generation of its scene.
    pub fn generation(&self) -> u64 {
        self.shared.generation.load(Ordering::Acquire)
    }

    /// Takes the newest frame; `None` if it was taken before, or before the first frame.
    pub fn newest_frame(&self) -> Option<Arc<Frame>> {
        self.shared.take_newest()
    }

    /// The present state of the engine.
    pub fn status(&self) -> Status {
        self.shared.status()
    }

    fn wake(&self) {
        // A full channel already holds a call to wake up; a closed one has no worker to wake.
        let _sent = self.wake_worker.try_send(());
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        self.shared.request().quit = true;
        self.shared.generation.fetch_add(1, Ordering::AcqRel);
        self.wake();
        if let Some(thread) = self.thread.take() {
            let _panicked = thread.join();
        }
    }
}

/// A pool of named threads; `None` for one thread per processor.
///
/// # Errors
///
/// When the operating system denies the threads.
pub(super) fn thread_pool(threads: Option<usize>) -> Result<rayon::ThreadPool, rayon::ThreadPoolBuildError> {
    let builder = rayon::ThreadPoolBuilder::new().thread_name(|k| format!("render-{k}"));
    builder.num_threads(threads.unwrap_or(0)).build()
}
