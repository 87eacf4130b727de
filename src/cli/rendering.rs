//! The thread pool and the timed iterations of all commands that render.

use super::CliError;
use crate::{
    engine::{Session, SessionError},
    transport::Cancel,
};
use rayon::{ThreadPool, ThreadPoolBuilder};

/// A pool of this many threads, or of one thread per core.
pub(super) fn pool(threads: Option<u16>) -> Result<ThreadPool, CliError> {
    let count = threads.map_or(0, usize::from);
    let pool = ThreadPoolBuilder::new().num_threads(count).thread_name(|k| format!("render {k}")).build();
    pool.map_err(|e| CliError::from(SessionError::from(e)))
}

/// Renders one iteration and returns the seconds that it took.
pub(super) fn advance(session: &mut Session) -> f64 {
    advance_unless(session, &|| false)
}

/// As [`advance`], but gives the iteration up when told so.
pub(super) fn advance_unless(session: &mut Session, is_cancelled: &(impl Fn() -> bool + Sync)) -> f64 {
    let before = session.seconds();
    session.advance(Cancel::when(is_cancelled));
    session.seconds() - before
}

/// Renders iterations while the next iteration would end before the session's rendering time is `seconds`, if it takes
/// as long as the previous iteration. `last` is the time of the last iteration; returns the time of the new last
/// iteration.
pub(super) fn advance_until(session: &mut Session, mut last: f64, seconds: f64) -> f64 {
    while session.seconds() + last <= seconds {
        last = advance(session);
    }
    last
}
