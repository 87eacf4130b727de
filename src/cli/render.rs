use super::{
    CliError,
    args::{Budget, RenderArguments, RenderSettings},
    interrupt::Interrupt,
    output::{needs_folder, write},
    progress::Progress,
    rendering::{advance, advance_unless, pool},
    statistics::Statistics,
    words::counted,
};
use crate::{
    engine::{Frame, Session},
    file::folder,
    film::{ToneMap, write_exr, write_png},
    scene::SceneFile,
    transport::Component,
};
use cpu_time::ProcessTime;
use std::{
    io::{self, Write, stderr},
    path::Path,
};

/// `patchlight render`: renders a picture and writes it.
pub(super) fn render(arguments: &RenderArguments) -> Result<(), CliError> {
    let format = Format::of(&arguments.output)?;
    needs_folder(&arguments.output)?;
    needs_own_files(arguments)?;
    arguments.stats.as_deref().map_or(Ok(()), needs_folder)?;
    let file = sized(SceneFile::find(&arguments.scene)?, &arguments.settings);
    let pool = pool(arguments.settings.threads)?;
    let interrupt = Interrupt::watch()?;
    let (frame, cpu_seconds) = pool.install(|| render_frame(&file, arguments, &interrupt))?;
    format.write(&arguments.output, &frame, &file)?;
    if let Some(path) = &arguments.stats {
        let statistics = Statistics::new(&frame, cpu_seconds, pool.current_num_threads());
        write(path, statistics.json()?.as_bytes())?;
    }
    match interrupt.signal() {
        Some((signal, code)) => {
            let iterations = counted(frame.stats.iterations, "iteration");
            let message = format!("{}: {iterations}, ended early by {signal}", arguments.output.display());
            Err(CliError::Interrupted { message, code })
        }
        None => {
            // The picture is written: a message that nobody can read is no failure.
            report(&frame, &arguments.output).ok();
            Ok(())
        }
    }
}

/// Fails before the rendering if the picture or the statistics would overwrite the scene or each other.
fn needs_own_files(arguments: &RenderArguments) -> Result<(), CliError> {
    let RenderArguments { scene, output, stats, .. } = arguments;
    for written in [Some(output), stats.as_ref()].into_iter().flatten() {
        if is_same_file(written, scene) {
            return Err(CliError::Usage(format!("{}: is the scene, which would be lost", written.display())));
        }
    }
    match stats {
        Some(stats) if is_same_file(stats, output) => {
            let file = stats.display();
            Err(CliError::Usage(format!("{file}: is both the picture and the statistics, expected two files")))
        }
        _ => Ok(()),
    }
}

/// Whether two paths lead to one file, which need not exist.
fn is_same_file(a: &Path, b: &Path) -> bool {
    let resolved = |path: &Path| {
        path.canonicalize()
            .or_else(|_| folder(path).canonicalize().map(|at| at.join(path.file_name().unwrap_or_default())))
    };
    matches!((resolved(a), resolved(b)), (Ok(a), Ok(b)) if a == b)
}

/// The picture when the budget is spent, or after a signal; the seconds of processor time. The picture has at least one iteration.
fn render_frame(
    file: &SceneFile,
    arguments: &RenderArguments,
    interrupt: &Interrupt,
) -> Result<(Frame, f64), CliError> {
    let RenderSettings { seed, only, .. } = arguments.settings;
    let mut session = Session::prepare(file, seed, None)?.only(only.map(Component::from));
    let progress = Progress::new(arguments.budget);
    let start = ProcessTime::now();
    let mut last = advance(&mut session);
    while !is_spent(&arguments.budget, &session, last) && !interrupt.has_come() {
        progress.show(&session.stats());
        last = advance_unless(&mut session, &|| interrupt.has_come());
    }
    let cpu_seconds = start.elapsed().as_secs_f64();
    Ok((session.frame(0), cpu_seconds))
}

/// Whether the budget is spent. `last` is the time of the last iteration, in seconds: the next iteration, if it takes
/// as long, must end within the budget.
fn is_spent(budget: &Budget, session: &Session, last: f64) -> bool {
    let iterations = session.iterations();
    if let Some(limit) = budget.iterations {
        return iterations >= limit;
    }
    if let Some(limit) = budget.error {
        return session.reaches(limit);
    }
    session.seconds() + last > budget.seconds.unwrap_or(Budget::DEFAULT_SECONDS)
}

/// The file format of the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
}

impl Format {
    fn of(path: &Path) -> Result<Self, CliError> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_lowercase();
        match extension.as_str() {
            "png" => Ok(Self::Png),
            "exr" => Ok(Self::Exr),
            _ => Err(CliError::Usage(format!("{}: expected a name that ends in .png or .exr", path.display()))),
        }
    }

    fn write(self, path: &Path, frame: &Frame, file: &SceneFile) -> Result<(), CliError> {
        let film = &file.scene.film;
        match self {
            Self::Png => write_png(path, &frame.image, &ToneMap::new(film.exposure, film.tone_curve))?,
            Self::Exr => write_exr(path, &frame.image)?,
        }
        Ok(())
    }
}

fn sized(mut file: SceneFile, settings: &RenderSettings) -> SceneFile {
    if let Some((width, height)) = settings.size {
        file.scene.film.width = width;
        file.scene.film.height = height;
    }
    file
}

fn report(frame: &Frame, output: &Path) -> io::Result<()> {
    let stats = &frame.stats;
    let mut err = stderr().lock();
    let iterations = counted(stats.iterations, "iteration");
    writeln!(err, "{}: {iterations} in {:.1} s", output.display(), stats.seconds)?;
    if let Some(missing) = stats.missing_light {
        writeln!(err, "{missing}")?;
    }
    if stats.dropped_samples > 0 {
        writeln!(err, "dropped {} that were not finite", counted(stats.dropped_samples, "sample"))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_says_the_format() {
        assert_eq!(Format::of(Path::new("a/b.PNG")).unwrap(), Format::Png);
        assert_eq!(Format::of(Path::new("b.exr")).unwrap(), Format::Exr);
        for wrong in ["b", "b.jpg", ".png", "b.png.txt"] {
            assert!(Format::of(Path::new(wrong)).is_err(), "{wrong}");
        }
    }
}
