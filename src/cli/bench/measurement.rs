use crate::{engine::Stats, film::Errors};

/// The errors of an image at a mark.
#[derive(Clone, Debug)]
pub(super) struct Measurement {
    pub(super) seed: u64,
    /// The mark: the seconds of rendering after which to measure.
    pub(super) mark: f64,
    /// The statistics at the measurement; their seconds are the actual time of the iterations.
    pub(super) stats: Stats,
    pub(super) errors: Errors,
    /// The errors outside the mask; `None` without a mask.
    pub(super) outside: Option<Errors>,
    /// The mean FLIP of the pixels inside the mask, 0 to 1; `None` without the feature `flip`.
    pub(super) flip: Option<f64>,
    /// The mean FLIP outside the mask; `None` without a mask.
    pub(super) flip_outside: Option<f64>,
}

impl Measurement {
    /// The RMSE that was estimated without the reference, over the measured RMSE. `None` without an estimate, or if the RMSE is 0:
    /// with two references it is 0 if the references differ more from each other than the image from them.
    pub(super) fn estimate_over_error(&self) -> Option<f64> {
        let estimate = self.stats.error_estimate.filter(|_| self.errors.rmse > 0.0);
        estimate.map(|estimate| estimate * self.errors.reference_mean / self.errors.rmse)
    }
}
