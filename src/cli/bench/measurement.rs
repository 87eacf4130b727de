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
}
