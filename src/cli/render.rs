use super::{
    CliError,
    args::{Budget, RenderArguments, RenderSettings},
    output::{needs_folder, write},
    progress::Progress,
    rendering::{advance, pool},
    statistics::Statistics,
    words::counted,
};
use crate::{
    engine::{Frame, Session},
    film::{ToneMap, write_exr, write_png},
    scene::SceneFile,
    transport::Component,
};
use cpu_time::ProcessTime;
use std::{
    io::{Write, stderr},
    path::Path,
};

/// `patchlight render`: renders a picture and writes it.
pub(super) fn render(arguments: &RenderArguments) -> Result<(), CliError> {
    let format = Format::of(&arguments.output)?;
    needs_folder(&arguments.output)?;
    arguments.stats.as_deref().map_or(Ok(()), needs_folder)?;
    let file = sized(SceneFile::find(&arguments.scene)?, &arguments.settings);
    let pool = pool(arguments.settings.threads)?;
    let (frame, cpu_seconds) = pool.install(|| render_frame(&file, arguments))?;
    format.write(&arguments.output, &frame, &file)?;
    if let Some(path) = &arguments.stats {
        let statistics = Statistics::new(&frame, cpu_seconds, pool.current_num_threads());
        write(path, statistics.json()?.as_bytes())?;
    }
    report(&frame, &arguments.output)
}

fn render_frame(file: &SceneFile, arguments: &RenderArguments) -> Result<(Frame, f64), CliError> {
    let RenderSettings { seed, only, .. } = arguments.settings;
    let mut session = Session::prepare(file, seed, None)?.only(only.map(Component::from));
    let progress = Progress::new(arguments.budget);
    let start = ProcessTime::now();
    let mut last = advance(&mut session);
    while !is_spent(&arguments.budget, &session, last) {
        progress.show(&session.stats());
        last = advance(&mut session);
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

fn report(frame: &Frame, output: &Path) -> Result<(), CliError> {
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
