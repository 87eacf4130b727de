use signal_hook::{
    consts::{SIGINT, SIGTERM},
    flag,
};
use std::io;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// What a shell adds to the number of a signal for the exit code of a program that the signal ended.
const EXIT_CODE_OF_SIGNALS: i32 = 128;

/// The first signal (SIGINT of Ctrl+C, SIGTERM of `kill`) that asks the program to end.
pub(super) struct Interrupt {
    /// The number of the signal; 0 before it.
    signal: Arc<AtomicUsize>,
    /// When the program noticed the signal.
    noticed: OnceLock<Instant>,
}

impl Interrupt {
    /// Watches for signals from now on. The first one is only noted; a second one ends the program at once.
    ///
    /// # Errors
    ///
    /// If the system does not let the program watch.
    pub(super) fn watch() -> io::Result<Self> {
        let (signal, is_second) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicBool::new(false)));
        for number in [SIGINT, SIGTERM] {
            // In this order: a signal runs the actions one after the other.
            flag::register_conditional_shutdown(number, EXIT_CODE_OF_SIGNALS + number, is_second.clone())?;
            flag::register(number, is_second.clone())?;
            flag::register_usize(number, signal.clone(), number as usize)?;
        }
        Ok(Self { signal, noticed: OnceLock::new() })
    }

    /// The name of the signal and the exit code of a program that it ended; `None` before it.
    pub(super) fn signal(&self) -> Option<(&'static str, u8)> {
        match self.signal.load(Ordering::Relaxed) as i32 {
            0 => None,
            SIGINT => Some(("SIGINT", (EXIT_CODE_OF_SIGNALS + SIGINT) as u8)),
            _ => Some(("SIGTERM", (EXIT_CODE_OF_SIGNALS + SIGTERM) as u8)),
        }
    }

    /// The time since the program noticed the signal; `None` before it. Calls `notice` once, at the first call after the signal.
    pub(super) fn age(&self, notice: impl FnOnce()) -> Option<Duration> {
        self.signal()?;
        let noticed = self.noticed.get_or_init(|| {
            notice();
            Instant::now()
        });
        Some(noticed.elapsed())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_signal_is_noticed_once() {
        let interrupt = Interrupt { signal: Arc::default(), noticed: OnceLock::new() };
        let mut notices = 0;
        assert_eq!(interrupt.age(|| notices += 1), None, "no signal yet");
        interrupt.signal.store(SIGTERM as usize, Ordering::Relaxed);
        let first = interrupt.age(|| notices += 1).unwrap();
        assert!(interrupt.age(|| notices += 1).unwrap() >= first);
        assert_eq!((notices, interrupt.signal()), (1, Some(("SIGTERM", 143))));
    }
}
