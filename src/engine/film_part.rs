//! A part of a run: consecutive iterations with their measurements.

use super::film_sums::FilmSums;
use super::frame::{MissingLight, PassSeconds, Stats};
use crate::transport::{Contribution, Counters, Energy, FilmStatistics, MeasuredPlan, Plan, UnseenLight};
use flate2::Crc;
use serde::{Deserialize, Serialize};

/// Consecutive iterations of a run: the film, what the iterations measured, and their work.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FilmPart {
    pub(super) film: FilmSums,
    /// `None` before the first iteration.
    statistics: Option<FilmStatistics>,
    /// The last iteration of the run that was rendered, for the film or for its measurements alone.
    pub(super) rendered: u64,
    /// The measured settings of the plan for the next iteration.
    pub(super) plan: MeasuredPlan,
    /// Checksum of the measured settings of the plan for the first iteration of the film.
    first_plan: u32,
    /// The light that no photon path would have brought after one full iteration.
    pub(super) unseen_of_one: Option<UnseenLight>,
    /// Whether the bias of all iterations is known.
    knows_bias: bool,
    pub(super) counters: Counters,
    pub(super) energy: Energy,
    pub(super) passes: PassSeconds,
    pub(super) seconds: f64,
}

impl FilmPart {
    /// The part of a run without iterations, for a plan without measurements.
    pub(super) fn new(plan: &Plan) -> Self {
        Self {
            film: FilmSums::new(plan.camera.width, plan.camera.height),
            statistics: None,
            rendered: 0,
            plan: plan.measured(),
            first_plan: 0,
            unseen_of_one: plan.unseen_light(1.0),
            knows_bias: false,
            counters: Counters::default(),
            energy: Energy::default(),
            passes: PassSeconds::default(),
            seconds: 0.0,
        }
    }

    /// Adds the next iteration of a plan to the measurements, and to the film unless the film begins later. Returns the refined plan where
    /// the schedule says so.
    pub(super) fn commit(
        &mut self,
        plan: &Plan,
        Contribution { photons, samples, differences, energy, .. }: &Contribution,
    ) -> Option<Plan> {
        let Self { film, statistics, .. } = self;
        let iteration = self.rendered + 1;
        let is_in_film = iteration >= film.first();
        let statistics = statistics.get_or_insert_with(|| FilmStatistics::new(plan.camera.width, plan.camera.height));
        if iteration == film.first() {
            self.first_plan = checksum(plan.measured());
        }
        rayon::join(
            || is_in_film.then(|| film.commit(plan.weight(iteration), photons, samples)),
            || statistics.add(iteration, is_in_film, differences, samples),
        );
        let refined = plan.refined(iteration, statistics);
        if let Some(refined) = &refined {
            statistics.begin_refined();
            self.plan = refined.measured();
        }
        self.rendered = iteration;
        if is_in_film {
            self.energy += *energy;
        }
        self.knows_bias = plan.knows_bias(iteration);
        refined
    }

    /// The sums over the iterations.
    pub fn film(&self) -> &FilmSums {
        &self.film
    }

    /// The last iteration of the run that was rendered, for the film or only for its measurements.
    pub fn rendered(&self) -> u64 {
        self.rendered
    }

    /// Statistics of the iterations, without the radius, which depends on the plan.
    pub fn stats(&self) -> Stats {
        let error_estimate = self.error_estimate();
        Stats {
            iterations: self.film.iterations(),
            error_estimate,
            missing_light: self.missing_light(error_estimate),
            energy: self.energy,
            ..Stats::of_work(self.counters, self.passes, self.seconds)
        }
    }

    /// Whether the plans of this part and of `other` have the same measured settings.
    pub fn has_plan_of(&self, other: &Self) -> bool {
        checksum(self.plan.clone()) == checksum(other.plan.clone())
    }

    /// Whether `next` has the iterations after this part, begun with the plan that this part ends with.
    pub fn precedes(&self, next: &Self) -> bool {
        next.film.first() == self.film.last() + 1 && next.first_plan == checksum(self.plan.clone())
    }

    /// This part with the iterations of `next`, which it precedes. The merged part goes on as `next` would.
    pub fn followed_by(mut self, next: Self) -> Self {
        self.film.merge(&next.film);
        let statistics = match (self.statistics, next.statistics) {
            (Some(before), Some(next)) => Some(before.followed_by(next)),
            (before, next) => next.or(before),
        };
        self.counters += next.counters;
        self.energy += next.energy;
        self.passes += next.passes;
        let (film, first_plan, counters, energy) = (self.film, self.first_plan, self.counters, self.energy);
        let (passes, seconds) = (self.passes, self.seconds + next.seconds);
        Self { film, first_plan, statistics, counters, energy, passes, seconds, ..next }
    }

    /// Whether the part is one of a film of this size.
    pub(super) fn fits(&self, width: u32, height: u32) -> bool {
        let next = self.rendered.saturating_add(1);
        let only_measures = self.film.iterations() == 0 && self.rendered <= self.film.last();
        self.film.fits(width, height)
            && (only_measures || self.rendered == self.film.last())
            && self.statistics.as_ref().is_none_or(|statistics| statistics.fits(width, height))
            && self.plan.fits(width, height, next)
    }

    /// Whether the iterations suffice to estimate the error.
    pub(super) fn may_estimate(&self) -> bool {
        self.film.iterations() >= FilmSums::ESTIMATED_FROM && self.knows_bias
    }

    /// Estimated RMSE of the picture over its mean; `None` before there is an estimate.
    pub fn error_estimate(&self) -> Option<f64> {
        self.may_estimate().then(|| self.film.error_estimate(self.squared_hidden()))?
    }

    /// RMSE of the picture over its mean that is seldom exceeded; `None` before there is an estimate.
    pub(super) fn error_bound(&self) -> Option<f64> {
        self.may_estimate().then(|| self.film.error_bound(self.squared_hidden()))?
    }

    /// Mean square of the errors that noise does not show.
    fn squared_hidden(&self) -> f64 {
        let squared_bias = self.statistics.as_ref().map_or(0.0, FilmStatistics::squared_bias);
        let unseen = self.unseen_light().map_or(0.0, |unseen| unseen.radiance);
        squared_bias + unseen.powi(2)
    }

    /// The light that no photon path has brought yet; `None` without photons and before the first iteration.
    pub(super) fn unseen_light(&self) -> Option<UnseenLight> {
        let UnseenLight { item, radiance } = self.unseen_of_one?;
        let weight = self.film.weight();
        (weight > 0.0).then(|| UnseenLight { item, radiance: radiance / weight })
    }

    /// Unseen light, if it makes up most of the error estimate.
    pub(super) fn missing_light(&self, error_estimate: Option<f64>) -> Option<MissingLight> {
        let (UnseenLight { item, radiance }, mean) = (self.unseen_light()?, self.film.mean());
        let fraction = (mean > 0.0).then(|| radiance / mean);
        let dominates =
            |fraction: f64| error_estimate.is_some_and(|estimate| 2.0 * fraction.powi(2) > estimate.powi(2));
        fraction.is_none_or(dominates).then_some(MissingLight { item, fraction })
    }
}

/// The checksum of the measured settings of a plan, whether they are kept or not.
fn checksum(plan: MeasuredPlan) -> u32 {
    let mut checksum = Crc::new();
    // Encoding to memory does not fail.
    checksum.update(&postcard::to_allocvec(&plan.kept()).unwrap_or_default());
    checksum.sum()
}
