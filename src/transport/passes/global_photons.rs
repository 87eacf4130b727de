//! The photon pass of interreflection.

use super::input::PassInput;
use crate::math::Stream;
use crate::transport::photons::GlobalPhotons;
use crate::transport::photons::global_tracer::GlobalPhotonTracer;
use crate::transport::photons::path_blocks::{concat, path_blocks};
use rayon::prelude::*;

/// The photons of interreflection of an iteration, in the order of their paths; `None` when cancelled. Empty for a plan
/// without interreflection.
pub fn global_photon_pass(input: &PassInput) -> Option<GlobalPhotons> {
    let PassInput { world, plan, iteration, .. } = *input;
    let paths = |&count: &u64| plan.paths(count, iteration);
    let blocks: Vec<GlobalPhotons> = path_blocks(plan.global_paths.iter().map(paths))
        .into_par_iter()
        .map(|block| {
            let mut tracer = GlobalPhotonTracer::new(world, &plan.photon_emissions, Some(&plan.glossy_mis));
            let paths = paths(&plan.global_paths[block.source]);
            let count = paths.end - paths.start;
            for index in block.paths.clone() {
                tracer.trace(block.source, count, input.sampler(Stream::GlobalPhoton, block.source as u64, index));
            }
            (!input.cancel.is_cancelled()).then_some(tracer.stored)
        })
        .collect::<Option<_>>()?;
    let (photons, (indirect_caustics, glossy)) = rayon::join(
        || concat(&blocks, |block| &block.photons),
        || (concat(&blocks, |block| &block.indirect_caustics), concat(&blocks, |block| &block.glossy)),
    );
    let counters = blocks.iter().map(|block| block.counters).sum();
    let energy = blocks.iter().map(|block| block.energy).sum();
    Some(GlobalPhotons { photons, indirect_caustics, glossy, counters, energy })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;
    use crate::transport::pass::Cancel;
    use crate::transport::plan::Plan;
    use crate::transport::testing::{self, lamp, sphere};
    use crate::world::World;
    use std::f64::consts::PI;

    fn closed_room() -> World {
        testing::world(
            &[&sphere("room", [0.0; 3], 2.0, "grey"), &lamp([0.3, -0.2, 0.5]), "[render]\nmax_bounces = 3\n"].concat(),
        )
    }

    /// Small first iterations and full ones bring the same flux: 1/2 + 1/4 of the power, by their own numbers of paths.
    #[test]
    fn every_iteration_brings_the_whole_flux() {
        let world = closed_room();
        let plan = Plan::new(&world);
        let mut paths = Vec::new();
        for iteration in [1, 2, 3, 4, 9] {
            let input = PassInput::uncancelled(&world, &plan, 1, iteration);
            let found = global_photon_pass(&input).expect("never cancelled");
            let flux = found.photons.iter().map(|photon| f64::from(photon.flux.x)).sum::<f64>() / (4.0 * PI);
            let count = found.counters.global_paths;
            // Two arrivals a path with a deviation of 1/2 each, at most all correlated.
            assert!((flux - 0.75).abs() < 4.0 / (count as f64).sqrt(), "{flux} in iteration {iteration}");
            paths.push(count as f64 / plan.global_paths[0] as f64);
        }
        assert_eq!(paths, [0.125, 0.25, 0.5, 1.0, 1.0]);
    }

    /// Diffuse and mirroring parts of different colours: the brightest channels of both are 1.4 of the light. After `k` surfaces, `0.9^k` of a
    /// channel is left, of which the light that was only mirrored is not stored.
    #[test]
    fn colours_of_diffuse_and_mirroring_parts_do_not_move_the_flux() {
        let material =
            "[[material]]\nname = \"m\"\ntype = \"polished\"\nalbedo = [0.5, 0.4, 0]\nreflectance = [0.4, 0.5, 0.9]\n";
        let room = [material, &sphere("room", [0.0; 3], 2.0, "m"), &lamp([0.3, -0.2, 0.5])].concat();
        let world = testing::world(&format!("{room}[render]\nmax_bounces = 4\n"));
        let plan = Plan::new(&world);
        let mut flux = Rgb::ZERO;
        for iteration in 4..12 {
            let input = PassInput::uncancelled(&world, &plan, 1, iteration);
            let found = global_photon_pass(&input).expect("never cancelled");
            let photons = found.photons.iter().chain(&found.indirect_caustics);
            flux += photons.map(|photon| photon.flux).sum::<Rgb>() / (8.0 * 4.0 * PI as f32);
        }
        for (channel, mirrored) in [(0, 0.4f32), (1, 0.5)] {
            let expected: f32 = (1..4).map(|k| 0.9f32.powi(k) - mirrored.powi(k)).sum();
            assert!((flux[channel] / expected - 1.0).abs() < 0.02, "{flux} instead of {expected} in {channel}");
        }
    }

    /// Paths of successive iterations go on in the sequence of their light, so none is traced twice.
    #[test]
    fn iterations_trace_different_paths() {
        let world = closed_room();
        let plan = Plan::new(&world);
        let first = |iteration| {
            let input = PassInput::uncancelled(&world, &plan, 1, iteration);
            let found = global_photon_pass(&input).expect("never cancelled");
            found.photons[0].position
        };
        assert!(first(4) == first(4) && first(4) != first(5));
        let cancelled = PassInput { cancel: Cancel::when(&|| true), ..PassInput::uncancelled(&world, &plan, 1, 4) };
        assert!(global_photon_pass(&cancelled).is_none());
    }
}
