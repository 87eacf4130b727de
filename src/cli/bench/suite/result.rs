use crate::cli::bench::median::Median;

/// The result of a run.
pub(super) struct RunResult {
    pub(super) name: String,
    /// The relMSE of another program, to compare with.
    pub(super) others: Option<f64>,
    pub(super) medians: Vec<Median>,
}
