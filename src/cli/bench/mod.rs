//! Error over time: the convergence of the picture of a scene to a reference.
//!
//! | file | holds |
//! |---|---|
//! | `truth` | `Truth`: references and mask |
//! | `measurement` | `Measurement`: the errors at one mark |
//! | `median`, `slope` | medians over seeds; the power of time by which errors fall |
//! | `table`, `csv` | the measurements as text |
//! | `axis`, `plot` | the measurements as a plot |
//! | `trial` | `Trial`: renders and measures one scene |
//! | `suite/` | `patchlight bench --suite`: several scenes |

mod axis;
mod csv;
mod measurement;
mod median;
mod plot;
mod slope;
mod suite;
mod table;
mod trial;
mod truth;

use super::{
    CliError,
    args::BenchArguments,
    output::{must_not_overwrite, must_spare_files_of, needs_folder, write},
    rendering::pool,
};
use crate::{
    film::{ImageError, Mask, read_exr},
    scene::SceneFile,
    transport::Component,
};
use std::path::Path;
use trial::Trial;
use truth::Truth;

/// `patchlight bench`: measures a scene or a suite.
pub(super) fn bench(arguments: &BenchArguments) -> Result<(), CliError> {
    let BenchArguments { scene, reference, suite, output, .. } = arguments;
    match (scene, reference, suite, output) {
        (Some(scene), Some(reference), None, None) => bench_scene(scene, reference, arguments),
        (None, None, Some(suite), Some(output)) => suite::bench_suite(suite, output, arguments.threads),
        _ => Err(CliError::Usage(
            "expected either SCENE --reference REF.exr, or --suite FILE.toml --output FOLDER; \
             see patchlight bench --help"
                .to_owned(),
        )),
    }
}

fn bench_scene(scene: &Path, reference: &Path, arguments: &BenchArguments) -> Result<(), CliError> {
    arguments.csv.as_deref().map_or(Ok(()), needs_folder)?;
    arguments.plot.as_deref().map_or(Ok(()), needs_png)?;
    let file = SceneFile::find(scene)?;
    for written in [&arguments.csv, &arguments.plot].into_iter().flatten() {
        let pictures = [Some(reference), arguments.second_reference.as_deref(), arguments.mask.as_deref()];
        let pictures = pictures.into_iter().flatten().map(|picture| (picture, "a picture to compare with"));
        must_not_overwrite(written, pictures.chain([(scene, "the scene")]))?;
        must_spare_files_of(&file, written)?;
    }
    let picture = read_exr(reference)?;
    let second = arguments.second_reference.as_deref().map(read_exr).transpose()?;
    let mask = arguments.mask.as_deref().map(Mask::read).transpose()?;
    let truth = Truth::new(picture, second, mask).map_err(|e| in_file(&e, reference, arguments))?;
    let trial = Trial::new(file, truth, &arguments.seconds, arguments.seeds).only(arguments.only.map(Component::from));
    let rows = pool(arguments.threads)?.install(|| trial.measure())?;
    if let Some(path) = &arguments.csv {
        write(path, csv::csv(&rows).as_bytes())?;
    }
    if let Some(path) = &arguments.plot {
        write(path, &plot::png(&trial.file.scene.name, &rows)?)?;
    }
    Ok(())
}

/// The error of images that differ in size, with the name of the file at fault.
fn in_file(error: &ImageError, reference: &Path, arguments: &BenchArguments) -> CliError {
    let file = match error {
        ImageError::Size { what: "mask", .. } => arguments.mask.as_deref(),
        ImageError::Size { what: "second reference", .. } => arguments.second_reference.as_deref(),
        _ => None,
    };
    CliError::Usage(format!("{}: {error}", file.unwrap_or(reference).display()))
}

/// Fails before the rendering if the plot cannot be written to this path.
fn needs_png(path: &Path) -> Result<(), CliError> {
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png")) {
        needs_folder(path)
    } else {
        Err(CliError::Usage(format!("{}: expected a name that ends in .png", path.display())))
    }
}
