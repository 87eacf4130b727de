//! What the engine has shown so far.

use crate::app::panels::ErrorCurve;
use crate::engine::{Frame, Status};
use std::sync::Arc;

/// Beyond what eyes can tell; a computer that is left alone should not work for more.
const FIRST_TARGET: f64 = 0.001;

/// The newest frame and what is known of the work on the next.
#[derive(Debug)]
pub(crate) struct Rendering {
    frame: Option<Arc<Frame>>,
    status: Status,
    /// What was asked for; the engine pauses after the iteration at hand.
    pub(crate) paused: bool,
    /// Of the error estimate: at it the engine rests.
    pub(crate) target: Option<f64>,
    curve: ErrorCurve,
}

impl Default for Rendering {
    fn default() -> Self {
        Self {
            frame: None,
            status: Status::Idle,
            paused: false,
            target: Some(FIRST_TARGET),
            curve: ErrorCurve::default(),
        }
    }
}

impl Rendering {
    /// Takes the newest frame.
    pub(crate) fn receive(&mut self, frame: Arc<Frame>) {
        self.curve.begin(frame.generation);
        if let Some(error) = frame.stats.error_estimate.filter(|_| !frame.draft) {
            self.curve.push(frame.generation, frame.stats.seconds, error);
        }
        self.frame = Some(frame);
    }

    /// What the engine does.
    pub(crate) fn set_status(&mut self, status: Status) {
        self.status = status;
    }

    /// What the engine does.
    pub(crate) fn status(&self) -> &Status {
        &self.status
    }

    /// The newest frame.
    pub(crate) fn frame(&self) -> Option<&Arc<Frame>> {
        self.frame.as_ref()
    }

    /// The newest frame, unless it is a draft.
    pub(crate) fn full_frame(&self) -> Option<&Arc<Frame>> {
        self.frame.as_ref().filter(|frame| !frame.draft)
    }

    /// The error estimate over time.
    pub(crate) fn error_curve(&self) -> &ErrorCurve {
        &self.curve
    }
}
