//! The worker that turns scenes into frames: commands in, frames out; cancel, restart, pause.
//!
//! [`Session`] renders one scene, iteration by iteration, on the caller's thread; [`Engine`] runs sessions on a thread of
//! its own, the newest scene at any time, and begins each with a quick draft.

mod convergence_rates;
mod film_sums;
mod frame;
mod iteration;
mod session;
mod shared;
mod worker;

pub use film_sums::FilmSums;
pub use frame::{Frame, PassSeconds, PlanSummary, Stats};
pub use session::{Session, SessionError};
pub use worker::{Command, Engine, EngineError, EngineSettings, Status};

pub use crate::transport::{Counters, PlanItem, PlanNote};
