//! One iteration of stochastic progressive photon mapping \[HJ09\]: the main loop of the algorithm.

use super::pass_meter::{Pass, PassMeter};
use crate::transport::{
    Band, Contribution, Energy, LightSheets, Maps, PassInput, Rows, Splat, camera_pass, caustic_photon_pass, gather,
    global_photon_pass,
};
use rayon::prelude::*;

/// The light of an iteration, before a camera sees it.
pub(super) struct Light {
    maps: Maps,
    sheets: LightSheets,
    splats: Vec<Splat>,
    energy: Energy,
}

/// Renders an iteration: its light and what the camera sees of it. Returns what `commit` returns of the contribution, which is a pure
/// function of `input`; `None` when cancelled, before any commit.
pub fn iterate<T>(input: &PassInput, meter: &PassMeter, commit: impl FnOnce(&Contribution) -> T) -> Option<T> {
    see(input, &trace_light(input, meter)?, meter, commit)
}

/// The photon passes and the photon maps; `None` when cancelled.
pub(super) fn trace_light(input: &PassInput, meter: &PassMeter) -> Option<Light> {
    // Both photon passes at once: no thread idles at the end of the first one.
    let photon_passes = || rayon::join(|| caustic_photon_pass(input), || global_photon_pass(input));
    let (caustic, global) = meter.run(Pass::Photons, photon_passes);
    let (caustic, global) = (caustic?, global?);
    let of_interreflection = [&global.photons[..], &global.indirect_caustics, &global.glossy];
    let maps = meter.run(Pass::Map, || Maps::build(&caustic.photons, of_interreflection));
    let energy = Energy::of_iteration(input.iteration, caustic.energy, global.energy);
    Some(Light { maps, sheets: caustic.sheets, splats: caustic.splats, energy })
}

/// The camera pass and the gather pass band by band, and the commit of the contribution; `None` when cancelled.
pub(super) fn see<T>(
    input: &PassInput,
    light: &Light,
    meter: &PassMeter,
    commit: impl FnOnce(&Contribution) -> T,
) -> Option<T> {
    let plan = input.plan;
    let band = |rows: Rows| {
        let seen = meter.run_band(Pass::Camera, || camera_pass(input, &rows))?;
        let gathered = meter.run_band(Pass::Gather, || gather(input, &light.maps, &light.sheets, &seen))?;
        Some(Band::new(input, &rows, seen, &gathered.points))
    };
    let bands: Vec<Band> = plan.bands(input.iteration).into_par_iter().map(band).collect::<Option<_>>()?;
    let contribution =
        meter.time(Pass::Gather, || Contribution::new(&bands, &light.splats, plan.camera.width, light.energy));
    Some(meter.time(Pass::Commit, || commit(&contribution)))
}
