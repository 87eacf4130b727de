//! The worker thread: prepares the newest scene, drafts it, and renders iterations until a newer scene arrives.

use super::draft_pace::DraftPace;
use super::messages::Status;
use super::session::{Session, SessionError};
use super::shared::Shared;
use crate::scene::SceneFile;
use crate::transport::Cancel;
use crossbeam_channel::Receiver;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Least time between frames of a converging picture.
const FRAME_INTERVAL: Duration = Duration::from_millis(60);

/// The state of the worker thread.
pub(super) struct Worker {
    shared: Arc<Shared>,
    woken: Receiver<()>,
    pool: rayon::ThreadPool,
    seed: u64,
    /// The present scene and its generation.
    current: Option<(u64, Arc<SceneFile>)>,
    session: Option<Session>,
    drafts: DraftPace,
    last_frame: Option<Instant>,
}

/// The caller's present wishes, besides scenes.
struct Demands {
    quit: bool,
    paused: bool,
    target: Option<f64>,
}

impl Worker {
    /// A worker without a scene.
    pub(super) fn new(shared: Arc<Shared>, woken: Receiver<()>, pool: rayon::ThreadPool, seed: u64) -> Self {
        Self { shared, woken, pool, seed, current: None, session: None, drafts: DraftPace::default(), last_frame: None }
    }

    /// Works until the engine is dropped.
    pub(super) fn run(mut self) {
        loop {
            let Demands { quit, paused, target } = self.take_demands();
            if quit {
                return;
            }
            let rest = match &self.session {
                // An edit while paused still renders one iteration: otherwise a coarse draft would stay.
                Some(session) if session.iterations() > 0 && paused => Some(Status::Paused),
                Some(session) if target.is_some_and(|error| session.reaches(error)) => Some(Status::Converged),
                Some(_) => None,
                // Idle or failed.
                None => Some(self.shared.status()),
            };
            if let Some(status) = rest {
                // Published once: an earlier call to wake up may still be in the channel.
                if self.shared.status() != status {
                    self.publish_if(|iterations| iterations > 0);
                    self.shared.set_status(status);
                }
                // An error means that the engine was dropped, which set `quit`.
                let _woken = self.woken.recv();
                continue;
            }
            self.shared.set_status(Status::Rendering);
            self.guarded(Self::advance);
        }
    }

    /// Takes the newest demands, and begins the newest scene.
    fn take_demands(&mut self) -> Demands {
        let mut request = self.shared.request();
        let demands = Demands { quit: request.quit, paused: request.paused, target: request.target };
        let restart = request.restart.take();
        let scene = request.scene.take();
        drop(request);
        let next = match (scene, restart, &self.current) {
            (Some((generation, scene)), restart, _) => Some((restart.unwrap_or(0).max(generation), scene)),
            (None, Some(generation), Some((_, scene))) => Some((generation, scene.clone())),
            _ => None,
        };
        if let (Some(next), false) = (next, demands.quit) {
            self.current = Some(next);
            self.guarded(Self::begin);
        }
        demands
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
        // Never cancelled: otherwise a fast drag would show nothing.
        let draft = self.pool.install(|| session.draft(generation, self.drafts.first(), Cancel::NEVER));
        self.drafts.first_took(start.elapsed().as_secs_f64());
        draft.into_iter().for_each(|draft| self.shared.publish(draft));
        self.session = Some(session);
        self.last_frame = None;
        Ok(())
    }

    /// Renders the next draft or iteration of the current scene.
    fn advance(&mut self) -> Result<(), SessionError> {
        let (Some((generation, _)), Some(session)) = (&self.current, &mut self.session) else { return Ok(()) };
        let (generation, shared) = (*generation, &self.shared);
        let outdated = move || shared.is_outdated(generation);
        if let Some(coarseness) = self.drafts.next() {
            // Finer drafts bridge the time that the first iteration takes.
            let start = Instant::now();
            let draft = self.pool.install(|| session.draft(generation, coarseness, Cancel::when(&outdated)));
            self.drafts.next_took(start.elapsed().as_secs_f64());
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

    /// Runs a step. An error or a panic becomes a status, and the worker waits for another scene.
    fn guarded(&mut self, step: fn(&mut Self) -> Result<(), SessionError>) {
        let failure = match catch_unwind(AssertUnwindSafe(|| step(self))) {
            Ok(Ok(())) => return,
            Ok(Err(error)) => error.to_string(),
            Err(panic) => format!("a fault in the program stopped rendering: {}", panic_message(&*panic)),
        };
        self.session = None;
        self.shared.set_status(Status::Failed(failure));
    }
}

/// The message of a panic.
fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "unknown".to_owned())
}
