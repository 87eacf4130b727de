//! The plan refined by the measurements of iterations.

use super::render_plan::Plan;
use crate::transport::density::sample_allocation::SampleAllocation;
use crate::transport::density::{Bandwidth, FilmStatistics, schedule};
use std::sync::Arc;

impl Plan {
    /// The plan for the iterations after `i`, with the camera samples and radii that suit the measurements; `None` where the schedule
    /// keeps the plan. A kept plan is refined to itself.
    pub fn refined(&self, i: u64, statistics: &FilmStatistics) -> Option<Self> {
        if !schedule::refines_after(i) {
            return None;
        }
        if self.is_kept {
            return Some(self.clone());
        }
        let next = |pixel| self.camera_samples(pixel, i).end;
        let samples =
            || self.finds_direct_light.then(|| Arc::new(SampleAllocation::best(i, &statistics.samples, next)));
        let bandwidth = || {
            // The next refinement comes after twice as many iterations.
            let total = schedule::size_before(2 * i + 1);
            Arc::new(match &self.bandwidth {
                None => Bandwidth::first(&statistics.differences, total, self.shrink(i)),
                Some(bandwidth) => bandwidth.next(&statistics.differences, total),
            })
        };
        let (samples, bandwidth) = rayon::join(samples, || self.gathers().then(bandwidth));
        Some(Self { bandwidth, samples, ..self.clone() })
    }
}
