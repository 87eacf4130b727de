//! The engine as the caller sees it.

use super::frame::Frame;
use super::messages::{Command, EngineError, EngineSettings, Status};
use super::shared::Shared;
use super::worker::Worker;
use crossbeam_channel::{Receiver, Sender, bounded};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Longest time that dropping an engine waits for the worker thread. To prepare a large film takes seconds and cannot be cancelled; whoever
/// leaves the program does not wait for it.
const LONGEST_WAIT: Duration = Duration::from_millis(200);

/// A worker thread that renders the newest scene it was given. Dropping the engine ends the thread: at once, or soon after if the thread is
/// in the middle of a step that cannot be cancelled.
pub struct Engine {
    shared: Arc<Shared>,
    wake_worker: Sender<()>,
    /// Closed when the worker thread has ended.
    ended: Receiver<()>,
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
        let (running, ended) = bounded(0);
        let run = move || {
            worker.run();
            drop(running);
        };
        std::thread::Builder::new().name("engine".to_owned()).spawn(run)?;
        Ok(Self { shared, wake_worker, ended })
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
            Command::Only(only) => {
                let generation = self.shared.generation.fetch_add(1, Ordering::AcqRel) + 1;
                (request.restart, request.only) = (Some(generation), only);
            }
            Command::Noise(noise) => request.noise = noise,
            Command::Pause => request.paused = true,
            Command::Resume => request.paused = false,
            Command::Target(target) => request.target = target,
            Command::Limits(limits) => request.limits = limits,
            Command::Smooth(smooth) => request.smooth = smooth,
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
        let _ended = self.ended.recv_timeout(LONGEST_WAIT);
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
