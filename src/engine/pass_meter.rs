//! Times the passes of an iteration and counts their work.

use super::frame::PassSeconds;
use crate::transport::{Counted, Counters};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// A pass, as [`PassSeconds`] distinguishes them.
#[derive(Clone, Copy, Debug)]
pub(super) enum Pass {
    Photons,
    Map,
    Camera,
    Gather,
    Commit,
}

/// The work of passes, and the time that they took.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Work {
    pub(super) counters: Counters,
    pub(super) seconds: PassSeconds,
}

/// Adds up the work of the passes of an iteration, from any thread.
#[derive(Debug, Default)]
pub struct PassMeter(Mutex<Work>);

impl PassMeter {
    /// Runs a pass that uses all threads; adds its time and its work.
    pub(super) fn run<T: Counted>(&self, pass: Pass, run: impl FnOnce() -> T) -> T {
        self.add(pass, 1.0, T::counters, run)
    }

    /// Runs a pass for one band; adds its time and its work. All threads render bands at once, so a band adds its seconds over the number
    /// of threads.
    pub(super) fn run_band<T: Counted>(&self, pass: Pass, run: impl FnOnce() -> T) -> T {
        self.add(pass, rayon::current_num_threads() as f64, T::counters, run)
    }

    /// Runs work that is not counted, on all threads; adds its time.
    pub(super) fn time<T>(&self, pass: Pass, run: impl FnOnce() -> T) -> T {
        self.add(pass, 1.0, |_| Counters::default(), run)
    }

    /// The work so far.
    pub(super) fn work(self) -> Work {
        self.0.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    fn add<T>(&self, pass: Pass, threads: f64, counters: fn(&T) -> Counters, run: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = run();
        let seconds = start.elapsed().as_secs_f64() / threads;
        let mut work = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        work.counters += counters(&result);
        *work.seconds.of_mut(pass) += seconds;
        result
    }
}

impl PassSeconds {
    fn of_mut(&mut self, pass: Pass) -> &mut f64 {
        match pass {
            Pass::Photons => &mut self.photons,
            Pass::Map => &mut self.map,
            Pass::Camera => &mut self.camera,
            Pass::Gather => &mut self.gather,
            Pass::Commit => &mut self.commit,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_add_their_work_and_their_fraction_of_the_time() {
        let meter = PassMeter::default();
        let rays = |rays| Some(RayCount(rays));
        meter.run(Pass::Photons, || (rays(1), rays(2)));
        let threads = rayon::current_num_threads();
        let spin = || {
            let start = Instant::now();
            while start.elapsed().as_secs_f64() < 0.02 {}
            rays(4)
        };
        for _ in 0..threads {
            meter.run_band(Pass::Camera, spin);
        }
        assert!(meter.run(Pass::Map, || None::<RayCount>).is_none(), "a cancelled pass has no work");
        let Work { counters, seconds } = meter.work();
        assert_eq!(counters.rays, 3 + 4 * threads as u64);
        assert!(seconds.camera >= 0.02 && seconds.gather == 0.0, "{seconds:?}");
    }

    struct RayCount(u64);

    impl Counted for RayCount {
        fn counters(&self) -> Counters {
            Counters { rays: self.0, ..Counters::default() }
        }
    }
}
