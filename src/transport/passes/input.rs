use crate::math::{Sampler, Stream};
use crate::transport::pass::Cancel;
use crate::transport::plan::Plan;
use crate::world::World;

/// The input that all passes of an iteration have in common; their results depend on nothing else.
#[derive(Clone, Copy)]
pub struct PassInput<'a> {
    /// The scene, prepared for tracing rays.
    pub world: &'a World,
    /// The work of each pass.
    pub plan: &'a Plan,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Number of the iteration, from 1.
    pub iteration: u64,
    /// Whether to tell what pixels show: for a filter of the picture, and for drafts.
    pub guides: bool,
    /// Tells the passes when to give up.
    pub cancel: Cancel<'a>,
}

impl<'a> PassInput<'a> {
    /// The input of passes that always finish.
    pub fn uncancelled(world: &'a World, plan: &'a Plan, seed: u64, iteration: u64) -> Self {
        Self { world, plan, seed, iteration, guides: false, cancel: Cancel::NEVER }
    }

    /// Whether the camera pass tells where first rays end.
    pub(super) fn wants_first_hits(&self) -> bool {
        self.plan.is_draft() || (self.guides && self.iteration == 1)
    }

    /// The sampler at this index of a sequence, of the plan's version of a stream: see [`Plan::stream`].
    #[inline]
    pub(super) fn sampler(&self, stream: Stream, sequence: u64, index: u64) -> Sampler {
        Sampler::new(self.seed, self.plan.stream(stream), sequence, index)
    }
}
