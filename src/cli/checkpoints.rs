use super::{
    CliError,
    args::{CheckpointArguments, Iterations, RenderArguments},
    output,
    progress::Progress,
    words::counted,
};
use crate::{
    engine::{Checkpoint, CheckpointError, CheckpointFile, Run, Session},
    scene::SceneFile,
    transport::Component,
};
use std::{
    path::Path,
    time::{Duration, Instant},
};

/// The checkpoints of a rendering: where it begins, and where it saves.
pub(super) struct Checkpoints<'a> {
    arguments: &'a CheckpointArguments,
    iterations: Option<Iterations>,
    /// `None` if the rendering neither reads nor writes a checkpoint.
    run: Option<Run>,
    resumed: Option<CheckpointFile>,
    plan: Option<CheckpointFile>,
    saved: Instant,
}

impl<'a> Checkpoints<'a> {
    /// Opens the checkpoints that the command line names, and fails if they belong to another run.
    pub(super) fn open(file: &SceneFile, render: &'a RenderArguments) -> Result<Self, CliError> {
        let RenderArguments { checkpoints: arguments, settings, budget, scene, .. } = render;
        let CheckpointArguments { checkpoint, resume, plan, .. } = arguments;
        let new_run = || Run::new(file, settings.seed, settings.only.map(Component::from));
        let is_used = [checkpoint, resume, plan].into_iter().any(Option::is_some);
        let run = is_used.then(new_run).transpose();
        let run = run.map_err(|e| CliError::Usage(format!("{}: {e}", scene.display())))?;
        let open =
            |path: &Option<_>| path.as_deref().zip(run.as_ref()).map(|(path, run)| opened(path, run)).transpose();
        let (resumed, plan) = (open(resume)?, open(plan)?);
        let iterations = budget.iterations;
        if let (Some(resumed), Some(wanted)) = (&resumed, iterations) {
            must_go_on(resumed, wanted)?;
        }
        if let (None, Some(plan)) = (&resumed, &plan) {
            must_precede(plan, iterations)?;
        }
        Ok(Self { arguments, iterations, run, resumed, plan, saved: Instant::now() })
    }

    /// The session at the iteration where it begins or goes on, with its plan.
    pub(super) fn begin(&mut self, session: Session) -> Result<Session, CliError> {
        let is_resumed = self.resumed.is_some();
        let session = match self.resumed.take() {
            Some(file) => session.resuming(file.read()?.part),
            None => session.beginning_with(self.iterations.map_or(1, |iterations| iterations.first)),
        };
        let Some(file) = self.plan.take() else { return Ok(session) };
        let path = file.path().to_owned();
        let plan = file.read()?.part;
        if is_resumed && !session.part().has_plan_of(&plan) {
            let message = "its plan is not the one that the resumed film has reached";
            return Err(CliError::Usage(format!("{}: {message}", path.display())));
        }
        Ok(session.keeping(&plan))
    }

    /// Saves if it is time. A failure is only told: a later time may succeed.
    pub(super) fn save_if_due(&mut self, session: &Session, progress: &Progress) {
        if self.saved.elapsed() >= Duration::from_secs_f64(self.arguments.checkpoint_seconds) {
            if let Err(error) = self.save(session) {
                progress.tell(&format!("{error}; the rendering goes on"));
            }
            self.saved = Instant::now();
        }
    }

    /// Writes the checkpoint, if the command line names one. Returns its path; `None` without one, and for a rendering without any
    /// iteration, which leaves a previous file as it is.
    pub(super) fn save(&self, session: &Session) -> Result<Option<&'a Path>, CheckpointError> {
        let Some((path, run)) = self.arguments.checkpoint.as_deref().zip(self.run.as_ref()) else { return Ok(None) };
        if session.part().rendered() == 0 {
            return Ok(None);
        }
        Checkpoint::write(path, run, session.part()).map(|()| Some(path))
    }

    /// Fails if a file that is `written` is one that is read, and would be lost.
    pub(super) fn must_not_overwrite(arguments: &CheckpointArguments, written: &Path) -> Result<(), CliError> {
        let is_checkpoint = arguments.checkpoint.as_deref() == Some(written);
        let resume = arguments.resume.as_deref().filter(|_| !is_checkpoint);
        let read = [(resume, "the film"), (arguments.plan.as_deref(), "the plan")];
        output::must_not_overwrite(written, read.into_iter().filter_map(|(read, name)| Some((read?, name))))
    }
}

/// Opens a checkpoint of this run.
fn opened(path: &Path, run: &Run) -> Result<CheckpointFile, CliError> {
    let file = CheckpointFile::open(path)?;
    match file.run().difference(run) {
        Some(difference) => Err(CliError::Usage(format!("{}: is a checkpoint of {difference}", path.display()))),
        None => Ok(file),
    }
}

/// Fails if a film cannot become one of these iterations.
fn must_go_on(film: &CheckpointFile, wanted: Iterations) -> Result<(), CliError> {
    let (first, last) = film.iterations();
    let wrong = |message| Err(CliError::Usage(format!("{}: {message}", film.path().display())));
    if first != wanted.first {
        return wrong(format!("begins with iteration {first}, --iterations with {}", wanted.first));
    }
    if last > wanted.last {
        return wrong(format!("already has iteration {last}, --iterations ends with {}", wanted.last));
    }
    Ok(())
}

/// Fails if a part with a plan begins before all iterations that measured the plan.
fn must_precede(plan: &CheckpointFile, wanted: Option<Iterations>) -> Result<(), CliError> {
    let last = plan.iterations().1;
    if wanted.is_some_and(|wanted| wanted.first > last) {
        return Ok(());
    }
    Err(CliError::Usage(format!(
        "{}: measured its plan in {}; the plan is for later ones: --iterations {}..",
        plan.path().display(),
        counted(last, "iteration"),
        last + 1
    )))
}
