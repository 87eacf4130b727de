//! The size of the canvas once it rests: while the user drags the window's border, no size is worth a new picture.

/// Time without a change after which a size rests, seconds.
pub(crate) const REST: f64 = 0.3;

/// A size with the time of its last change.
#[derive(Debug, Default)]
pub(crate) struct RestingSize {
    size: [u32; 2],
    /// Seconds.
    since: f64,
}

impl RestingSize {
    /// Notes the size at a time in seconds. Returns whether the size rests.
    pub(crate) fn note(&mut self, size: [u32; 2], time: f64) -> bool {
        if size != self.size {
            *self = Self { size, since: time };
        }
        time - self.since >= REST
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_rests_after_a_moment_without_a_change() {
        let mut size = RestingSize::default();
        assert!(!size.note([640, 480], 1.0));
        assert!(!size.note([640, 480], 1.2));
        assert!(!size.note([641, 480], 1.4), "another size");
        assert!(!size.note([641, 480], 1.6));
        assert!(size.note([641, 480], 1.8));
    }
}
