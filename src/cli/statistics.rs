use super::CliError;
use crate::engine::{Counters, Frame, PathEnergy};
use serde::Serialize;

/// The statistics of a rendering, as `--stats` writes them.
#[derive(Serialize)]
pub(super) struct Statistics<'a> {
    iterations: u64,
    photons_emitted: u64,
    rays: u64,
    seconds: f64,
    cpu_seconds: f64,
    error_estimate: Option<f64>,
    missing_light: Option<String>,
    dropped_samples: u64,
    width: u32,
    height: u32,
    threads: usize,
    pass_seconds: PassSeconds,
    counters: Counters,
    energy: EnergyBalances,
    plan: Vec<Note<'a>>,
}

#[derive(Serialize)]
struct PassSeconds {
    prepare: f64,
    camera: f64,
    photons: f64,
    map: f64,
    gather: f64,
    commit: f64,
}

/// The energy balance of each component that photons bring, summed over the iterations.
#[derive(Serialize)]
struct EnergyBalances {
    caustics: EnergyBalance,
    interreflection: EnergyBalance,
    worst_balance: f64,
}

#[derive(Serialize)]
struct EnergyBalance {
    #[serde(flatten)]
    entries: PathEnergy,
    path_balance: f64,
    photon_balance: f64,
}

impl From<PathEnergy> for EnergyBalance {
    fn from(entries: PathEnergy) -> Self {
        Self { entries, path_balance: entries.path_balance(), photon_balance: entries.photon_balance() }
    }
}

#[derive(Serialize)]
struct Note<'a> {
    what: String,
    rendered: bool,
    reason: &'a str,
}

impl<'a> Statistics<'a> {
    pub(super) fn new(frame: &'a Frame, cpu_seconds: f64, threads: usize) -> Self {
        let stats = &frame.stats;
        let passes = &stats.passes;
        let note =
            |n: &'a crate::engine::PlanNote| Note { what: n.item.to_string(), rendered: n.rendered, reason: &n.reason };
        Self {
            iterations: stats.iterations,
            photons_emitted: stats.photons_emitted,
            rays: stats.rays,
            seconds: stats.seconds,
            cpu_seconds,
            error_estimate: stats.error_estimate,
            missing_light: stats.missing_light.map(|missing| missing.to_string()),
            dropped_samples: stats.dropped_samples,
            width: frame.image.width,
            height: frame.image.height,
            threads,
            pass_seconds: PassSeconds {
                prepare: passes.prepare,
                camera: passes.camera,
                photons: passes.photons,
                map: passes.map,
                gather: passes.gather,
                commit: passes.commit,
            },
            counters: stats.counters,
            energy: EnergyBalances {
                caustics: stats.energy.caustics.into(),
                interreflection: stats.energy.interreflection.into(),
                worst_balance: stats.energy.worst_balance,
            },
            plan: frame.plan.notes.iter().map(note).collect(),
        }
    }

    pub(super) fn json(&self) -> Result<String, CliError> {
        let json = serde_json::to_string_pretty(self);
        json.map(|text| text + "\n")
            .map_err(|e| CliError::Failed(format!("the statistics cannot be written as JSON: {e}")))
    }
}
