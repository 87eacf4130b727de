use super::CliError;
use crate::engine::{Counters, PassSeconds, PathEnergy, PlanNote, PlanSummary, Stats, WorstBalance};
use serde::Serialize;

/// The statistics of a rendering, as `--stats` writes them.
#[derive(Serialize)]
pub(super) struct Statistics<'a> {
    iterations: u64,
    photons_emitted: u64,
    rays: u64,
    seconds: f64,
    #[serde(flatten)]
    work: Option<Work>,
    error_estimate: Option<f64>,
    missing_light: Option<String>,
    dropped_samples: u64,
    width: u32,
    height: u32,
    pass_seconds: PassSeconds,
    counters: Counters,
    #[serde(skip_serializing_if = "Option::is_none")]
    light_sheets: Option<String>,
    energy: EnergyBalances,
    #[serde(skip_serializing_if = "Option::is_none")]
    plan: Option<Vec<Note<'a>>>,
}

/// The work of one program that rendered.
#[derive(Serialize)]
pub(super) struct Work {
    /// Time of all threads.
    pub(super) cpu_seconds: f64,
    /// Number of rendering threads.
    pub(super) threads: usize,
}

/// The energy balance of each component that photons bring, summed over the iterations.
#[derive(Serialize)]
struct EnergyBalances {
    caustics: EnergyBalance,
    interreflection: EnergyBalance,
}

#[derive(Serialize)]
struct EnergyBalance {
    #[serde(flatten)]
    entries: PathEnergy,
    path_balance: f64,
    photon_balance: f64,
    worst_balance: f64,
    worst_iteration: u64,
}

impl EnergyBalance {
    fn new(entries: PathEnergy, worst: WorstBalance) -> Self {
        Self {
            entries,
            path_balance: entries.path_balance(),
            photon_balance: entries.photon_balance(),
            worst_balance: worst.balance,
            worst_iteration: worst.iteration,
        }
    }
}

#[derive(Serialize)]
struct Note<'a> {
    what: String,
    rendered: bool,
    reason: &'a str,
}

impl<'a> Note<'a> {
    fn new(note: &'a PlanNote) -> Self {
        Self { what: note.item.to_string(), rendered: note.rendered, reason: &note.reason }
    }
}

impl<'a> Statistics<'a> {
    /// The statistics of a picture of this width and height in pixels, which one rendering or several made.
    pub(super) fn new(stats: &Stats, (width, height): (u32, u32)) -> Self {
        Self {
            iterations: stats.iterations,
            photons_emitted: stats.photons_emitted,
            rays: stats.rays,
            seconds: stats.seconds,
            work: None,
            error_estimate: stats.error_estimate,
            missing_light: stats.missing_light.map(|missing| missing.to_string()),
            dropped_samples: stats.dropped_samples,
            width,
            height,
            pass_seconds: stats.passes,
            counters: stats.counters,
            light_sheets: stats.light_sheets().map(|share| share.to_string()),
            energy: EnergyBalances {
                caustics: EnergyBalance::new(stats.energy.caustics, stats.energy.worst_of_caustics),
                interreflection: EnergyBalance::new(
                    stats.energy.interreflection,
                    stats.energy.worst_of_interreflection,
                ),
            },
            plan: None,
        }
    }

    /// Adds what only the one rendering knows: its work and its plan.
    pub(super) fn of_rendering(self, work: Work, plan: &'a PlanSummary) -> Self {
        Self { work: Some(work), plan: Some(plan.notes.iter().map(Note::new).collect()), ..self }
    }

    pub(super) fn json(&self) -> Result<String, CliError> {
        let json = serde_json::to_string_pretty(self);
        json.map(|text| text + "\n")
            .map_err(|e| CliError::Failed(format!("the statistics cannot be written as JSON: {e}")))
    }
}
