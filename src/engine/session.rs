//! The rendering of one scene.

use super::film_sums::FilmSums;
use super::frame::{Frame, MissingLight, PassSeconds, PlanSummary, Stats};
use super::iteration::iterate;
use super::pass_meter::{PassMeter, Work};
use crate::film::LinearImage;
use crate::scene::SceneFile;
use crate::transport::{Cancel, Component, Contribution, Counters, FilmStatistics, PassInput, Plan, UnseenLight};
use crate::world::{Camera, PrepareError, World, prepare, warnings};
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

/// Most memory for each pixel, bytes: film sums, statistics, an iteration with lobe samples, a frame and the encoded file.
const BYTES_PER_PIXEL: u64 = 400;

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
    film: FilmSums,
    /// `None` before the first iteration.
    statistics: Option<FilmStatistics>,
    counters: Counters,
    passes: PassSeconds,
    seconds: f64,
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
        let film = FilmSums::new(plan.camera.width, plan.camera.height);
        let passes = PassSeconds { prepare: start.elapsed().as_secs_f64(), ..PassSeconds::default() };
        Ok(Self {
            world,
            plan,
            summary,
            seed,
            film,
            statistics: None,
            counters: Counters::default(),
            passes,
            seconds: 0.0,
        })
    }

    /// Restricts the session to one component of the light, if one is given. Call this before the first iteration.
    pub fn only(mut self, component: Option<Component>) -> Self {
        if let Some(component) = component {
            self.plan = self.plan.only(component);
            let warnings = self.summary.warnings.clone();
            self.summary = Arc::new(PlanSummary { notes: self.plan.notes.clone(), warnings });
        }
        self
    }

    /// The decisions of the plan before any measurement.
    pub fn plan(&self) -> &Arc<PlanSummary> {
        &self.summary
    }

    /// Renders the next iteration and commits it to the film; `None` when cancelled, which does not change the film.
    pub fn advance(&mut self, cancel: Cancel) -> Option<()> {
        let start = Instant::now();
        let Self { world, plan, film, statistics, seed, .. } = self;
        let (seed, iteration) = (*seed, film.iterations() + 1);
        let meter = PassMeter::default();
        let input = PassInput { world, plan, seed, iteration, cancel };
        let refined = iterate(&input, &meter, |contribution| {
            let new = || FilmStatistics::new(plan.camera.width, plan.camera.height);
            commit(film, statistics.get_or_insert_with(new), plan, iteration, contribution)
        });
        self.seconds += start.elapsed().as_secs_f64();
        if let Some(refined) = refined? {
            self.plan = refined;
        }
        let Work { counters, seconds } = meter.work();
        self.counters += counters;
        self.passes += seconds;
        Some(())
    }

    /// Number of iterations in the film.
    pub fn iterations(&self) -> u64 {
        self.film.iterations()
    }

    /// Whether the estimated error (RMSE over the mean) is known and at most this. A black picture has no error once
    /// [`BLACK_ITERATIONS`] found no light, or if there is no photon to wait for.
    pub fn reaches(&self, error: f64) -> bool {
        let is_black = || self.iterations() >= BLACK_ITERATIONS || self.unseen_light().is_none();
        self.may_estimate() && self.error_estimate().map_or_else(is_black, |estimate| estimate <= error)
    }

    /// Whether the iterations suffice to estimate the error.
    fn may_estimate(&self) -> bool {
        self.iterations() >= FilmSums::ESTIMATED_FROM && self.plan.knows_bias(self.iterations())
    }

    fn error_estimate(&self) -> Option<f64> {
        if !self.may_estimate() {
            return None;
        }
        let squared_bias = self.statistics.as_ref().map_or(0.0, FilmStatistics::squared_bias);
        let unseen = self.unseen_light().map_or(0.0, |unseen| unseen.radiance);
        self.film.error_estimate(squared_bias + unseen.powi(2))
    }

    /// The light that no photon path has brought yet; `None` without photons and before the first iteration.
    fn unseen_light(&self) -> Option<UnseenLight> {
        (self.film.weight() > 0.0).then(|| self.plan.unseen_light(self.film.weight()))?
    }

    /// Unseen light, if it makes up most of the error estimate.
    fn missing_light(&self, error_estimate: Option<f64>) -> Option<MissingLight> {
        let (UnseenLight { item, radiance }, mean) = (self.unseen_light()?, self.film.mean());
        let fraction = (mean > 0.0).then(|| radiance / mean);
        let dominates =
            |fraction: f64| error_estimate.is_some_and(|estimate| 2.0 * fraction.powi(2) > estimate.powi(2));
        fraction.is_none_or(dominates).then_some(MissingLight { item, fraction })
    }

    /// Rendering time of all iterations, cancelled ones included, seconds.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// The sums over all iterations.
    pub fn film(&self) -> &FilmSums {
        &self.film
    }

    /// The picture so far, black before the first iteration, as a frame of this generation.
    pub fn frame(&self, generation: u64) -> Frame {
        let image = Arc::new(self.film.image());
        self.frame_of(generation, image, self.film.iterations(), self.stats())
    }

    /// A quick picture with every `coarseness`-th pixel each way, as a frame of this generation; `None` when cancelled. The film does
    /// not change.
    pub fn draft(&self, generation: u64, coarseness: u32, cancel: Cancel) -> Option<Frame> {
        let start = Instant::now();
        let plan = self.plan.draft(coarseness);
        let (width, height) = (plan.camera.width, plan.camera.height);
        let meter = PassMeter::default();
        let input = PassInput { world: &self.world, plan: &plan, seed: self.seed, iteration: 1, cancel };
        let image = iterate(&input, &meter, |Contribution { photons, samples, .. }| {
            let pixels = photons.iter().zip(samples).map(|(photons, samples)| *photons + samples.mean());
            LinearImage::positive_part(width, height, pixels)
        })?;
        let Work { counters, seconds } = meter.work();
        let stats = stats(&counters, seconds, start.elapsed().as_secs_f64());
        Some(Frame { draft: true, ..self.frame_of(generation, Arc::new(image), 0, stats) })
    }

    /// Statistics of the rendering so far.
    pub fn stats(&self) -> Stats {
        let error_estimate = self.error_estimate();
        Stats {
            iterations: self.film.iterations(),
            radius: self.plan.mean_radius(self.world.view.distance, self.film.iterations()),
            error_estimate,
            missing_light: self.missing_light(error_estimate),
            ..stats(&self.counters, self.passes, self.seconds)
        }
    }

    fn frame_of(&self, generation: u64, image: Arc<LinearImage>, iteration: u64, stats: Stats) -> Frame {
        Frame { generation, draft: false, iteration, image, stats, plan: self.summary.clone() }
    }
}

/// Adds an iteration to the film and to the measurements; returns the refined plan where the schedule says so.
fn commit(
    film: &mut FilmSums,
    statistics: &mut FilmStatistics,
    plan: &Plan,
    iteration: u64,
    Contribution { photons, samples, differences }: &Contribution,
) -> Option<Plan> {
    rayon::join(
        || film.commit(plan.weight(iteration), photons, samples),
        || statistics.add(iteration, differences, samples),
    );
    let refined = plan.refined(iteration, statistics);
    if refined.is_some() {
        statistics.begin_refined();
    }
    refined
}

fn stats(counters: &Counters, passes: PassSeconds, seconds: f64) -> Stats {
    let photons_emitted = counters.caustic_paths + counters.global_paths;
    Stats {
        photons_emitted,
        rays: counters.rays + counters.shadow_rays,
        dropped_samples: counters.dropped_samples,
        seconds,
        photons_per_second: if seconds > 0.0 { photons_emitted as f64 / seconds } else { 0.0 },
        passes,
        counters: *counters,
        ..Stats::default()
    }
}
