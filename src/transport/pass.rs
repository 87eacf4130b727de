//! Arguments that passes have in common: rows of the film, and cancellation.

/// A range of rows of the film, counted from 0 at the top; the end is excluded.
pub type Rows = std::ops::Range<u32>;

/// Tells a pass that its result is no longer wanted.
#[derive(Clone, Copy)]
pub struct Cancel<'a>(&'a (dyn Fn() -> bool + Sync));

impl<'a> Cancel<'a> {
    /// Passes call this function about once a millisecond, from any thread; once it returns true they return `None`.
    pub fn when(cancelled: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self(cancelled)
    }

    /// For passes that always finish.
    pub const NEVER: Cancel<'static> = Cancel(&|| false);

    /// Whether the pass should give up.
    pub fn is_cancelled(&self) -> bool {
        (self.0)()
    }
}
