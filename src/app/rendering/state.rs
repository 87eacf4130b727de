//! The newest frame, the engine's status, and the commands for the engine.

use super::error_curve::ErrorCurve;
use super::renames::Renames;
use super::submission::Submission;
use crate::engine::{Command, Frame, Limits, Status};
use crate::scene::{Problem, Scene, SceneFile};
use crate::transport::Component;
use std::sync::Arc;

/// The relative error at which rendering stops by default: a smaller error is invisible, so an unattended window stops
/// computing there.
const DEFAULT_TARGET: f64 = 0.001;

/// The engine as the window sees it: frames and status come in, commands go out.
#[derive(Debug)]
pub(crate) struct Rendering {
    frame: Option<Arc<Frame>>,
    status: Status,
    /// The user's wish; the engine pauses after the current iteration.
    paused: bool,
    target: Option<f64>,
    limits: Limits,
    /// Whether the screen shows less noise in the interreflection than the picture has.
    smooth: bool,
    /// The component of the light that is rendered; `None` for all.
    only: Option<Component>,
    curve: ErrorCurve,
    submission: Submission,
    commands: Vec<Command>,
}

impl Rendering {
    /// No frame yet, and the default target error.
    pub(crate) fn new() -> Self {
        Self {
            frame: None,
            status: Status::Idle,
            paused: false,
            target: Some(DEFAULT_TARGET),
            limits: Limits::default(),
            smooth: true,
            only: None,
            curve: ErrorCurve::default(),
            submission: Submission::default(),
            commands: vec![Command::Target(Some(DEFAULT_TARGET)), Command::Smooth(true)],
        }
    }

    /// Takes the engine's status, and its newest frame if the engine made a frame since the last call.
    pub(crate) fn receive(&mut self, frame: Option<Arc<Frame>>, status: Status) {
        self.status = status;
        let Some(frame) = frame else { return };
        self.curve.begin(frame.generation);
        if let Some(error) = frame.stats.error_estimate.filter(|_| !frame.draft) {
            self.curve.push(frame.generation, frame.stats.seconds, error);
        }
        self.frame = Some(frame);
    }

    /// Sends the scene to the engine if the scene is valid and has another picture than the scene that was sent last.
    pub(crate) fn submit(&mut self, file: &Arc<SceneFile>) {
        self.commands.extend(self.submission.update(file).map(Command::Show));
    }

    /// The renames since the rendering of the picture of `scene` began. None while `scene` has problems: it may have other items.
    pub(crate) fn renames<'a>(&'a self, scene: &'a Scene) -> Renames<'a> {
        let named = self.submission.named().filter(|_| self.problems().is_empty());
        named.map_or_else(Renames::default, |named| Renames::between(&named.scene, scene))
    }

    /// Whether the engine renders the picture of this scene.
    pub(crate) fn renders(&self, file: &SceneFile) -> bool {
        self.submission.is_sent(file)
    }

    /// Takes `file` as the scene that the engine renders: saving changed its location, but not its picture.
    pub(crate) fn relocate(&mut self, file: &Arc<SceneFile>) {
        self.submission.relocate(file);
    }

    /// Pauses or resumes the engine.
    pub(crate) fn toggle_pause(&mut self) {
        self.paused = !self.paused;
        self.commands.push(if self.paused { Command::Pause } else { Command::Resume });
    }

    /// Restarts the picture from the first iteration.
    pub(crate) fn restart(&mut self) {
        self.commands.push(Command::Restart);
    }

    /// Stops rendering at this relative error; `None` never stops.
    pub(crate) fn set_target(&mut self, target: Option<f64>) {
        self.target = target;
        self.commands.push(Command::Target(target));
    }

    /// Stops rendering after this time or these iterations.
    pub(crate) fn set_limits(&mut self, limits: Limits) {
        self.limits = limits;
        self.commands.push(Command::Limits(limits));
    }

    /// The time and the iterations after which rendering stops.
    pub(crate) fn limits(&self) -> Limits {
        self.limits
    }

    /// The rendering time that is left until the error asked for, seconds; `None` where that cannot be told.
    pub(crate) fn seconds_left(&self) -> Option<f64> {
        self.curve.seconds_until(self.target?)
    }

    /// Shows less noise in the interreflection than the picture has, or the picture as it is.
    pub(crate) fn set_smooth(&mut self, smooth: bool) {
        self.smooth = smooth;
        self.commands.push(Command::Smooth(smooth));
    }

    /// Renders one component of the light, or all.
    pub(crate) fn set_only(&mut self, only: Option<Component>) {
        if self.only != only {
            self.only = only;
            self.commands.push(Command::Only(only));
        }
    }

    /// The component of the light that is rendered; `None` for all.
    pub(crate) fn only(&self) -> Option<Component> {
        self.only
    }

    /// Asks for the noise of pixels in frames, or no longer.
    pub(crate) fn tell_noise(&mut self, noise: bool) {
        self.commands.push(Command::Noise(noise));
    }

    /// Takes the commands for the engine, in their order.
    pub(crate) fn take_commands(&mut self) -> Vec<Command> {
        std::mem::take(&mut self.commands)
    }

    /// The engine's status.
    pub(crate) fn status(&self) -> &Status {
        &self.status
    }

    /// Whether the user has paused rendering; the engine may still finish an iteration.
    pub(crate) fn is_paused(&self) -> bool {
        self.paused
    }

    /// The relative error at which rendering stops; `None` never stops.
    pub(crate) fn target(&self) -> Option<f64> {
        self.target
    }

    /// Whether the screen shows less noise in the interreflection than the picture has.
    pub(crate) fn is_smooth(&self) -> bool {
        self.smooth
    }

    /// The newest frame; `None` before the first draft.
    pub(crate) fn frame(&self) -> Option<&Arc<Frame>> {
        self.frame.as_ref()
    }

    /// The newest frame, unless it is a draft.
    pub(crate) fn full_frame(&self) -> Option<&Arc<Frame>> {
        self.frame.as_ref().filter(|frame| !frame.draft)
    }

    /// The error estimate of the newest frame's generation over time.
    pub(crate) fn error_curve(&self) -> &ErrorCurve {
        &self.curve
    }

    /// The problems of the present scene; the engine cannot render a scene with problems.
    pub(crate) fn problems(&self) -> &[Problem] {
        self.submission.problems()
    }

    /// Whether the newest frame shows the present scene, or a newer frame soon will.
    pub(crate) fn is_current(&self) -> bool {
        self.problems().is_empty() && !matches!(self.status, Status::Failed(_))
    }
}
