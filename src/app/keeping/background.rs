//! A thread that does jobs in their order.

use crossbeam_channel::{Sender, unbounded};
use std::thread::{self, JoinHandle};

type Job<S> = Box<dyn FnOnce(&mut S) + Send>;

/// A thread with a state of type `S` that does jobs in their order. Dropping it waits for the jobs.
pub(super) struct Background<S> {
    jobs: Option<Sender<Job<S>>>,
    thread: Option<JoinHandle<()>>,
}

impl<S: Send + 'static> Background<S> {
    /// A thread of this name. Where the system gives no thread, no job is done.
    pub(super) fn new(name: &str, mut state: S) -> Self {
        let (send, receive) = unbounded::<Job<S>>();
        let run = move || receive.iter().for_each(|job| job(&mut state));
        let thread = thread::Builder::new().name(name.to_owned()).spawn(run).ok();
        Self { jobs: Some(send), thread }
    }

    /// Does a job after the jobs before it.
    pub(super) fn run(&self, job: impl FnOnce(&mut S) + Send + 'static) {
        if let Some(jobs) = &self.jobs {
            // Fails without a thread, and after a job that panicked.
            jobs.send(Box::new(job)).ok();
        }
    }
}

impl<S> Drop for Background<S> {
    fn drop(&mut self) {
        self.jobs = None;
        if let Some(thread) = self.thread.take() {
            // The panic hook has told of a panic.
            thread.join().ok();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::{Arc, Mutex};

    #[test]
    fn jobs_are_done_in_their_order_before_the_end() {
        let done = Arc::new(Mutex::new(Vec::new()));
        let background = Background::new("test", 0);
        for _ in 0..50 {
            let done = Arc::clone(&done);
            background.run(move |count| {
                *count += 1;
                done.lock().unwrap().push(*count);
            });
        }
        drop(background);
        assert_eq!(*done.lock().unwrap(), (1..=50).collect::<Vec<_>>());
    }
}
