//! What every pass takes: the rows of the film that it renders, and the question whether its result is still wanted.

/// Rows of the film, counted from the top.
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
