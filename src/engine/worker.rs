//! The worker thread: prepares the newest scene, drafts it, and renders iterations until a newer scene arrives.

use super::draft::{Draft, DraftPace, Preview, Upsampling, detail_coarseness};
use super::frame::Frame;
use super::g_buffer::{GBuffer, shows_the_same};
use super::messages::{Limits, Status};
use super::session::{Session, SessionError};
use super::shared::Shared;
use super::stand_in::StandIn;
use super::visited::Visited;
use crate::film::LinearImage;
use crate::scene::SceneFile;
use crate::transport::{Cancel, Component};
use crate::world::Camera;
use crossbeam_channel::Receiver;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Least time between frames of a converging picture.
const FRAME_INTERVAL: Duration = Duration::from_millis(60);

/// Iterations, as full ones, from which on a picture replaces the one that stands in for it after edits: one with fewer is noisier than an
/// older picture with the changes since.
const SETTLED_WEIGHT: f64 = 8.0;

/// The state of the worker thread.
pub(super) struct Worker {
    shared: Arc<Shared>,
    woken: Receiver<()>,
    pool: rayon::ThreadPool,
    seed: u64,
    /// The present scene and its generation.
    current: Option<(u64, Arc<SceneFile>)>,
    session: Option<Session>,
    /// The scene of the session.
    rendered: Option<Arc<SceneFile>>,
    drafts: DraftPace,
    /// The picture before the edits.
    stand_in: Option<StandIn>,
    /// The pictures of scenes that edits left.
    visited: Visited,
    /// The first picture of the present scene, if another one stands in for parts of it.
    preview: Option<Preview>,
    /// The last picture of the present scene with less noise in its interreflection.
    smoothed: Option<Arc<LinearImage>>,
    /// Whether previews have less noise in their interreflection.
    smooth: bool,
    /// The component of the light that is rendered; `None` for all.
    only: Option<Component>,
    /// Whether frames tell the noise of their pixels.
    noise: bool,
    last_frame: Option<Instant>,
}

/// The caller's present wishes, besides scenes.
struct Demands {
    quit: bool,
    paused: bool,
    target: Option<f64>,
    limits: Limits,
}

impl Worker {
    /// A worker without a scene.
    pub(super) fn new(shared: Arc<Shared>, woken: Receiver<()>, pool: rayon::ThreadPool, seed: u64) -> Self {
        Self {
            shared,
            woken,
            pool,
            seed,
            current: None,
            session: None,
            rendered: None,
            drafts: DraftPace::default(),
            stand_in: None,
            visited: Visited::default(),
            preview: None,
            smoothed: None,
            smooth: false,
            only: None,
            noise: false,
            last_frame: None,
        }
    }

    /// Works until the engine is dropped.
    pub(super) fn run(mut self) {
        loop {
            let shown = (self.smooth, self.noise);
            let Demands { quit, paused, target, limits } = self.take_demands();
            if quit {
                return;
            }
            if (self.smooth, self.noise) != shown {
                self.publish_if(|iterations| iterations > 0);
            }
            let rest = match &self.session {
                // An edit while paused still renders one iteration: otherwise a coarse draft would stay.
                Some(session) if session.iterations() > 0 && paused => Some(Status::Paused),
                Some(session) if target.is_some_and(|error| session.reaches(error)) => Some(Status::Converged),
                Some(session) if is_spent(limits, session) => Some(Status::LimitReached),
                Some(_) => None,
                // Idle or failed.
                None => Some(self.shared.status()),
            };
            if let Some(status) = rest {
                // Published once: an earlier call to wake up may still be in the channel.
                if self.shared.status() != status {
                    if status == Status::Converged {
                        self.preview = None;
                    }
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
        let demands =
            Demands { quit: request.quit, paused: request.paused, target: request.target, limits: request.limits };
        (self.smooth, self.only, self.noise) = (request.smooth, request.only, request.noise);
        let restart = request.restart.take();
        let scene = request.scene.take();
        drop(request);
        if restart.is_some() {
            // A restart shows how the picture converges, from its beginning, with files that may have changed.
            (self.rendered, self.stand_in) = (None, None);
            self.visited.clear();
        }
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
        self.preview = None;
        let previous = self.rendered.take().zip(self.session.take());
        let known = previous.as_ref().map(|(_, session)| session);
        let mut session = self.pool.install(|| Session::prepare(&scene, self.seed, known))?;
        session = session.only(self.only).keeping_interreflection().smoothing_drafts(self.smooth);
        if let Some((_, known)) = previous.as_ref().filter(|(before, _)| shows_the_same(before, &scene)) {
            session = session.showing_the_same(known);
        }
        self.keep_stand_in(previous, &scene, &session);
        session = self.visited.resumed(&scene, session);
        self.last_frame = None;
        if session.iterations() > 0 {
            self.drafts.skip();
        } else if let Some(frame) = self.first_picture(&mut session, generation) {
            self.shared.publish(frame);
        }
        (self.session, self.rendered) = (Some(session), Some(scene));
        self.publish_if(|iterations| iterations > 0);
        Ok(())
    }

    /// The first picture of a session. Never cancelled: otherwise a fast drag would show nothing.
    fn first_picture(&mut self, session: &mut Session, generation: u64) -> Option<Frame> {
        let Self { pool, drafts, stand_in, .. } = self;
        let (camera, pixels) = (session.camera(), session.camera().pixel_count());
        let size = drafts.first(pixels, stand_in.is_some());
        let before = stand_in.as_mut().and_then(|stand_in| pool.install(|| stand_in.with_draft(size)));
        let start = Instant::now();
        let draft = pool.install(|| session.whole_draft(size).cloned())?;
        drafts.first_took(&draft);
        let Some(preview) = before.map(|before| pool.install(|| before.preview(camera, &draft))) else {
            return Some(pool.install(|| frame_of_draft(session, generation, &draft, Cancel::NEVER)));
        };
        let changed = preview.doubtful();
        let finer = drafts.of_changes(changed, start.elapsed().as_secs_f64()).and_then(|size| {
            pool.install(|| session.draft(size, Some(preview.doubtful_pixels(size.coarseness)), Cancel::NEVER))
        });
        let shown = finer.as_ref().unwrap_or(&draft);
        let begun = Instant::now();
        let detail = pool.install(|| detail(session, shown, Some(&preview), Cancel::NEVER));
        if let Some(finer) = &finer {
            drafts.changes_took(finer, begun.elapsed().as_secs_f64(), changed);
        }
        let image = pool.install(|| preview.with_draft(shown, detail.as_deref()));
        self.preview = Some(preview);
        Some(session.frame_of_draft(generation, Arc::new(image), None, shown.stats))
    }

    /// Keeps the picture of the previous scene for the edits that follow, if the one that is kept does not fit the next scene, or has
    /// converged less; forgets a picture that does not fit.
    fn keep_stand_in(&mut self, previous: Option<(Arc<SceneFile>, Session)>, scene: &SceneFile, next: &Session) {
        let fits = |stand_in: &StandIn| stand_in.fits(scene, next.camera());
        let kept = self.stand_in.take().filter(fits);
        let least = kept.as_ref().map_or(0.0, |kept| kept.weight.min(SETTLED_WEIGHT));
        let better = previous.filter(|(_, session)| session.film().weight() > least);
        let smoothed = self.smoothed.take();
        self.stand_in = kept;
        if let Some((scene, session)) = better {
            let (stand_in, rendered) = StandIn::new(scene.clone(), session, smoothed);
            self.visited.keep(scene, rendered);
            if fits(&stand_in) {
                self.stand_in = Some(stand_in);
            }
        }
    }

    /// Renders the next draft or iteration of the current scene.
    fn advance(&mut self) -> Result<(), SessionError> {
        let (Some((generation, _)), Some(session)) = (&self.current, &mut self.session) else { return Ok(()) };
        let (generation, shared) = (*generation, &self.shared);
        let outdated = move || shared.is_outdated(generation);
        let cancel = Cancel::when(&outdated);
        let next = match &self.preview {
            Some(preview) => self.drafts.next_of_changes(preview.doubtful()),
            None => self.drafts.next(),
        };
        if let Some(size) = next {
            // Finer drafts bridge the time that the first iteration takes.
            let start = Instant::now();
            let doubtful = self.preview.as_ref().map(|preview| preview.doubtful_pixels(size.coarseness));
            let draft = self.pool.install(|| session.draft(size, doubtful, cancel));
            self.drafts.next_took(size, start.elapsed().as_secs_f64());
            if let Some(draft) = draft {
                let frame = self.pool.install(|| match &self.preview {
                    Some(preview) => {
                        let begun = Instant::now();
                        let detail = detail(session, &draft, Some(preview), cancel);
                        self.drafts.changes_took(&draft, begun.elapsed().as_secs_f64(), preview.doubtful());
                        let image = preview.with_draft(&draft, detail.as_deref());
                        session.frame_of_draft(generation, Arc::new(image), None, draft.stats)
                    }
                    None => frame_of_draft(session, generation, &draft, cancel),
                });
                self.shared.publish(frame);
            }
            return Ok(());
        }
        let advanced = self.pool.install(|| session.advance(cancel));
        if advanced.is_some() && self.last_frame.is_none_or(|at| at.elapsed() >= FRAME_INTERVAL) {
            self.publish_if(|_| true);
        }
        Ok(())
    }

    fn publish_if(&mut self, wanted: impl Fn(u64) -> bool) {
        if let (Some((generation, _)), Some(session)) = (&self.current, &self.session)
            && wanted(session.iterations())
        {
            let frame = session.frame(*generation);
            let weight = session.film().weight();
            self.smoothed =
                self.smooth.then(|| self.pool.install(|| session.smoothed(&frame.image))).flatten().map(Arc::new);
            let image = self.smoothed.as_ref().unwrap_or(&frame.image);
            let blended =
                self.preview.as_ref().and_then(|preview| preview.with_iterations(image, weight)).map(Arc::new);
            let smoothed = self.smoothed.is_some();
            let preview = blended.or_else(|| self.smoothed.clone());
            let noise = self.noise.then(|| session.film().pixel_noise()).flatten().map(Arc::new);
            self.shared.publish(Frame { preview, smoothed, noise, ..frame });
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

/// Whether a picture has had its time or its iterations. It has one at least.
fn is_spent(Limits { seconds, iterations }: Limits, session: &Session) -> bool {
    session.iterations() > 0
        && (seconds.is_some_and(|limit| session.seconds() >= limit)
            || iterations.is_some_and(|limit| session.iterations() >= limit))
}

/// The frame of a draft, with the pixels of the film; with those of the draft when cancelled.
fn frame_of_draft(session: &Session, generation: u64, draft: &Draft, cancel: Cancel) -> Frame {
    let Camera { width, height, .. } = session.camera();
    let detail = detail(session, draft, None, cancel);
    let picture = |image: &Arc<LinearImage>| match detail.as_deref() {
        Some(detail) => Arc::new(Upsampling::new(draft, Some(detail), image, [width, height]).picture()),
        None => image.clone(),
    };
    session.frame_of_draft(generation, picture(&draft.image), draft.smoothed.as_ref().map(picture), draft.stats)
}

/// What the pixels of a finer grid than the draft's show, at least where the preview lacks them, if there is one; `None` where the draft has all
/// pixels, and when cancelled.
fn detail(session: &Session, draft: &Draft, preview: Option<&Preview>, cancel: Cancel) -> Option<Arc<GBuffer>> {
    let coarseness = detail_coarseness(draft.size.coarseness)?;
    session.g_buffer().or_else(|| {
        let chosen = preview.map(|preview| preview.doubtful_pixels(coarseness));
        session.first_hits(coarseness, chosen, cancel).map(Arc::new)
    })
}

/// The message of a panic.
fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "unknown".to_owned())
}
