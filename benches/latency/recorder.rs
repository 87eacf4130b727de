//! An engine whose frames are recorded with the time at which they come.

use crossbeam_channel::{Receiver, bounded};
use patchlight::engine::{Command, Engine, EngineSettings, Frame};
use patchlight::scene::SceneFile;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A frame and the time at which it came.
#[derive(Clone)]
pub(crate) struct Recorded {
    pub(crate) frame: Arc<Frame>,
    pub(crate) came: Instant,
}

pub(crate) struct Recorder {
    engine: Engine,
    woken: Receiver<()>,
    /// When each generation was sent, from generation 1 on.
    sent: Vec<Instant>,
    pub(crate) frames: Vec<Recorded>,
}

impl Recorder {
    pub(crate) fn start() -> Self {
        let (wake, woken) = bounded(1);
        // A full channel already announces a new frame.
        let wake = move || wake.try_send(()).unwrap_or_default();
        let engine = Engine::start(EngineSettings { threads: None, seed: 1 }, wake).expect("there are threads");
        engine.send(Command::Smooth(true));
        Self { engine, woken, sent: Vec::new(), frames: Vec::new() }
    }

    /// Sends a scene; returns when.
    pub(crate) fn show(&mut self, scene: Arc<SceneFile>) -> Instant {
        let now = Instant::now();
        self.sent.push(now);
        self.engine.send(Command::Show(scene));
        now
    }

    /// The number of scenes sent: the generation of the newest.
    pub(crate) fn generation(&self) -> u64 {
        self.sent.len() as u64
    }

    /// Records frames for this time.
    pub(crate) fn record(&mut self, time: Duration) {
        let end = Instant::now() + time;
        while self.woken.recv_deadline(end).is_ok() {
            let came = Instant::now();
            self.frames.extend(self.engine.newest_frame().map(|frame| Recorded { frame, came }));
        }
    }

    /// The time since the scene was sent that the screen shows now; `None` before the first recorded frame.
    pub(crate) fn age(&self) -> Option<Duration> {
        let generation = self.frames.last()?.frame.generation;
        Some(self.sent[generation as usize - 1].elapsed())
    }
}
