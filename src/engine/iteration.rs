use super::frame::PassSeconds;
use crate::math::Rgb;
use crate::transport::{
    Cancel, Counters, Maps, PerMap, PhotonMap, Plan, Rows, camera_pass, caustic_photon_pass, gather, global_photon_pass,
};
use crate::world::World;
use std::time::Instant;

/// Pixels whose visible points are kept at a time: some 20 MB of them.
const PIXELS_PER_BAND: u32 = 1 << 17;

/// One whole round of the algorithm.
#[derive(Clone, Debug)]
pub(super) struct Iteration {
    /// For each pixel.
    pub(super) radiance: Vec<Rgb>,
    /// For each pixel, of [`gather`].
    pub(super) contrasts: Vec<PerMap<f32>>,
    pub(super) counters: Counters,
    pub(super) seconds: PassSeconds,
}

/// Renders iteration `i`, counted from 1: a pure function of its arguments. `None` when cancelled.
pub(super) fn render_iteration(world: &World, plan: &Plan, seed: u64, i: u64, cancel: Cancel) -> Option<Iteration> {
    let mut counters = Counters::default();
    let mut seconds = PassSeconds::default();

    let (caustic, global) = timed(&mut seconds.photons, || {
        let caustic = caustic_photon_pass(world, plan, seed, i, cancel)?;
        Some((caustic, global_photon_pass(world, plan, seed, i, cancel)?))
    })?;
    counters += caustic.counters;
    counters += global.counters;

    let maps = timed(&mut seconds.map, || {
        let (global, (caustic, focused)) = rayon::join(
            || PhotonMap::build(&global.photons),
            || (PhotonMap::build(&caustic.photons), PhotonMap::build(&global.focused)),
        );
        Maps { caustic, global, focused }
    });
    let built = [&maps.caustic, &maps.global, &maps.focused].into_iter().filter(|map| !map.is_empty()).count();
    counters.map_builds += built as u64;

    let mut radiance = Vec::with_capacity(plan.camera.pixel_count());
    let mut contrasts = vec![PerMap::default(); plan.camera.pixel_count()];
    for rows in bands(plan) {
        let seen = timed(&mut seconds.camera, || camera_pass(world, plan, &rows, seed, i, cancel))?;
        let (gathered, gather_counters) =
            timed(&mut seconds.gather, || gather(world, plan, &maps, &seen.visible_points, i, cancel))?;
        counters += seen.counters;
        counters += gather_counters;
        radiance.extend_from_slice(&seen.radiance);
        for (point, found) in seen.visible_points.iter().zip(&gathered) {
            radiance[point.pixel as usize] += found.radiance;
            contrasts[point.pixel as usize] += found.contrasts;
        }
    }
    for splat in &caustic.splats {
        radiance[splat.pixel as usize] += splat.radiance;
    }
    Some(Iteration { radiance, contrasts, counters, seconds })
}

/// The film in bands of whole rows.
fn bands(plan: &Plan) -> impl Iterator<Item = Rows> {
    let height = plan.camera.height;
    let rows = (PIXELS_PER_BAND / plan.camera.width).max(1);
    (0..height).step_by(rows as usize).map(move |start| start..(start + rows).min(height))
}

/// Runs a pass and adds its wall-clock time.
fn timed<T>(seconds: &mut f64, pass: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = pass();
    *seconds += start.elapsed().as_secs_f64();
    result
}
