use crate::{engine::Stats, film::Errors};

/// A picture's error at some time.
#[derive(Clone, Debug)]
pub(super) struct Measurement {
    pub(super) seed: u64,
    /// Seconds at which it should be taken.
    pub(super) mark: f64,
    /// At that time; its seconds are those that iterations really took.
    pub(super) stats: Stats,
    pub(super) errors: Errors,
    /// Of the pixels outside the mask, where there is one.
    pub(super) outside: Option<Errors>,
    /// How different the pictures look, 0 to 1, where the program can tell.
    pub(super) flip: Option<f64>,
    /// The same outside the mask.
    pub(super) flip_outside: Option<f64>,
}

impl Measurement {
    /// The error that was estimated without the reference, over the true one; `None` where there was no estimate, or no error:
    /// by two references it is 0 where they are farther from each other than the picture from either.
    pub(super) fn estimate_over_error(&self) -> Option<f64> {
        let estimate = self.stats.error_estimate.filter(|_| self.errors.rmse > 0.0);
        estimate.map(|estimate| estimate * self.errors.reference_mean / self.errors.rmse)
    }
}
