//! The photon pass of interreflection.

use crate::math::{Sampler, Stream};
use crate::transport::pass::Cancel;
use crate::transport::photons::GlobalPhotons;
use crate::transport::photons::global_tracer::GlobalPhotonTracer;
use crate::transport::photons::path_blocks::{concat, path_blocks};
use crate::transport::plan::Plan;
use crate::world::World;
use rayon::prelude::*;

/// The photons of interreflection of iteration `iteration` (from 1), in the order of their paths; `None` when cancelled. Empty for a plan
/// without interreflection.
pub fn global_photon_pass(
    world: &World,
    plan: &Plan,
    seed: u64,
    iteration: u64,
    cancel: Cancel,
) -> Option<GlobalPhotons> {
    let paths = |&count: &u64| plan.paths(count, iteration);
    let blocks: Vec<GlobalPhotons> = path_blocks(plan.global_paths.iter().map(paths))
        .into_par_iter()
        .map(|block| {
            let mut tracer = GlobalPhotonTracer::new(world, Some(&plan.glossy_mis));
            let paths = paths(&plan.global_paths[block.light]);
            let count = paths.end - paths.start;
            for index in block.paths.clone() {
                let sampler = Sampler::new(seed, plan.stream(Stream::GlobalPhoton), block.light as u64, index);
                tracer.trace(block.light, count, sampler);
            }
            (!cancel.is_cancelled()).then_some(tracer.stored)
        })
        .collect::<Option<_>>()?;
    let (photons, (indirect_caustics, glossy)) = rayon::join(
        || concat(&blocks, |block| &block.photons),
        || (concat(&blocks, |block| &block.indirect_caustics), concat(&blocks, |block| &block.glossy)),
    );
    let counters = blocks.iter().map(|block| block.counters).sum();
    Some(GlobalPhotons { photons, indirect_caustics, glossy, counters })
}
