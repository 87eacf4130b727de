use crate::cli::bench::median::Median;

/// What a run gave.
pub(super) struct RunResult {
    pub(super) name: String,
    /// The relMSE that others reach.
    pub(super) others: Option<f64>,
    pub(super) medians: Vec<Median>,
}
