//! The settings of a plan that iterations measured. The scene determines all other settings.

use super::render_plan::Plan;
use crate::transport::density::Bandwidth;
use crate::transport::density::sample_allocation::SampleAllocation;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The measured settings of a plan.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct MeasuredPlan {
    bandwidth: Option<Arc<Bandwidth>>,
    samples: Option<Arc<SampleAllocation>>,
    is_kept: bool,
}

impl MeasuredPlan {
    /// These settings, which no refinement changes any more.
    pub fn kept(self) -> Self {
        Self { is_kept: true, ..self }
    }

    /// Whether no refinement changes the settings.
    pub fn is_kept(&self) -> bool {
        self.is_kept
    }

    /// Whether the settings are for a film of this size, and for the iteration `next` and later ones.
    pub fn fits(&self, width: u32, height: u32, next: u64) -> bool {
        let pixels = width as usize * height as usize;
        self.bandwidth.as_ref().is_none_or(|bandwidth| bandwidth.fits(width, height))
            && self.samples.as_ref().is_none_or(|samples| samples.fits(pixels, next))
    }
}

impl Plan {
    /// The measured settings of the plan.
    pub fn measured(&self) -> MeasuredPlan {
        let Self { bandwidth, samples, is_kept, .. } = self;
        MeasuredPlan { bandwidth: bandwidth.clone(), samples: samples.clone(), is_kept: *is_kept }
    }

    /// This plan with the measured settings of another plan of the same scene.
    pub fn with_measured(self, measured: MeasuredPlan) -> Self {
        let MeasuredPlan { bandwidth, samples, is_kept } = measured;
        Self { bandwidth, samples, is_kept, ..self }
    }
}
