use super::frame::PassSeconds;
use crate::math::Rgb;
use crate::transport::{
    Cancel, Contrast, Counters, MapKind, Maps, PhotonMap, PixelSamples, Plan, Rows, SeenLobe, camera_pass,
    caustic_photon_pass, gather, global_photon_pass, join, seen_lobes, share_lobes,
};
use crate::world::World;
use rayon::prelude::*;
use std::time::Instant;

/// One whole round of the algorithm, for the film or a band of it.
#[derive(Clone, Debug)]
pub(super) struct Iteration {
    /// For each pixel the radiance that photons bring.
    pub(super) photons: Vec<Rgb>,
    /// For each pixel the rest of its radiance.
    pub(super) samples: Vec<PixelSamples>,
    /// For each pixel, of [`gather`].
    pub(super) contrasts: Vec<Contrast>,
    pub(super) counters: Counters,
    pub(super) seconds: PassSeconds,
}

/// Renders iteration `i`, counted from 1: a pure function of its arguments. `None` when cancelled.
pub(super) fn render_iteration(world: &World, plan: &Plan, seed: u64, i: u64, cancel: Cancel) -> Option<Iteration> {
    let mut counters = Counters::default();
    let mut seconds = PassSeconds::default();

    // Side by side: no thread is idle while the other one is at the end of a pass.
    let (caustic, global) = timed(&mut seconds.photons, || {
        rayon::join(
            || caustic_photon_pass(world, plan, seed, i, cancel),
            || global_photon_pass(world, plan, seed, i, cancel),
        )
    });
    let (caustic, global) = (caustic?, global?);
    counters += caustic.counters;
    counters += global.counters;

    let maps = timed(&mut seconds.map, || {
        let others = [&caustic.photons, &global.focused, &global.glossy];
        let (global, [caustic, focused, glossy]) =
            rayon::join(|| PhotonMap::build(&global.photons), || others.map(|photons| PhotonMap::build(photons)));
        Maps { caustic, global, focused, glossy }
    });
    let built = MapKind::ALL.into_iter().filter(|kind| !maps[*kind].is_empty()).count();
    counters.map_builds += built as u64;

    let bands = plan.bands(i).into_par_iter().map(|rows| render_band(world, plan, &maps, &rows, seed, i, cancel));
    let bands: Vec<Band> = bands.collect::<Option<_>>()?;
    let threads = rayon::current_num_threads() as f64;
    for Band { iteration: band, .. } in &bands {
        counters += band.counters;
        seconds.camera += band.seconds.camera / threads;
        seconds.gather += band.seconds.gather / threads;
    }
    let ((mut photons, samples), contrasts) = rayon::join(
        || {
            let mut photons = join(&bands, |band| &band.iteration.photons);
            for splat in &caustic.splats {
                photons[splat.pixel as usize] += splat.radiance;
            }
            (photons, join(&bands, |band| &band.iteration.samples))
        },
        || join(&bands, |band| &band.iteration.contrasts),
    );
    let lobes = bands.iter().map(|band| band.lobes.as_slice());
    timed(&mut seconds.gather, || share_lobes(lobes, plan.camera.width, &mut photons));
    Some(Iteration { photons, samples, contrasts, counters, seconds })
}

/// An iteration for some rows of the film, but for what their pixels share.
struct Band {
    iteration: Iteration,
    /// See [`seen_lobes`].
    lobes: Vec<Option<SeenLobe>>,
}

/// What the camera sees in some rows of the film.
fn render_band(
    world: &World,
    plan: &Plan,
    maps: &Maps,
    rows: &Rows,
    seed: u64,
    i: u64,
    cancel: Cancel,
) -> Option<Band> {
    let mut seconds = PassSeconds::default();
    let seen = timed(&mut seconds.camera, || camera_pass(world, plan, rows, seed, i, cancel))?;
    let (gathered, mut counters) = timed(&mut seconds.gather, || gather(world, plan, maps, &seen, i, cancel))?;
    counters += seen.counters;
    let (pixels, first) = (seen.samples.len(), rows.start * plan.camera.width);
    let (mut photons, mut contrasts) = (vec![Rgb::ZERO; pixels], vec![Contrast::default(); pixels]);
    let mut lobes = seen_lobes(world, plan, &seen.visible_points, rows, i);
    for (point, found) in seen.visible_points.iter().zip(&gathered) {
        let place = (point.pixel - first) as usize;
        contrasts[place] += found.contrast;
        match lobes.get_mut(place) {
            Some(Some(lobe)) if !point.seen_directly => lobe.found += found.radiance,
            _ => photons[place] += found.radiance,
        }
    }
    let iteration = Iteration { photons, samples: seen.samples, contrasts, counters, seconds };
    Some(Band { iteration, lobes })
}

/// Runs a pass and adds its wall-clock time.
fn timed<T>(seconds: &mut f64, pass: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = pass();
    *seconds += start.elapsed().as_secs_f64();
    result
}
