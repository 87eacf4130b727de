use super::frame::Frame;
use super::session::{Session, SessionError};
use super::shared::Shared;
use crate::scene::SceneFile;
use crate::transport::Cancel;
use crossbeam_channel::{Receiver, Sender, bounded};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use thiserror::Error;

/// How the engine works.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EngineSettings {
    /// Threads of the pool; `None`: one for each processor.
    pub threads: Option<usize>,
    /// Of all random numbers.
    pub seed: u64,
}

/// What the engine is asked to do.
#[derive(Clone, Debug)]
pub enum Command {
    /// Render this scene from now on.
    Show(Arc<SceneFile>),
    /// Stop after the present iteration.
    Pause,
    /// Go on.
    Resume,
    /// Begin the present scene again.
    Restart,
    /// Rest once the error estimate is no more than this; `None`: go on for ever.
    Target(Option<f64>),
}

/// What the engine does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// Nothing: there is no scene.
    Idle,
    /// Builds trees, reads textures, makes the plan.
    Preparing,
    /// Renders iterations.
    Rendering,
    /// Waits to go on.
    Paused,
    /// Rests: the error estimate is no more than what was asked for.
    Converged,
    /// The scene can't be rendered, for this reason; another one may.
    Failed(String),
}

/// Why there is no engine.
#[derive(Debug, Error)]
pub enum EngineError {
    /// The operating system gave no threads.
    #[error("no threads to render with: {0}")]
    Pool(#[from] rayon::ThreadPoolBuildError),
    /// The operating system gave no thread.
    #[error("no thread to render on: {0}")]
    Thread(#[from] std::io::Error),
}

/// A worker thread that renders the newest scene it was given. Dropping it waits for the thread to end.
pub struct Engine {
    shared: Arc<Shared>,
    wake_worker: Sender<()>,
    thread: Option<JoinHandle<()>>,
}

/// Time that a draft should take: a frame of 30 Hz, less preparation and display.
const DRAFT_SECONDS: f64 = 0.022;
const COARSEST_DRAFT: f64 = 16.0;
/// No finer draft takes longer, but for the last one, which has all pixels and so is the first whole picture.
const LONGEST_DRAFT_SECONDS: f64 = 0.12;
/// If a draft with all pixels takes longer, a coarser one comes before it.
const LONGEST_WAIT: f64 = 0.5;
/// Frames of a converging picture come this far apart at least.
const FRAME_INTERVAL: Duration = Duration::from_millis(60);

impl Engine {
    /// An engine without a scene. `wake` is called, on the engine's thread, when there is a new frame or status.
    pub fn start(settings: EngineSettings, wake: impl Fn() + Send + Sync + 'static) -> Result<Self, EngineError> {
        let pool = thread_pool(settings.threads)?;
        let shared = Arc::new(Shared::new(wake));
        let (wake_worker, woken) = bounded(1);
        let worker = Worker {
            shared: shared.clone(),
            woken,
            pool,
            seed: settings.seed,
            current: None,
            session: None,
            coarseness: 4.0,
            next_draft: 0,
            last_frame: None,
        };
        let thread = std::thread::Builder::new().name("engine".to_owned()).spawn(move || worker.run())?;
        Ok(Self { shared, wake_worker, thread: Some(thread) })
    }

    /// Tells the engine what to do; returns at once.
    pub fn send(&self, command: Command) {
        let mut wanted = self.shared.wanted();
        match command {
            Command::Show(scene) => {
                let generation = self.shared.generation.fetch_add(1, Ordering::AcqRel) + 1;
                wanted.scene = Some((generation, scene));
            }
            Command::Restart => {
                let generation = self.shared.generation.fetch_add(1, Ordering::AcqRel) + 1;
                wanted.restart = Some(generation);
            }
            Command::Pause => wanted.paused = true,
            Command::Resume => wanted.paused = false,
            Command::Target(target) => wanted.target = target,
        }
        drop(wanted);
        self.wake();
    }

    /// The number of the newest scene; frames carry the number of theirs.
    pub fn generation(&self) -> u64 {
        self.shared.generation.load(Ordering::Acquire)
    }

    /// The newest frame that was not taken yet.
    pub fn newest_frame(&self) -> Option<Arc<Frame>> {
        self.shared.take_newest()
    }

    /// What the engine does.
    pub fn status(&self) -> Status {
        self.shared.status()
    }

    fn wake(&self) {
        // A full channel already holds a call to wake up; a closed one has nobody to wake.
        let _sent = self.wake_worker.try_send(());
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        self.shared.wanted().quit = true;
        self.shared.generation.fetch_add(1, Ordering::AcqRel);
        self.wake();
        if let Some(thread) = self.thread.take() {
            let _panicked = thread.join();
        }
    }
}

/// A pool of named threads.
pub(super) fn thread_pool(threads: Option<usize>) -> Result<rayon::ThreadPool, rayon::ThreadPoolBuildError> {
    let builder = rayon::ThreadPoolBuilder::new().thread_name(|k| format!("render-{k}"));
    builder.num_threads(threads.unwrap_or(0)).build()
}

struct Worker {
    shared: Arc<Shared>,
    woken: Receiver<()>,
    pool: rayon::ThreadPool,
    seed: u64,
    current: Option<(u64, Arc<SceneFile>)>,
    session: Option<Session>,
    /// Of the next first draft, from how long the last one took.
    coarseness: f64,
    /// Of the next draft of the present scene; 0 when iterations are due.
    next_draft: u32,
    last_frame: Option<Instant>,
}

/// What the caller wants all along.
struct Wishes {
    quit: bool,
    paused: bool,
    target: Option<f64>,
}

impl Worker {
    fn run(mut self) {
        loop {
            let Wishes { quit, paused, target } = self.take_wanted();
            if quit {
                return;
            }
            let rest = match &self.session {
                // An edit while paused still gets one whole iteration: a coarse draft would stay otherwise.
                Some(session) if session.iterations() > 0 && paused => Some(Status::Paused),
                Some(session) if target.is_some_and(|error| session.reaches(error)) => Some(Status::Converged),
                Some(_) => None,
                // Idle or failed, as it is.
                None => Some(self.shared.status()),
            };
            if let Some(status) = rest {
                // Once: a call to wake up may be left from before.
                if self.shared.status() != status {
                    self.publish_if(|iterations| iterations > 0);
                    self.shared.set_status(status);
                }
                // An error means that the engine is gone; `quit` is set then.
                let _woken = self.woken.recv();
                continue;
            }
            self.shared.set_status(Status::Rendering);
            self.guarded(Self::advance);
        }
    }

    /// Takes over what the caller wants.
    fn take_wanted(&mut self) -> Wishes {
        let mut wanted = self.shared.wanted();
        let wishes = Wishes { quit: wanted.quit, paused: wanted.paused, target: wanted.target };
        let restart = wanted.restart.take();
        let scene = wanted.scene.take();
        drop(wanted);
        let next = match (scene, restart, &self.current) {
            (Some((generation, scene)), restart, _) => Some((restart.unwrap_or(0).max(generation), scene)),
            (None, Some(generation), Some((_, scene))) => Some((generation, scene.clone())),
            _ => None,
        };
        if let (Some(next), false) = (next, wishes.quit) {
            self.current = Some(next);
            self.guarded(Self::begin);
        }
        wishes
    }

    /// Prepares the current scene and shows a draft of it.
    fn begin(&mut self) -> Result<(), SessionError> {
        let Some((generation, scene)) = self.current.clone() else { return Ok(()) };
        if self.session.is_none() {
            self.shared.set_status(Status::Preparing);
        }
        let previous = self.session.take();
        let session = self.pool.install(|| Session::prepare(&scene, self.seed, previous.as_ref()))?;
        let start = Instant::now();
        let coarseness = self.coarseness.round().max(1.0);
        // Never cancelled: else a fast drag would show nothing.
        let draft = self.pool.install(|| session.draft(generation, coarseness as u32, Cancel::NEVER));
        // Time goes with the number of pixels, the square of the coarseness; half a step at a time, for calm.
        let seconds = start.elapsed().as_secs_f64();
        let wanted = coarseness * (seconds / DRAFT_SECONDS).sqrt();
        self.coarseness = (0.5 * (self.coarseness + wanted)).clamp(1.0, COARSEST_DRAFT);
        self.next_draft = finer(coarseness as u32, seconds);
        draft.into_iter().for_each(|draft| self.shared.publish(draft));
        self.session = Some(session);
        self.last_frame = None;
        Ok(())
    }

    fn advance(&mut self) -> Result<(), SessionError> {
        let (Some((generation, _)), Some(session)) = (&self.current, &mut self.session) else { return Ok(()) };
        let (generation, shared) = (*generation, &self.shared);
        let outdated = move || shared.is_outdated(generation);
        if self.next_draft > 0 {
            // Finer drafts bridge the time that the first iteration takes.
            let start = Instant::now();
            let draft = self.pool.install(|| session.draft(generation, self.next_draft, Cancel::when(&outdated)));
            self.next_draft = finer(self.next_draft, start.elapsed().as_secs_f64());
            draft.into_iter().for_each(|draft| self.shared.publish(draft));
            return Ok(());
        }
        let advanced = self.pool.install(|| session.advance(Cancel::when(&outdated)));
        if advanced.is_some() && self.last_frame.is_none_or(|at| at.elapsed() >= FRAME_INTERVAL) {
            self.publish_if(|_| true);
        }
        Ok(())
    }

    fn publish_if(&mut self, wanted: impl Fn(u64) -> bool) {
        if let (Some((generation, _)), Some(session)) = (&self.current, &self.session)
            && wanted(session.iterations())
        {
            self.shared.publish(session.frame(*generation));
            self.last_frame = Some(Instant::now());
        }
    }

    /// Runs a step; an error or a panic in it becomes a status, and the engine waits for another scene.
    fn guarded(&mut self, step: fn(&mut Self) -> Result<(), SessionError>) {
        let failure = match catch_unwind(AssertUnwindSafe(|| step(self))) {
            Ok(Ok(())) => return,
            Ok(Err(error)) => error.to_string(),
            Err(panic) => format!("rendering stopped by a fault in the program: {}", panic_message(&*panic)),
        };
        self.session = None;
        self.shared.set_status(Status::Failed(failure));
    }
}

/// How coarse the draft after one is that took so long; 0 where there should be none.
fn finer(coarseness: u32, seconds: f64) -> u32 {
    // Time goes with the number of pixels; but in fine drafts fewer of them gather light apart.
    let whole = 0.3 * seconds * f64::from(coarseness).powi(2);
    match coarseness {
        0 | 1 => 0,
        // One that is twice as fine has four times the pixels.
        _ if whole > LONGEST_WAIT && 4.0 * seconds <= LONGEST_DRAFT_SECONDS => coarseness / 2,
        _ => 1,
    }
}

fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "unknown".to_owned())
}
