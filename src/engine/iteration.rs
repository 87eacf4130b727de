//! One iteration of stochastic progressive photon mapping \[HJ09\]: photon passes, maps, then camera and gather pass band by band.
//! [`Session`](super::Session) commits the result to the film.

use super::frame::PassSeconds;
use crate::transport::{
    Band, Cancel, Contribution, Counters, Maps, Plan, Rows, camera_pass, caustic_photon_pass, gather,
    global_photon_pass,
};
use crate::world::World;
use rayon::prelude::*;
use std::time::Instant;

/// The result of an iteration.
#[derive(Clone, Debug)]
pub(super) struct Iteration {
    /// What the iteration adds to the film.
    pub(super) contribution: Contribution,
    /// The work that it took.
    pub(super) work: Work,
}

/// Work of passes, and the time that they took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Work {
    pub(super) counters: Counters,
    pub(super) seconds: PassSeconds,
}

/// Renders iteration `i` (from 1): a pure function of its arguments. `None` when cancelled.
pub(super) fn render_iteration(world: &World, plan: &Plan, seed: u64, i: u64, cancel: Cancel) -> Option<Iteration> {
    let mut work = Work::default();
    // Both photon passes at once: no thread idles at the end of the first one.
    let (caustic, global) = timed(&mut work.seconds.photons, || {
        rayon::join(
            || caustic_photon_pass(world, plan, seed, i, cancel),
            || global_photon_pass(world, plan, seed, i, cancel),
        )
    });
    let (caustic, global) = (caustic?, global?);
    let maps = timed(&mut work.seconds.map, || {
        Maps::build(&caustic.photons, [&global.photons, &global.indirect_caustics, &global.glossy])
    });
    let bands = plan.bands(i).into_par_iter().map(|rows| render_band(world, plan, &maps, &rows, seed, i, cancel));
    let (bands, of_bands): (Vec<Band>, Vec<Work>) = bands.collect::<Option<Vec<_>>>()?.into_iter().unzip();
    let contribution =
        timed(&mut work.seconds.gather, || Contribution::new(&bands, &caustic.splats, plan.camera.width));
    work.add_bands(&of_bands);
    [caustic.counters, global.counters, maps.counters()].into_iter().for_each(|counters| work.counters += counters);
    Some(Iteration { contribution, work })
}

/// The camera pass and the gather pass for one band of rows.
fn render_band(
    world: &World,
    plan: &Plan,
    maps: &Maps,
    rows: &Rows,
    seed: u64,
    i: u64,
    cancel: Cancel,
) -> Option<(Band, Work)> {
    let mut work = Work::default();
    let seen = timed(&mut work.seconds.camera, || camera_pass(world, plan, rows, seed, i, cancel))?;
    let (gathered, counters) = timed(&mut work.seconds.gather, || gather(world, plan, maps, &seen, seed, i, cancel))?;
    work.counters = [seen.counters, counters].into_iter().sum();
    Some((Band::new(world, plan, rows, seen, &gathered, i), work))
}

impl Work {
    /// Adds the work of bands. All threads rendered bands at once, so a band adds its seconds over the number of threads.
    fn add_bands(&mut self, bands: &[Self]) {
        let threads = rayon::current_num_threads() as f64;
        for band in bands {
            self.counters += band.counters;
            self.seconds.camera += band.seconds.camera / threads;
            self.seconds.gather += band.seconds.gather / threads;
        }
    }
}

/// Runs a pass and adds its wall-clock time, seconds.
fn timed<T>(seconds: &mut f64, pass: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = pass();
    *seconds += start.elapsed().as_secs_f64();
    result
}
