//! The rendering of one scene.

use super::display::Interreflection;
use super::draft::Draft;
use super::film_part::FilmPart;
use super::film_sums::FilmSums;
use super::frame::{Frame, PlanSummary, Stats};
use super::g_buffer::GBuffer;
use super::iteration::{Light, iterate, see, trace_light};
use super::pass_meter::{PassMeter, Work};
use crate::film::LinearImage;
use crate::math::Rgb;
use crate::scene::SceneFile;
use crate::transport::{Cancel, Component, Contribution, DraftSize, PassInput, Plan, g_buffer};
use crate::world::{Camera, PrepareError, World, prepare, warnings};
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Instant;
use thiserror::Error;

/// Why a scene cannot be rendered.
#[derive(Debug, Error)]
pub enum SessionError {
    /// A file of the scene is missing or damaged.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
    /// The operating system denied the threads.
    #[error("the system gave no threads to render with: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The memory does not suffice for the film.
    #[error("a picture of {width} x {height} pixels takes about {} MB of memory, more than is free", needed >> 20)]
    Memory {
        /// Width of the film, pixels.
        width: u32,
        /// Height of the film, pixels.
        height: u32,
        /// Memory needed, bytes.
        needed: u64,
    },
}

/// Iterations after which a picture without any light counts as black: a relative error has no meaning there.
pub const BLACK_ITERATIONS: u64 = 64;

/// Most memory for each pixel, bytes: film sums, statistics, an iteration with lobe samples, the interreflection kept apart, what the pixels
/// show, a frame and the encoded file.
const BYTES_PER_PIXEL: u64 = 620;

/// Checks the memory for the film beforehand: the system ends a program that runs out of memory.
fn check_memory(camera: &Camera) -> Result<(), SessionError> {
    let needed = camera.pixel_count() as u64 * BYTES_PER_PIXEL;
    let mut probe = Vec::<u8>::new();
    let is_free = usize::try_from(needed).is_ok_and(|bytes| probe.try_reserve_exact(bytes).is_ok());
    let (width, height) = (camera.width, camera.height);
    is_free.then_some(()).ok_or(SessionError::Memory { width, height, needed })
}

/// The rendering of one scene, on the caller's thread and its pool.
pub struct Session {
    world: World,
    plan: Plan,
    summary: Arc<PlanSummary>,
    seed: u64,
    part: FilmPart,
    /// The last draft with pixels over the whole film.
    draft: Option<Draft>,
    /// The light of the last draft, and the thinning of its photons.
    draft_light: Option<(u32, Light)>,
    /// What the pixels of the film show, once that is known.
    g_buffer: Option<Arc<GBuffer>>,
    /// Whether iterations add to `interreflection`.
    keeps_interreflection: bool,
    /// Whether drafts come with less noise in their interreflection, too.
    smooths_drafts: bool,
    /// The interreflection of the iterations so far, as long as a screen shows it with less noise.
    interreflection: Option<Interreflection>,
}

/// What a session has rendered, apart from its scene.
pub(super) struct Rendered {
    part: FilmPart,
    interreflection: Option<Interreflection>,
    g_buffer: Option<Arc<GBuffer>>,
}

impl Rendered {
    /// The iterations, as full ones.
    pub(super) fn weight(&self) -> f64 {
        self.part.film.weight()
    }

    /// The number of pixels of the film.
    pub(super) fn pixels(&self) -> usize {
        self.part.film.pixel_count()
    }
}

impl Session {
    /// Prepares a scene and its plan, and reuses the trees and textures that the scene has in common with the scene of the `previous`
    /// session. Call this inside the thread pool that is to do the work.
    ///
    /// # Errors
    ///
    /// When a file of the scene cannot be read, and when the memory does not suffice for the film.
    pub fn prepare(file: &SceneFile, seed: u64, previous: Option<&Self>) -> Result<Self, SessionError> {
        let start = Instant::now();
        let world = prepare(&file.scene, &file.location, previous.map(|session| &session.world))?;
        check_memory(&world.camera)?;
        let plan = Plan::new(&world);
        let summary = Arc::new(PlanSummary { notes: plan.notes.clone(), warnings: warnings(&file.scene, &world) });
        let mut part = FilmPart::new(&plan);
        part.passes.prepare = start.elapsed().as_secs_f64();
        Ok(Self {
            world,
            plan,
            summary,
            seed,
            part,
            draft: None,
            draft_light: None,
            g_buffer: None,
            keeps_interreflection: false,
            smooths_drafts: false,
            interreflection: None,
        })
    }

    /// Restricts the session to one component of the light, if one is given. Call this before the first iteration.
    pub fn only(mut self, component: Option<Component>) -> Self {
        if let Some(component) = component {
            self.plan = self.plan.only(component);
            self.part.unseen_of_one = self.plan.unseen_light(1.0);
            let warnings = self.summary.warnings.clone();
            self.summary = Arc::new(PlanSummary { notes: self.plan.notes.clone(), warnings });
        }
        self
    }

    /// Begins the film with iteration `first` of the run. The iterations before it are rendered, too, because they measure the plan.
    pub fn beginning_with(mut self, first: u64) -> Self {
        self.part.film = FilmSums::after(self.plan.camera.width, self.plan.camera.height, first.saturating_sub(1));
        self
    }

    /// Keeps the interreflection of the first iterations apart, so that it can be smoothed. Call this before the first iteration.
    pub(super) fn keeping_interreflection(mut self) -> Self {
        self.keeps_interreflection = true;
        self
    }

    /// Makes drafts, or not, with less noise in their interreflection, too.
    pub(super) fn smoothing_drafts(mut self, smooth: bool) -> Self {
        self.smooths_drafts = smooth;
        self
    }

    /// The picture so far with less noise in its interreflection, for a screen; `None` where there is no need.
    pub(super) fn smoothed(&self, image: &LinearImage) -> Option<LinearImage> {
        self.interreflection.as_ref().map(|sums| sums.smoothed(image))
    }

    /// Goes on where a part of the same run ended.
    pub fn resuming(mut self, mut part: FilmPart) -> Self {
        part.passes.prepare += self.part.passes.prepare;
        self.plan = self.plan.with_measured(part.plan.clone());
        self.part = part;
        self
    }

    /// Renders the following iterations with the plan that another part of the run measured, and keeps that plan. No iteration before the
    /// first one of the film is rendered.
    pub fn keeping(mut self, measured: &FilmPart) -> Self {
        self.part.plan = measured.plan.clone().kept();
        self.plan = self.plan.with_measured(self.part.plan.clone());
        self.part.rendered = self.part.film.last();
        self
    }

    /// The iterations so far, to go on later or elsewhere.
    pub fn part(&self) -> &FilmPart {
        &self.part
    }

    /// The decisions of the plan before any measurement.
    pub fn plan(&self) -> &Arc<PlanSummary> {
        &self.summary
    }

    /// Renders the next iteration and commits it to the film; `None` when cancelled, which does not change the film.
    pub fn advance(&mut self, cancel: Cancel) -> Option<()> {
        let start = Instant::now();
        let Self { world, plan, part, seed, interreflection, keeps_interreflection, g_buffer, .. } = self;
        let iteration = part.rendered + 1;
        let meter = PassMeter::default();
        let guides = *keeps_interreflection && (iteration == 1 || interreflection.is_some());
        let input = PassInput { world, plan, seed: *seed, iteration, guides, cancel };
        let refined = iterate(&input, &meter, |contribution| {
            if guides {
                let size = [plan.camera.width, plan.camera.height];
                let sums = interreflection.get_or_insert_with(|| Interreflection::new(size, contribution));
                sums.commit(plan.weight(iteration) as f32, contribution);
                if let Some(of_film) = GBuffer::of_pass(size, contribution) {
                    *g_buffer = Some(Arc::new(of_film));
                }
            }
            part.commit(plan, contribution)
        });
        self.part.seconds += start.elapsed().as_secs_f64();
        if let Some(refined) = refined? {
            self.plan = refined;
        }
        self.interreflection.take_if(|_| Interreflection::strength(self.part.film.weight()) == 0.0);
        // An iteration that only measures is no work of the film.
        if iteration >= self.part.film.first() {
            let Work { counters, seconds } = meter.work();
            self.part.counters += counters;
            self.part.passes += seconds;
        }
        Some(())
    }

    /// Number of iterations in the film.
    pub fn iterations(&self) -> u64 {
        self.part.film.iterations()
    }

    /// Whether a bound of the error (RMSE over the mean) is known and at most this. A black picture has no error once
    /// [`BLACK_ITERATIONS`] found no light, or if there is no photon to wait for.
    pub fn reaches(&self, error: f64) -> bool {
        let is_black = || {
            self.part.film.is_black() && (self.iterations() >= BLACK_ITERATIONS || self.part.unseen_light().is_none())
        };
        self.part.may_estimate() && self.part.error_bound().map_or_else(is_black, |bound| bound <= error)
    }

    /// Rendering time of all iterations, cancelled ones included, seconds.
    pub fn seconds(&self) -> f64 {
        self.part.seconds
    }

    /// The sums over all iterations.
    pub fn film(&self) -> &FilmSums {
        &self.part.film
    }

    /// The picture so far, black before the first iteration, as a frame of this generation.
    pub fn frame(&self, generation: u64) -> Frame {
        let image = Arc::new(self.part.film.image());
        self.frame_of(generation, image, self.iterations(), self.stats())
    }

    /// A quick picture of this size, of the chosen pixels only, if any; `None` when cancelled. The film does not change. Its light is that of
    /// the draft before, if that had the same thinning.
    pub fn draft(&mut self, size: DraftSize, chosen: Option<Arc<[bool]>>, cancel: Cancel) -> Option<Draft> {
        let start = Instant::now();
        let meter = PassMeter::default();
        let Self { world, plan, seed, draft_light, .. } = self;
        let smooths = self.smooths_drafts;
        let of_all_pixels = plan.draft(DraftSize { coarseness: 1, ..size });
        let plan = plan_of_draft(plan, size, chosen);
        let input = |plan| PassInput { world, plan, seed: *seed, iteration: 1, guides: true, cancel };
        if draft_light.as_ref().is_none_or(|(thinning, _)| *thinning != size.thinning) {
            *draft_light = Some((size.thinning, trace_light(&input(&of_all_pixels), &meter)?));
        }
        let (_, light) = draft_light.as_ref()?;
        let (width, height) = (plan.camera.width, plan.camera.height);
        let (image, smoothed, sharp, g_buffer) = see(&input(&plan), light, &meter, |contribution| {
            let Contribution { photons, samples, interreflection, .. } = contribution;
            let pixels = photons.iter().zip(samples).map(|(photons, samples)| *photons + samples.mean());
            let pixels: Vec<Rgb> = pixels.collect();
            let sharp = pixels.iter().zip(interreflection).map(|(all, smooth)| *all - *smooth).collect();
            let image = LinearImage::positive_part(width, height, pixels);
            let smoothed = smooths.then(|| Arc::new(smoothed_draft(&image, contribution)));
            (image, smoothed, sharp, GBuffer::of_pass([width, height], contribution))
        })?;
        let Work { counters, seconds } = meter.work();
        let stats = Stats::of_work(counters, seconds, start.elapsed().as_secs_f64());
        Some(Draft { size, image: Arc::new(image), smoothed, sharp, g_buffer: g_buffer?, stats })
    }

    /// Takes over what the pixels of the film show from a session whose scene shows the same in other light.
    pub(super) fn showing_the_same(mut self, as_session: &Self) -> Self {
        self.g_buffer = as_session.g_buffer.clone();
        self
    }

    /// What the pixels of the film show, as far as that is known without more rays.
    pub(super) fn g_buffer(&self) -> Option<Arc<GBuffer>> {
        self.g_buffer.clone()
    }

    /// What the first rays of a draft of this coarseness meet, in the chosen pixels only, if any; `None` when cancelled.
    pub(super) fn first_hits(&self, coarseness: u32, chosen: Option<Arc<[bool]>>, cancel: Cancel) -> Option<GBuffer> {
        let Self { world, plan, seed, .. } = self;
        let plan = plan_of_draft(plan, DraftSize { coarseness, thinning: 1 }, chosen);
        let input = PassInput { world, plan: &plan, seed: *seed, iteration: 1, guides: false, cancel };
        let bands: Vec<_> = plan.bands(1).into_par_iter().map(|rows| g_buffer(&input, &rows)).collect::<Option<_>>()?;
        Some(GBuffer::of_first_hits([plan.camera.width, plan.camera.height], bands.concat()))
    }

    /// A draft of this size with pixels over the whole film; kept for the next call. Never cancelled.
    pub(super) fn whole_draft(&mut self, size: DraftSize) -> Option<&Draft> {
        if self.draft.as_ref().is_none_or(|draft| draft.size != size) {
            self.draft = self.draft(size, None, Cancel::NEVER);
        }
        self.draft.as_ref()
    }

    /// A draft, or another picture of the scene that is no film, as a frame of this generation. A screen shows it `smoothed`, if that is given.
    pub(super) fn frame_of_draft(
        &self,
        generation: u64,
        image: Arc<LinearImage>,
        smoothed: Option<Arc<LinearImage>>,
        stats: Stats,
    ) -> Frame {
        let frame = self.frame_of(generation, image, 0, stats);
        Frame { draft: true, smoothed: smoothed.is_some(), preview: smoothed, ..frame }
    }

    /// The session without its iterations, for drafts of its scene, and what it has rendered.
    pub(super) fn without_film(mut self) -> (Self, Rendered) {
        let part = std::mem::replace(&mut self.part, FilmPart::new(&self.plan));
        let rendered = Rendered { part, interreflection: self.interreflection.take(), g_buffer: self.g_buffer.clone() };
        (self, rendered)
    }

    /// Goes on where another session of the same scene ended.
    pub(super) fn with_rendered(mut self, Rendered { part, interreflection, g_buffer }: Rendered) -> Self {
        (self.interreflection, self.g_buffer) = (interreflection, g_buffer);
        self.resuming(part)
    }

    /// The camera with the film's grid.
    pub(super) fn camera(&self) -> Camera {
        self.world.camera
    }

    /// Statistics of the rendering so far.
    pub fn stats(&self) -> Stats {
        let radius = self.plan.mean_radius(self.world.view.distance, self.part.film.last());
        Stats { radius, ..self.part.stats() }
    }

    fn frame_of(&self, generation: u64, image: Arc<LinearImage>, iteration: u64, stats: Stats) -> Frame {
        let (plan, g_buffer) = (self.summary.clone(), self.g_buffer.clone());
        Frame {
            generation,
            draft: false,
            iteration,
            image,
            preview: None,
            smoothed: false,
            g_buffer,
            noise: None,
            stats,
            plan,
        }
    }
}

/// The plan of a draft of this size, of the chosen pixels only, if any.
fn plan_of_draft(plan: &Plan, size: DraftSize, chosen: Option<Arc<[bool]>>) -> Plan {
    let whole = plan.draft(size);
    match chosen {
        Some(chosen) => whole.of_pixels(chosen),
        None => whole,
    }
}

/// A draft with less noise in its interreflection.
fn smoothed_draft(image: &LinearImage, contribution: &Contribution) -> LinearImage {
    let mut sums = Interreflection::new([image.width, image.height], contribution);
    sums.commit(1.0, contribution);
    sums.smoothed(image)
}
