use super::{
    CliError,
    args::{Budget, RenderArguments, RenderSettings},
    checkpoints::Checkpoints,
    interrupt::Interrupt,
    output::{must_be_own_files, must_not_overwrite, must_spare_files_of, write},
    picture_format::PictureFormat,
    progress::Progress,
    rendering::{advance_unless, pool},
    statistics::{Statistics, Work},
    words::counted,
};
use crate::{
    engine::{CheckpointError, Frame, Session, provenance},
    scene::SceneFile,
    transport::Component,
};
use cpu_time::ProcessTime;
use std::{
    fmt::Display,
    io::{self, Write, stderr},
    path::Path,
    time::Duration,
};

/// The longest wait for the first iteration after a signal, without which there is no picture. Job schedulers kill a program half a minute
/// after the signal, and large files take some seconds to be written.
const WAIT_FOR_PICTURE: Duration = Duration::from_secs(10);

/// `patchlight render`: renders a picture and writes it.
pub(super) fn render(arguments: &RenderArguments) -> Result<(), CliError> {
    let format = arguments.output.as_deref().map(PictureFormat::of).transpose()?;
    needs_own_files(arguments)?;
    let file = sized(SceneFile::find(&arguments.scene)?, &arguments.settings);
    files_written(arguments).try_for_each(|(path, _)| must_spare_files_of(&file, path))?;
    let mut checkpoints = Checkpoints::open(&file, arguments)?;
    let pool = pool(arguments.settings.threads)?;
    let interrupt = Interrupt::watch()?;
    let Rendered { frame, cpu_seconds, saved } =
        pool.install(|| render_frame(&file, arguments, &mut checkpoints, &interrupt))?;
    if let (Some(format), Some(path)) = (format, &arguments.output)
        && frame.iteration > 0
    {
        let film = &file.scene.film;
        let display = (film.exposure, film.tone_curve);
        let RenderSettings { seed, only, .. } = arguments.settings;
        let provenance = provenance(&file, seed, only.map(Component::from), &frame.stats);
        format.write(path, &frame.image, display, arguments.png_bits.into(), &provenance)?;
    }
    if let Some(path) = &arguments.stats {
        let size = (frame.image.width, frame.image.height);
        let work = Work { cpu_seconds, threads: pool.current_num_threads() };
        let statistics = Statistics::new(&frame.stats, size).of_rendering(work, &frame.plan);
        write(path, statistics.json()?.as_bytes())?;
    }
    let saved = saved?;
    let checkpoint = arguments.checkpoints.checkpoint.as_deref();
    let output = arguments.output.as_deref().or(checkpoint).unwrap_or(&arguments.scene).display();
    match interrupt.signal() {
        Some((signal, code)) => {
            let go_on = saved.map_or(String::new(), |path| format!("; go on with --resume {}", path.display()));
            let ended = match frame.iteration {
                0 => format!("no picture, {signal} came before the end of an iteration"),
                n => format!("{}, ended early by {signal}", counted(n, "iteration")),
            };
            Err(CliError::Interrupted { message: format!("{output}: {ended}{go_on}"), code })
        }
        None => {
            // The picture is written: a message that nobody can read is no failure.
            report(&frame, &output).ok();
            Ok(())
        }
    }
}

/// Fails before the rendering if a file that it writes has no folder, or would overwrite the scene, a checkpoint or another result.
fn needs_own_files(arguments: &RenderArguments) -> Result<(), CliError> {
    let written: Vec<_> = files_written(arguments).collect();
    must_be_own_files(&written)?;
    written.iter().try_for_each(|(path, _)| {
        must_not_overwrite(path, [(arguments.scene.as_path(), "the scene")])?;
        Checkpoints::must_not_overwrite(&arguments.checkpoints, path)
    })
}

/// The files that a rendering writes, with the names of what they hold.
fn files_written(arguments: &RenderArguments) -> impl Iterator<Item = (&Path, &'static str)> {
    let RenderArguments { output, stats, checkpoints, .. } = arguments;
    let written = [(output, "picture"), (stats, "statistics"), (&checkpoints.checkpoint, "checkpoint")];
    written.into_iter().filter_map(|(path, name)| Some((path.as_deref()?, name)))
}

/// The result of a rendering.
struct Rendered<'a> {
    frame: Frame,
    cpu_seconds: f64,
    /// The checkpoint, if one was written.
    saved: Result<Option<&'a Path>, CheckpointError>,
}

/// The picture when the budget is spent, or after a signal. The picture is black if a signal ended the first iteration, or the iterations
/// before it, which are only measured.
fn render_frame<'a>(
    file: &SceneFile,
    arguments: &RenderArguments,
    checkpoints: &mut Checkpoints<'a>,
    interrupt: &Interrupt,
) -> Result<Rendered<'a>, CliError> {
    let RenderSettings { seed, only, .. } = arguments.settings;
    let session = Session::prepare(file, seed, None)?.only(only.map(Component::from));
    let mut session = checkpoints.begin(session)?;
    let progress = Progress::new(arguments.budget);
    let must_stop = |has_begun: bool| {
        // A second signal ends the program at once: nothing can be cleared then.
        let age = interrupt.age(|| progress.clear());
        age.is_some_and(|age| has_begun || age > WAIT_FOR_PICTURE)
    };
    let start = ProcessTime::now();
    let mut last = 0.0;
    while !is_spent(&arguments.budget, &session, last) {
        let has_begun = session.part().rendered() > 0;
        if must_stop(has_begun) {
            break;
        }
        progress.show(&session.stats());
        last = advance_unless(&mut session, &|| must_stop(has_begun));
        checkpoints.save_if_due(&session, &progress);
    }
    let cpu_seconds = start.elapsed().as_secs_f64();
    Ok(Rendered { frame: session.frame(0), cpu_seconds, saved: checkpoints.save(&session) })
}

/// Whether the budget is spent. `last` is the time of the last iteration, in seconds: the next iteration, if it takes
/// as long, must end within the budget.
fn is_spent(budget: &Budget, session: &Session, last: f64) -> bool {
    if session.iterations() == 0 {
        return false;
    }
    if let Some(iterations) = budget.iterations {
        return session.part().film().last() >= iterations.last;
    }
    if let Some(limit) = budget.error {
        return session.reaches(limit);
    }
    session.seconds() + last > budget.seconds.unwrap_or(Budget::DEFAULT_SECONDS)
}

fn sized(mut file: SceneFile, settings: &RenderSettings) -> SceneFile {
    if let Some((width, height)) = settings.size {
        file.scene.film.width = width;
        file.scene.film.height = height;
    }
    file
}

fn report(frame: &Frame, output: &impl Display) -> io::Result<()> {
    let stats = &frame.stats;
    let mut err = stderr().lock();
    let iterations = counted(stats.iterations, "iteration");
    writeln!(err, "{output}: {iterations} in {:.1} s", stats.seconds)?;
    if let Some(missing) = stats.missing_light {
        writeln!(err, "{missing}")?;
    }
    if stats.dropped_samples > 0 {
        writeln!(err, "dropped {} that were not finite", counted(stats.dropped_samples, "sample"))?;
    }
    Ok(())
}
